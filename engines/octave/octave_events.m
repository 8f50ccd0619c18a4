% Octave's ode45 with impacts as terminal events.
%     octave_events.m PROBLEM.json TOLERANCE HISTORY.csv [solver]
words = argv();
problem = jsondecode(fileread(words{1}), "makeValidName", false).problem;
last = problem.("end");
tolerance = str2double(words{2});
M = problem.M; C = problem.C; K = problem.K;
n = rows(M);
B = reshape([problem.contacts.direction], n, [])';
gap = [problem.contacts.gap](:); eta = [problem.contacts.restitution](:);
motion = @(t, y) [y(n+1:end); -M \ (K * y(1:n) + C * y(n+1:end))];
function [value, stop, direction] = gaps(y, B, gap)
  value = B * y(1:columns(B)) - gap;
  stop = ones(size(value));
  direction = -ones(size(value));
end
options = odeset("RelTol", tolerance, "AbsTol", tolerance, "Events", @(t, y) gaps(y, B, gap));
t = problem.start.t; y = [problem.start.u(:); problem.start.v(:)];
table = [t, y'];
before = cputime();
solver = @ode45;
if numel(words) > 3, solver = str2func(words{4}); end
while t < last
  [times, states, te, ye, ie] = solver(motion, [t, last], y, options);
  table = [table; times(2:end), states(2:end, :)];
  t = times(end); y = states(end, :)';
  if isempty(ie) || t >= last, break; end
  k = ie(end); b = B(k, :)';
  push = M \ b;
  y(n+1:end) -= (1 + eta(k)) * (b' * y(n+1:end)) / (b' * push) * push;
  y(1:n) -= (b' * y(1:n) - gap(k)) / (b' * push) * push;
  table = [table; t, y'];
end
file = fopen(words{3}, "w");
names = [{"t"}, arrayfun(@(i) sprintf("u%d", i), 1:n, "UniformOutput", false), arrayfun(@(i) sprintf("v%d", i), 1:n, "UniformOutput", false)];
fprintf(file, "%s\n", strjoin(names, ","));
fprintf(file, [repmat("%.17g,", 1, 2 * n), "%.17g\n"], table');
fprintf(file, "# seconds %g\n", cputime() - before);
fclose(file);
