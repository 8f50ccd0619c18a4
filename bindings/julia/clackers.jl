# Exact motions in Julia by the C library, and verdicts by the command. include() this file. The variables
# CLACKERS_LIBRARY and CLACKERS of the environment name libclackers.so.0 and the command where they are not found.
# Run by scripts/julia with Julia 1.5.3.
module Clackers

export motion, response, impacts, check

const library = get(ENV, "CLACKERS_LIBRARY", "libclackers.so.0")

struct Setting
    name::Ptr{UInt8}
    value::Cdouble
end
struct Buffers
    struct_size::Csize_t
    capacity::Csize_t
    u::Ptr{Cdouble}
    v::Ptr{Cdouble}
    a::Ptr{Cdouble}
end
struct Impact  # clackers_impact
    struct_size::Csize_t
    index::Int64
    contact::Int64
    t::Cdouble
    t_lo::Cdouble
    t_hi::Cdouble
    impulse::Cdouble
    energy_before::Cdouble
    energy_after::Cdouble
end

"A case with its exact motion."
mutable struct Motion
    handle::Ptr{Cvoid}
end

function require(status)
    status == 0 || error(unsafe_string(ccall((:clackers_last_error, library), Cstring, ())))
end

"The exact motion of a case: `motion(\"stop\"; eta = 0.7)`."
function motion(case; settings...)
    names = [string(name) for name in keys(settings)]
    handle = Ref{Ptr{Cvoid}}(C_NULL)
    GC.@preserve names begin
        list = [Setting(pointer(name), value) for (name, value) in zip(names, values(values(settings)))]
        require(ccall((:clackers_case_create, library), Int32, (Cstring, Ptr{Setting}, Csize_t, Ptr{Ptr{Cvoid}}),
                      case, list, length(list), handle))
    end
    finalizer(m -> ccall((:clackers_motion_destroy, library), Cvoid, (Ptr{Cvoid},), m.handle), Motion(handle[]))
end

function masses(m::Motion)
    dof = Ref{Int32}(0)
    require(ccall((:clackers_motion_dof, library), Int32, (Ptr{Cvoid}, Ptr{Int32}), m.handle, dof))
    Int(dof[])
end

"Displacements [m], velocities [m/s] and accelerations [m/s^2] at times [s], a row a time; at an impact those after it,
or before it with `side = 0`."
function response(m::Motion, times; side = 1)
    t = collect(Cdouble, times)
    u, v, a = (zeros(masses(m), length(t)) for _ in 1:3)
    GC.@preserve u v a begin
        out = Ref(Buffers(sizeof(Buffers), length(u), pointer(u), pointer(v), pointer(a)))
        require(ccall((:clackers_motion_sample, library), Int32, (Ptr{Cvoid}, Ptr{Cdouble}, Csize_t, Int32, Ptr{Buffers}),
                      m.handle, t, length(t), side, out))
    end
    (u = permutedims(u), v = permutedims(v), a = permutedims(a))
end

"The impacts up to a time: contact (1 for the first), t [s], impulse [N s]."
function impacts(m::Motion, t)
    count = Ref{Int64}(0)
    require(ccall((:clackers_motion_impact_count, library), Int32, (Ptr{Cvoid}, Cdouble, Ptr{Int64}), m.handle, t, count))
    map(1:count[]) do index
        found = Ref(Impact(sizeof(Impact), 0, 0, 0, 0, 0, 0, 0, 0))
        require(ccall((:clackers_motion_impact, library), Int32, (Ptr{Cvoid}, Int64, Ptr{Impact}, Ptr{Buffers}, Ptr{Buffers}),
                      m.handle, index, found, C_NULL, C_NULL))
        (contact = found[].contact + 1, t = found[].t, impulse = found[].impulse)
    end
end

"Judges a ladder of runs, each of another step or tolerance, and returns the text of `clackers check`: solutions of
DifferentialEquations.jl with the state [u; v], or anything else with `t` and `u`.
`check(solutions, \"stop\"; settings = (eta = 0.7,), options = [\"--expect\", \"proper:1\"])`"
function check(runs, case; settings = (;), options = String[])
    program = get(ENV, "CLACKERS", "clackers")
    mktempdir() do folder
        files = map(enumerate(runs)) do (k, run)
            n = length(first(run.u)) ÷ 2
            file = joinpath(folder, "run$(lpad(k, 2, '0')).csv")
            open(file, "w") do out
                println(out, join(["t"; ["u$i" for i in 1:n]; ["v$i" for i in 1:n]], ","))
                for (t, y) in zip(run.t, run.u)
                    println(out, join([t; y], ","))
                end
            end
            file
        end
        words = ["--set=$name=$value" for (name, value) in pairs(settings)]
        # 1 is a verdict against a claim, 3 is undecided.
        read(ignorestatus(`$program check $files --case $case $words $options --quiet`), String)
    end
end

end
