"""Two masses on springs with a compression-only penalty spring between them, for CalculiX."""
import os

import calculix


def deck(pair, stiffness, step, end):
    """The input of an implicit direct dynamic run without damping, Newmark's average acceleration."""
    # A whole number without a point is not read as a stiffness.
    pair = {name: float(value) for name, value in pair.items() if isinstance(value, (int, float))}
    return f"""** Mass 1 at x = 1, mass 2 at x = 0: the spring between them is shortened by u2 - u1.
*NODE, NSET=BOTH
1, 1., 0., 0.
2, 0., 0., 0.
*ELEMENT, TYPE=MASS, ELSET=MASS1
1, 1
*MASS, ELSET=MASS1
{pair["m1"]!r}
*ELEMENT, TYPE=MASS, ELSET=MASS2
2, 2
*MASS, ELSET=MASS2
{pair["m2"]!r}
*ELEMENT, TYPE=SPRING1, ELSET=SPRING1
3, 1
*SPRING, ELSET=SPRING1
1
{pair["k1"]!r}
*ELEMENT, TYPE=SPRING1, ELSET=SPRING2
4, 2
*SPRING, ELSET=SPRING2
1
{pair["k2"]!r}
*ELEMENT, TYPE=SPRINGA, ELSET=CONTACT
5, 2, 1
*SPRING, ELSET=CONTACT, NONLINEAR
{-float(stiffness)!r}, -1.
0., 0.
0., 10.
*BOUNDARY
1, 2, 3
2, 2, 3
*INITIAL CONDITIONS, TYPE=DISPLACEMENT
1, 1, {pair["u1(0)"]!r}
2, 1, {pair["d2"]!r}
*STEP, NLGEOM, INC=10000000
*DYNAMIC, DIRECT, ALPHA=0.
{step!r}, {end!r}
*NODE PRINT, NSET=BOTH
U, V
*END STEP
"""


def run(folder, pair, stiffness, step, end, history):
    """Writes the history of a run, with the digits that CalculiX prints."""
    with open(os.path.join(folder, "pair.inp"), "w") as file:
        file.write(deck(pair, stiffness, step, end))
    rows = calculix.run(folder, "pair")
    with open(history, "w") as file:
        file.write("t u1 v1 u2 v2\n")
        file.writelines("  ".join([t, row["u1"], row["v1"], row["u2"], row["v2"]]) + "\n" for t, row in rows.items())
