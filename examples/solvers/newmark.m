% Newmark's average acceleration for one contact at most; at the end of a step with a negative gap
% the velocity is reversed: irregular, of order 1.
%   octave-cli newmark.m PROBLEM.json H HISTORY
1;
function [u, v, a] = step(p, S, h, u, v, a)
  up = u + h * v + h^2 / 4 * a;
  vp = v + h / 2 * a;
  a = -(S \ (p.C * vp + p.K * up));
  u = up + h^2 / 4 * a;
  v = vp + h / 2 * a;
end

arguments = argv();
p = jsondecode(fileread(arguments{1})).problem;
% jsondecode renames "end", a keyword, to "xEnd".
n = round((p.xEnd - p.start.t) / str2double(arguments{2}));
h = (p.xEnd - p.start.t) / n;
S = p.M + h / 2 * p.C + h^2 / 4 * p.K;
u = p.start.u;
v = p.start.v;
a = -(p.M \ (p.C * v + p.K * u));
rows = zeros(n + 1, 1 + 2 * numel(u));
rows(1, :) = [p.start.t, u', v'];
for i = 1:n
  [u, v, a] = step(p, S, h, u, v, a);
  for k = 1:numel(p.contacts)
    contact = p.contacts(k);
    b = contact.direction;
    if b' * u < contact.gap && b' * v < 0
      push = p.M \ b;
      v -= (1 + contact.restitution) * (b' * v) / (b' * push) * push;
      a = -(p.M \ (p.C * v + p.K * u));
    end
  end
  rows(i + 1, :) = [p.start.t + i * h, u', v'];
end
file = fopen(arguments{3}, 'w');
masses = 1:numel(u);
fprintf(file, 't%s%s\n', sprintf(',u%d', masses), sprintf(',v%d', masses));
fprintf(file, ['%.17g', repmat(',%.17g', 1, 2 * numel(u)), '\n'], rows');
fclose(file);
