"""Correct histories for false alarms: integrators x systems x steps x digits x sampling."""
import itertools

# Methods with the order that their impacts leave them, located on the step map.
METHODS = {
    "method=rk4": 1.0, "method=newmark": 1.0, "method=newmark beta=0": 1.0,
    "method=generalized-alpha rho=0.8": 1.0, "method=hht alpha=-0.1": 1.0, "method=bathe": 1.0,
    "method=midpoint": 1.0, "method=rk3": 1.0, "method=exact": 1.0, "method=rk4 contact=hermite": 1.0,
    "method=dopri5": 1.0, "method=wilson": 0.5,
}
PRINTS = ["", "digits=12", "digits=9", "every=4", "jumps", "separator=tab header=comment", "columns=PLAIN"]
ANY = ["exact", "proper", "reduced", "irregular", "stagnating", "divergent", "undecided"]
SYSTEMS = ["N2", "N0", "N5", "N1-undamped", "N2-damped", "N2-undamped", "stop", "stop-half", "symmetric",
           "symmetric-0.7", "synchronized", "synchronized-X7", "exact-data", "sdof"]


def sets(systems, most=0):
    """Sets of one to five correct histories; no cause may be named in any of them."""
    result = []
    layouts = itertools.cycle(["5", "1", "3", "1"])
    finer = itertools.cycle([1.0, 0.5, 0.7, 0.3])
    prints = itertools.cycle(PRINTS)
    for (method, share), name in itertools.product(METHODS.items(), SYSTEMS):
        for _ in range(2):
            words, layout = next(prints), next(layouts)
            single = name.startswith("stop") or name == "sdof"
            words = words.replace("PLAIN", "t,u1" if single else "t,u1,u2")
            result.append({
                "name": f"{method.split(' contact')[0].removeprefix('method=').replace(' ', ',')}-{name}-{len(result)}/{layout}",
                "system": name, "layout": layout, "group": "sweep", "solver": f"{method} {words}",
                "coarsest": systems[name]["coarsest"] * share * next(finer),
                "behaviour": ANY, "verdict": ["not-claimed", "agrees", "undecided"], "exit": [0, 3],
                "may_say": ["printed-digits", "ends-early"] if "digits" in words else ["ends-early"] if "every" in words else []})
        next(finer)
    return result[:most] if most else result
