#include "clackers/decks/rows.hpp"
#include "clackers/decks/scripts/data.hpp"
#include "clackers/decks/text.hpp"

namespace clackers::decks {
namespace {

constexpr Syntax matlab = {
    .comment = "%",
    .table = "p.@name@ = reshape([@values@], @columns@, [])';\n",
    .vector = "p.@name@ = [@values@]';\n",
    .number = "p.@name@ = @value@;\n",
    .line = " ...",
};

constexpr auto octave_model =
    R"m(@head@% Usage: octave-cli model.m, in MATLAB: model, with the variables TOLERANCE and HISTORY of the environment.
function model()
@data@
tolerance = str2double(getenv('TOLERANCE'));
n = numel(p.u0);
warning('off', 'integrate_adaptive:unexpected_termination');  % of an event, in Octave
options = odeset('RelTol', tolerance, 'AbsTol', tolerance, 'Refine', 1, 'Events', @(t, y) gaps(y, p));
flow = @(t, y) motion(t, y, p);
t = p.t0; y = [p.u0; p.v0]; table = [t, y'];
while t < p.last
  [times, states, te, ye, ie] = ode45(flow, [t, p.last], y, options);
  before = max(1, numel(times) - 1);
  y = states(end, :)';
  if isempty(ie)
    table = [table; times(2:end), states(2:end, :)];
    break
  end
  % Octave's event is a linear interpolation between two steps: Newton's method from the step before it.
  k = ie(end); b = p.contacts(k, 1:n); s = te(end);
  for trial = 1:6
    if s > times(before)
      [~, inner] = ode45(flow, [times(before), s], states(before, :)', odeset(options, 'Events', []));
      y = inner(end, :)';
    end
    s = min(p.last, s - (b * y(1:n) - p.contacts(k, n + 1)) / (b * y(n+1:end)));
  end
  if s - t < 1e-12 * p.last
    error('A contact stays closed: this script has no rule for that.');
  end
  table = [table; times(2:before), states(2:before, :); s, y'];
  t = s; y = impacts(y, p, tolerance);
  table = [table; t, y'];
end
if any(any(table(:, 2:n+1) * p.contacts(:, 1:n)' < p.contacts(:, n + 1)' - 0.01 * max(max(abs(table(:, 2:n+1))))))
  error('A contact stays closed, or closes and opens within a step.');
end
file = fopen(getenv('HISTORY'), 'w');
fprintf(file, 't'); fprintf(file, ',u%d', 1:n); fprintf(file, ',v%d', 1:n);
fprintf(file, ['\n%.17g', repmat(',%.17g', 1, 2 * n)], table');
fprintf(file, '\n');
fclose(file);
end

function dy = motion(t, y, p)
n = numel(p.u0); u = y(1:n); v = y(n+1:end);
force = -p.C * v - p.K * u;
for load = p.loads'
  force(load(1)) = force(load(1)) + load(2) * cos(load(3) * t + load(4));
end
for row = p.springs'
  force = force - row(n + 2) * min(row(1:n)' * u - row(n + 1), 0) * row(1:n);
end
dy = [v; p.M \ force];
end

function [value, stop, direction] = gaps(y, p)
n = numel(p.u0);
value = p.contacts(:, 1:n) * y(1:n) - p.contacts(:, n + 1);
stop = ones(size(value));
direction = -ones(size(value));  % closing: without it the restart on the surface is an event again
end

% Newton's law, one contact after the other, until none of those that touch is closing.
function y = impacts(y, p, tolerance)
n = numel(p.u0);
for trial = 1:1000
  k = find(gaps(y, p) < tolerance & p.contacts(:, 1:n) * y(n+1:end) < 0, 1);
  if isempty(k)
    return
  end
  b = p.contacts(k, 1:n); jump = p.M \ b';
  y(n+1:end) = y(n+1:end) - (1 + p.contacts(k, n + 2)) * (b * y(n+1:end)) / (b * jump) * jump;
end
error('Several contacts stay closed: this script has no rule for that.');
end
)m";

}  // namespace

std::vector<DeckFile> octave(const Subject& subject) {
  return {{"model.m", filled(octave_model, {{"head", head(subject, "octave", "%")},
                                            {"data", data(subject.problem, matlab)}})},
          run_script(subject, tolerances(),
                     "TOLERANCE=\"$2\" HISTORY=\"$1.csv\" octave-cli --quiet --eval model", ".csv",
                     "--expect proper:1")};
}

}  // namespace clackers::decks
