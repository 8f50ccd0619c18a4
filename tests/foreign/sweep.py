"""Correct histories for false alarms: integrators x systems x steps x digits x sampling."""
import itertools

# Integrators with the share of the usual coarsest step at which they start.
METHODS = {
    "method=rk4": 1.0, "method=newmark": 1.0, "method=newmark beta=0": 1.0,
    "method=generalized-alpha rho=0.8": 1.0, "method=hht alpha=-0.1": 1.0, "method=bathe": 1.0,
    "method=midpoint": 1.0, "method=rk3": 1.0, "method=exact": 1.0, "method=rk4 contact=hermite": 1.0,
    "method=dopri5": 1.0, "method=wilson": 0.5,
}
# Treatments of contact that limit the order by themselves; the cause may be named, it is no fault.
CONTACTS = {
    "method=rk4 contact=end-of-step": "impact-at-step-end", "contact=moreau": "impact-at-step-end",
    "method=newmark contact=start-of-step": "impact-at-step-end", "contact=paoli": "impact-at-step-end",
    "method=newmark contact=linear": "impact-interpolated",
    "method=newmark contact=linear-time": "impact-interpolated",
}
PRINTS = ["", "digits=12", "digits=9", "every=4", "jumps", "separator=tab header=comment", "columns=PLAIN",
          "restart-grid", "single-output"]
MAY_SAY = {"digits=12": ["printed-digits"], "digits=9": ["printed-digits"], "every=4": ["ends-early"],
           "single-output": ["single-precision", "noise-floor"]}
ANY = ["exact", "proper", "reduced", "irregular", "stagnating", "divergent", "undecided"]
SYSTEMS = ["N2", "N0", "N5", "N1-undamped", "N2-damped", "N2-undamped", "stop", "stop-half", "symmetric",
           "symmetric-0.7", "synchronized", "synchronized-X7", "exact-data", "sdof"]
# Any number of masses, contacts and loads (assemblies/).
MANY = ["forced", "shaken", "frame", "chain", "driven-stop", "tower", "row3", "row5", "row7-0.8", "row10", "buildings",
        "buildings-0.8", "alternating", "assembly2", "assembly4"]
MANY_METHODS = ["method=rk4", "method=newmark", "method=newmark beta=0", "method=generalized-alpha rho=0.8",
                "method=hht alpha=-0.1", "method=midpoint", "method=rk3", "method=dopri5", "method=series"]
MANY_PRINTS = ["", "digits=12", "no-velocities", "jumps", "digits=9"]


def correct(name, system, layout, solver, coarsest, may_say):
    return {"name": f"{name}/{layout}", "system": system, "layout": layout, "group": "sweep", "solver": solver,
            "coarsest": coarsest, "behaviour": [word for word in ANY if word != "divergent"],
            "verdict": ["not-claimed", "agrees", "undecided"], "exit": [0, 3], "may_say": may_say}


def sets(systems, most=0):
    """Sets of one to twenty correct histories; no cause may be named in any of them."""
    result = []

    def add(solver, system, layout, share, may_say):
        words = solver.replace("method=", "").replace("contact=", "").split()
        coarsest = systems[system]["coarsest"] * share
        result.append(correct(f"{len(result)}-{'+'.join(words)}-{system}", system, layout, solver, coarsest, may_say))

    layouts = itertools.cycle(["5", "1", "3", "1", "12", "1", "4"])
    finer = itertools.cycle([1.0, 0.5, 0.7, 0.3, 0.8])
    prints = itertools.cycle(PRINTS)
    for (method, share), system in itertools.product(METHODS.items(), SYSTEMS):
        for _ in range(2):
            words, layout, factor = next(prints), next(layouts), share * next(finer)
            if layout == "12":
                factor = share
            plain = "t,u1" if system.startswith("stop") or system == "sdof" else "t,u1,u2"
            add(f"{method} {words.replace('PLAIN', plain)}".rstrip(), system, layout, factor, MAY_SAY.get(words, []))
    for (method, cause), system in itertools.product(CONTACTS.items(), SYSTEMS[:-1]):
        if system != "N5":
            add(method, system, next(layouts), 0.5 * next(finer), [cause])
    prints = itertools.cycle(MANY_PRINTS)
    for method, system in itertools.product(MANY_METHODS, MANY):
        words, layout = next(prints), next(layouts)
        add(f"{method} {words}".rstrip(), system, layout, 1.0 if layout == "12" else next(finer), MAY_SAY.get(words, []))
    for system in SYSTEMS:
        if not system.startswith("stop") and system != "sdof":
            result.append(correct(f"{len(result)}-adaptive-{system}", system, "tolerances", "spacing=0.01", 1.0, []))
    return result[:most] if most else result
