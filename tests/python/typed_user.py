"""A program that uses the package; test_types.py checks its types, and that it runs."""
from __future__ import annotations

import numpy as np
import numpy.typing as npt

import clackers


def total_energy(case: clackers.Case, t: npt.NDArray[np.float64]) -> float:
    table: clackers.Table = case.energies(t)
    return float(table["total"][0])


def largest(values: clackers.Kinematics) -> float:
    return float(np.abs(values.u).max())


def solver(problem: clackers.Problem, h: float) -> tuple[list[float], list[npt.NDArray[np.float64]]]:
    return [problem.start.t, problem.end], [problem.start.u, problem.start.u]


def main() -> None:
    case = clackers.case("three-parameter", N=2, xi1=0.05)
    t = np.linspace(0.0, case.end, 11)
    u, v, a = case.response(t, side="left")
    buffers = (np.empty_like(u), np.empty_like(v), None)
    position, velocity, nothing = case.response(t, out=buffers)
    assert nothing is None and position is buffers[0] and velocity is buffers[1]
    impacts: clackers.Impacts = case.impacts(first=1, last=2)
    problem: clackers.Problem = case.problem
    rate: npt.NDArray[np.float64] = problem.rhs(0.0, problem.y0)
    record: clackers.Record = clackers.verify("rk4", solver, case=case, expect="proper:2")
    order: float | None = record["rk4"].order
    causes: list[str] = [cause.code for cause in record["solver"].diagnoses]
    again: clackers.Record = clackers.check(t, u, v, case="three-parameter", N=2, impacts=impacts.t)
    figure: clackers.Figure = again.figure("response")
    compared: clackers.Comparison = clackers.compare((t, u), (t, u), tolerance=1e-9)
    difference: npt.NDArray[np.float64] = compared.differences["difference"]
    rows: list[tuple[str | float | int | None, ...]] = compared.sets.rows
    frame, dataset = again.to_pandas(), compared.sets.to_xarray()
    names: list[str] = [column.name for column in case.spectrum(3, 1.0).columns]
    tables: dict[str, clackers.Table] = clackers.catalogue()
    try:
        clackers.case("stop", eta=2)
    except clackers.InputError as error:
        code: str = error.code
        print(code, clackers.__version__)
    print(total_energy(case, t), largest(case.error_bound(t)), len(impacts), rate.shape, names, len(tables))
    print(order, causes, figure.name, difference.max(), len(rows), len(frame), len(dataset))


if __name__ == "__main__":
    main()
