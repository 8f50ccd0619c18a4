// Scilab's ode("root"): LSODAR; it has no filter for the direction, so a restart is moved onto the surface.
//     scilab-cli -nb -f scilab_root.sce -args PROBLEM.txt TOLERANCE HISTORY.csv
words = sciargs();
words = words($-2:$);
lines = mgetl(words(1));
problem = struct();
for i = 1:size(lines, 1)
  [name, value] = (part(lines(i), 1:strindex(lines(i), "=")(1) - 1), part(lines(i), strindex(lines(i), "=")(1) + 1:$));
  execstr("problem." + name + " = [" + value + "];");
end
n = problem.dof;
function a = rows_of(name, count)
  a = [];
  for i = 1:count
    execstr("a = [a; problem." + name + string(i) + "];");
  end
endfunction
M = rows_of("M", n); C = rows_of("C", n); K = rows_of("K", n);
B = rows_of("direction", problem.contacts); gap = rows_of("gap", problem.contacts); eta = rows_of("restitution", problem.contacts);
A = [zeros(n, n), eye(n, n); -M \ K, -M \ C];
function out = motion(t, y)
  out = A * y;
endfunction
function out = gaps(t, y)
  out = B * y(1:n) - gap;
endfunction
tolerance = strtod(words(2));
times = problem.t + (problem.end - problem.t) * (1:2000) / 2000;
t = problem.t; y = [problem.u, problem.v]';
table = [t, y'];
while t < problem.end
  [states, found] = ode("root", y, t, times(times > t), tolerance, tolerance, motion, problem.contacts, gaps);
  later = times(times > t);
  k = size(states, 2);
  if found == [] then
    table = [table; later(1:k)', states'];
    break;
  end
  table = [table; later(1:k - 1)', states(:, 1:k - 1)'];
  t = found(1); y = states(:, k);
  table = [table; t, y'];
  for c = 2:length(found)
    b = B(found(c), :)';
    push = M \ b;
    if b' * y(n + 1:2 * n) < 0 then
      y(n + 1:2 * n) = y(n + 1:2 * n) - (1 + eta(found(c))) * (b' * y(n + 1:2 * n)) / (b' * push) * push;
    end
    y(1:n) = y(1:n) - (b' * y(1:n) - gap(found(c)) - 1e-15) / (b' * push) * push;
  end
  table = [table; t, y'];
end
file = mopen(words(3), "w");
mfprintf(file, "t" + strcat(",u" + string(1:n)) + strcat(",v" + string(1:n)) + "\n");
mfprintf(file, strcat(emptystr(1, 2 * n) + "%.17g,") + "%.17g\n", table);
mclose(file);
exit(0);
