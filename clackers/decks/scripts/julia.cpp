#include "clackers/decks/rows.hpp"
#include "clackers/decks/scripts/data.hpp"
#include "clackers/decks/text.hpp"

namespace clackers::decks {
namespace {

constexpr Syntax julia_syntax = {
    .comment = "#",
    .table = "const @name@ = Matrix(reshape(Float64[@values@], @columns@, :)')\n",
    .vector = "const @name@ = Float64[@values@]\n",
    .number = "const @name@ = @value@\n",
    .line = "",
};

constexpr auto julia_model = R"jl(@head@# Usage: julia model.jl TOLERANCE HISTORY.csv
using LinearAlgebra, OrdinaryDiffEq

@data@
const tolerance = parse(Float64, ARGS[1])
const n = length(u0)

function motion!(dy, y, p, t)
    u, v = y[1:n], y[n+1:end]
    force = -C * v - K * u
    for (mass, amplitude, frequency, phase) in eachrow(loads)
        force[Int(mass)] += amplitude * cos(frequency * t + phase)
    end
    for row in eachrow(springs)
        force -= row[n+2] * min(dot(row[1:n], u) - row[n+1], 0.0) * row[1:n]
    end
    dy[1:n] = v
    dy[n+1:end] = M \ force
end

# Newton's law, one contact after the other, until none of those that touch is closing.
function impacts!(integrator, events...)
    u, v = view(integrator.u, 1:n), view(integrator.u, n+1:2n)
    for _ in 1:1000
        k = findfirst(c -> dot(c[1:n], u) - c[n+1] < tolerance && dot(c[1:n], v) < 0, eachrow(contacts))
        isnothing(k) && return
        b = contacts[k, 1:n]
        jump = M \ b
        v .-= (1 + contacts[k, n+2]) * dot(b, v) / dot(b, jump) * jump
    end
    error("Several contacts stay closed: this script has no rule for that.")
end

gaps!(out, y, t, integrator) = (out .= contacts[:, 1:n] * y[1:n] - contacts[:, n+1])
# The third argument is for falling gaps. Both rows of an impact are saved.
callback = VectorContinuousCallback(gaps!, nothing, impacts!, size(contacts, 1); save_positions = (true, true))
problem = ODEProblem(motion!, [u0; v0], (t0, last))
found = size(contacts, 1) > 0 ? solve(problem, Tsit5(); reltol = tolerance, abstol = tolerance, callback) :
        solve(problem, Tsit5(); reltol = tolerance, abstol = tolerance)
open(ARGS[2], "w") do file
    println(file, join(["t"; ["u$i" for i in 1:n]; ["v$i" for i in 1:n]], ","))
    for (t, y) in zip(found.t, found.u)
        println(file, join([t; y], ","))
    end
end
)jl";

}  // namespace

std::vector<DeckFile> julia(const Subject& subject) {
  return {{"model.jl", filled(julia_model, {{"head", head(subject, "julia", "#")},
                                            {"data", data(subject.problem, julia_syntax)}})},
          run_script(subject, tolerances(), "julia model.jl \"$2\" \"$1.csv\"", ".csv",
                     "--expect proper:1")};
}

}  // namespace clackers::decks
