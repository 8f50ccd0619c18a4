# julia test.jl: exact motions, and verdicts on runs of the shape that DifferentialEquations.jl gives, t and u = [u; v].
# scripts/julia runs it.
include("clackers.jl")
using .Clackers

xi, eta = 0.05, 0.7
exact = motion("stop"; eta = eta)

# Between impacts u'' + 2 xi u' + u = 0.
rate(x) = [x[2], -x[1] - 2xi * x[2]]
function rk4(x, h)
    k1 = rate(x); k2 = rate(x + h / 2 * k1); k3 = rate(x + h / 2 * k2); k4 = rate(x + h * k3)
    x + h / 6 * (k1 + 2k2 + 2k3 + k4)
end
struct Run
    t::Vector{Float64}
    u::Vector{Vector{Float64}}
end
# Impacts in the step by bisection, or at its end.
function run(steps, located)
    h, x = 20 / steps, [1.0, -0.05]
    states = [x]
    for _ in 1:steps
        y, rest = rk4(x, h), 0.0
        if y[1] < 0
            if located
                a, b = 0.0, h
                while b - a > 1e-15
                    m = (a + b) / 2
                    rk4(x, m)[1] < 0 ? (b = m) : (a = m)
                end
                y = rk4(x, b)
                y = rk4([0.0, -eta * y[2]], h - b)
            else
                y = [y[1], -eta * y[2]]
            end
        end
        push!(states, y)
        x = y
    end
    Run(collect(range(0, 20; length = steps + 1)), states)
end

t = [0.0, 1.0, 7.3, 19.9]
u = response(exact, t).u
w = sqrt(1 - xi^2)
closed(t) = eta^floor(w * t / pi + 0.5) * exp(-xi * t) * abs(cos(w * t))
@assert maximum(abs.(u[:, 1] - closed.(t))) < 1e-14
@assert length(impacts(exact, 20.0)) == 6
@assert abs(impacts(exact, 20.0)[1].t - pi / 2w) < 1e-15

ladder = [round(Int, 100 * 2^(k / 2)) for k in 0:9]
for (located, claim, verdict) in ((true, "proper:4", "Agrees"), (true, "proper:2", "Disagrees"),
                                  (false, "proper:4", "Disagrees"))
    words = check([run(n, located) for n in ladder], "stop"; settings = (eta = eta,), options = ["--expect", claim])
    println(split(words, "\n")[1])
    @assert startswith(words, verdict) words
end
