#include "clackers/decks/rows.hpp"
#include "clackers/decks/scripts/data.hpp"
#include "clackers/decks/text.hpp"

namespace clackers::decks {
namespace {

constexpr Syntax python = {
    .comment = "#",
    .table = "@name@ = numpy.reshape([@values@], (-1, @columns@))\n",
    .vector = "@name@ = numpy.array([@values@], float)\n",
    .number = "@name@ = @value@\n",
    .line = "",
};

constexpr auto scipy_model = R"py(@head@# Usage: python3 model.py TOLERANCE HISTORY.csv
import sys

import numpy
from scipy.integrate import solve_ivp

@data@
tolerance, n = float(sys.argv[1]), len(M)


def motion(t, y):
    u, v = y[:n], y[n:]
    force = -C @ v - K @ u
    for mass, amplitude, frequency, phase in loads:
        force[int(mass) - 1] += amplitude * numpy.cos(frequency * t + phase)
    for row in springs:
        force -= row[n + 1] * min(row[:n] @ u - row[n], 0.0) * row[:n]
    return numpy.concatenate([v, numpy.linalg.solve(M, force)])


def gap_of(contact):
    def gap(t, y):
        return contact[:n] @ y[:n] - contact[n]

    gap.terminal, gap.direction = True, -1  # closing: without it the restart on the surface is an event again
    return gap


def impacts(y):
    """Newton's law, one contact after the other, until none of those that touch is closing."""
    for _ in range(1000):
        closing = [c for c in contacts if c[:n] @ y[:n] - c[n] < tolerance and c[:n] @ y[n:] < 0.0]
        if not closing:
            return
        b = closing[0][:n]
        jump = numpy.linalg.solve(M, b)
        y[n:] -= (1.0 + closing[0][n + 1]) * (b @ y[n:]) / (b @ jump) * jump
    sys.exit("Several contacts stay closed: this script has no rule for that.")


events = [gap_of(contact) for contact in contacts]
t, y = t0, numpy.concatenate([u0, v0])
rows = [[t, *y]]
while t < last:
    # No max_step: the contact must not close and open within a step.
    run = solve_ivp(motion, (t, last), y, method="RK45", rtol=tolerance, atol=tolerance, events=events or None)
    if not run.success:
        sys.exit(run.message)
    rows += [[s, *state] for s, state in zip(run.t[1:], run.y.T[1:])]
    if any((c[:n] @ run.y[:n]).min() < c[n] - 0.01 * abs(run.y[:n]).max() for c in contacts):
        sys.exit("A contact stays closed, or closes and opens within a step.")
    previous, t, y = t, run.t[-1], run.y[:, -1].copy()
    if run.status == 0:
        break
    if t - previous < 1e-12 * last:
        sys.exit("A contact stays closed: this script has no rule for that.")
    impacts(y)
    rows.append([t, *y])
header = ",".join(["t", *(f"{name}{i + 1}" for name in "uv" for i in range(n))])
numpy.savetxt(sys.argv[2], rows, fmt="%.17g", delimiter=",", header=header, comments="")
)py";

}  // namespace

std::vector<DeckFile> scipy(const Subject& subject) {
  return {{"model.py", filled(scipy_model, {{"head", head(subject, "scipy", "#")},
                                            {"data", data(subject.problem, python)}})},
          run_script(subject, tolerances(), "\"${PYTHON:-python3}\" model.py \"$2\" \"$1.csv\"",
                     ".csv", "--expect proper:1")};
}

}  // namespace clackers::decks
