% Octave's ode45 and ode23 with events, and a hand-written Newmark loop, as foreign solvers: the lines
% of solvers.cpp on standard input, each with problem=FILE, `method=octave-ode45 tolerance=1e-6 ...`.
% Octave 7 finds events by a chord between printed rows; that is its own, no fault added here.
1;

function value = word(words, name, fallback)
  value = fallback;
  for i = 1:numel(words)
    pair = strsplit(words{i}, "=");
    if strcmp(pair{1}, name)
      value = pair{end};
      if ! ischar(fallback)
        value = str2double(value);
        if numel(pair) == 1, value = 1; end
      end
    end
  end
end

function p = read_problem(words)
  file = fopen(word(words, "problem", ""));
  x = fscanf(file, "%g");
  fclose(file);
  n = x(1); p.n = n; p.contacts = x(2); p.end = x(4);
  blocks = {[n, n], [n, n], [n, n], [1, n], [1, n], [p.contacts, n + 2], [x(3), 4]};
  at = 4;
  for i = 1:numel(blocks)
    size = blocks{i};
    blocks{i} = reshape(x(at + 1:at + prod(size)), size(2), size(1))';
    at += prod(size);
  end
  [p.M, p.C, p.K, u0, v0, contacts, loads] = blocks{:};
  p.u0 = u0'; p.v0 = v0';
  p.G = contacts(:, 1:n); p.gap = contacts(:, n + 1); p.eta = contacts(:, n + 2);
  other = word(words, "solver-eta", NaN);
  if ! isnan(other), p.eta(:) = other; end
  p.K(1, 1) *= word(words, "k11*", 1);
  p.C *= word(words, "c*", 1);
  p.L = zeros(n, rows(loads));
  for i = 1:rows(loads), p.L(loads(i, 1), i) = loads(i, 2) * word(words, "load*", 1); end
  p.nu = loads(:, 3); p.phase = loads(:, 4) - p.nu * word(words, "load-late", 0);
end

function v = after_impact(p, words, v, active)
  G = p.G(active, :);
  jump = p.M \ (G' * ((G * (p.M \ G')) \ (-(1 + p.eta(active)) .* (G * v))));
  if word(words, "one-mass", 0), jump(2:end) = 0; end
  v += jump;
end

function [gap, stop, direction] = contact_event(p, x, terminal)
  gap = p.G * x(1:p.n) - p.gap;
  stop = terminal * ones(p.contacts, 1);
  direction = -ones(p.contacts, 1);
end

function rows = adaptive(p, words, solver)
  n = p.n;
  flow = @(t, x) [x(n + 1:end); p.M \ (p.L * cos(p.nu * t + p.phase) - p.C * x(n + 1:end) - p.K * x(1:n))];
  tolerance = word(words, "tolerance", 1e-6);
  terminal = ! word(words, "not-terminal", 0);
  options = odeset("RelTol", tolerance, "AbsTol", tolerance * 1e-2, "MaxStep", 0.1, ...
                   "Events", @(t, x) contact_event(p, x, terminal));
  grid = (0:round(p.end / 0.01))' * 0.01;
  t = 0; x = [p.u0; p.v0]; rows = [t, x'];
  while t < p.end - 1e-9
    ahead = grid(grid > t + 1e-9);
    if word(words, "own-steps", 0) || numel(ahead) < 2, ahead = p.end; end
    [T, Y] = solver(flow, [t; ahead], x, options);
    hit = terminal && T(end) < p.end - 1e-9;
    keep = numel(T) - hit;
    rows = [rows; T(2:keep), Y(2:keep, :)];
    if ! hit, break; end
    t = T(end); x = Y(end, :)';
    if word(words, "last-row", 0), x = Y(end - 1, :)'; end
    active = (abs(p.G * x(1:n) - p.gap) < 1e-3) & (p.G * x(n + 1:end) < 0);
    if ! any(active), [~, first] = min(p.G * x(1:n) - p.gap); active(first) = true; end
    x(n + 1:end) = after_impact(p, words, x(n + 1:end), active);
  end
end

function rows = newmark(p, words)
  n = round(word(words, "n", 1000)); h = p.end / n;
  f = @(t) p.L * cos(p.nu * t + p.phase);
  D = p.M + h / 2 * p.C + h^2 / 4 * p.K;
  inverse = inv(D); late = word(words, "load-at-start", 0);
  u = p.u0; v = p.v0; a = p.M \ (f(0) - p.C * v - p.K * u);
  if word(words, "a0-zero", 0), a(:) = 0; end
  stale = word(words, "stale", 0);
  rows = zeros(n + 1, 1 + 2 * p.n); rows(1, :) = [0, u', v'];
  for i = 1:n
    up = u + h * v + h^2 / 4 * a; vp = v + h / 2 * a;
    a = inverse * (f((i - late) * h) - p.C * vp - p.K * up);
    u = up + h^2 / 4 * a; v = vp + h / 2 * a;
    active = (p.G * u < p.gap) & (p.G * v < 0);
    if any(active)
      v = after_impact(p, words, v, active);
      if ! stale, a = p.M \ (f(i * h) - p.C * v - p.K * u); end
    end
    rows(i + 1, :) = [i * h, u', v'];
  end
end

warning("off", "integrate_adaptive:unexpected_termination");
while ischar(line = fgetl(stdin))
  words = strsplit(strtrim(line), " ");
  p = read_problem(words);
  name = strrep(word(words, "method", ""), "octave-", "");
  if strcmp(name, "newmark"), rows = newmark(p, words); else rows = adaptive(p, words, str2func(name)); end
  order = [1, reshape([2:p.n + 1; p.n + 2:2 * p.n + 1], 1, [])];
  file = fopen(words{1}, "w");
  fprintf(file, "t%s\n", sprintf(",u%d,v%d", [1:p.n; 1:p.n]));
  fprintf(file, ["%.17g", repmat(",%.17g", 1, 2 * p.n), "\n"], rows(:, order)');
  fclose(file);
end
