"""What `clackers check` said of a set, compared with the expert's word."""
import json
import math

EXIT_OF = {"agrees": 0, "not-claimed": 0, "disagrees": 1, "undecided": 3}
# What a correct method has too: its dispersion and its dissipation, both falling with the step.
ALWAYS_ALLOWED = {"period-error", "numerical-damping"}
# Causes that say that the solver solves another system: their limit is a wrong one as well.
OF_THE_MODEL = {"restitution-differs", "mass-ratio-differs", "frequency-differs", "damping-differs",
                "damping-changes-at-impact", "gap-differs", "impact-missed", "impact-doubled",
                "impact-impulse-wrong", "contact-compliant", "contact-in-tension"}


def number(diagnosis):
    """The value of a cause; NaN for none."""
    value = diagnosis["value"]
    return math.nan if value is None else float(value)


class Answer:
    """What the command said of a set."""

    def __init__(self, done):
        self.exit, self.text = done.returncode, done.stderr.strip()
        self.refused = self.text.rsplit("[", 1)[-1].rstrip("]") if done.returncode == 2 else ""
        self.behaviour = self.verdict = self.reason = ""
        self.order, self.diagnoses = None, {}
        if done.returncode in (0, 1, 3):
            subject = json.loads(done.stdout)["cases"][0]["subjects"][0]
            assessment = subject["assessment"]
            fit = assessment["displacement"]
            self.behaviour, self.verdict = fit["behaviour"], assessment["verdict"].replace(" ", "-")
            self.reason, self.order = fit["reason"] or assessment["reason"], fit["order"] if fit["has_line"] else None
            self.diagnoses = {d["code"]: d for d in subject.get("diagnoses", ())}

    def __str__(self):
        if self.exit not in (0, 1, 3):
            return f"refused {self.refused}" if self.refused else f"exit {self.exit}: {self.text[-200:]}"
        order = "" if self.order is None else f" {self.order:.2f}"
        reason = f" [{self.reason}]" if self.reason else ""
        causes = ", ".join(code if math.isnan(number(d)) else f"{code} {number(d):.5g} {d.get('unit') or ''}".rstrip()
                           for code, d in self.diagnoses.items())
        return f"{self.behaviour}{order}{reason}, {self.verdict}, {self.exit}" + (f"; {causes}" if causes else "")


def expert(one):
    """The expert's word on one line."""
    if "refused" in one and not one.get("or_judged"):
        return "refused " + "|".join(one["refused"])
    order = " {}-{}".format(*one["order"]) if "order" in one else ""
    causes = ", ".join(code + (" {}..{}".format(*values) if values else "")
                       for code, values in one.get("says", {}).items())
    text = f"{'|'.join(one['behaviour'])}{order}, {'|'.join(one['verdict'])}"
    return text + (f"; {causes}" if causes else "") + (" (or refused)" if "refused" in one else "")


def value_fits(code, diagnosis, values):
    value = number(diagnosis)
    if not values:
        return True
    if diagnosis.get("unit") == "%":
        value /= 100.0
    if code in ("time-shifted", "time-drifts"):
        value = abs(value)
    return values[0] <= value <= values[1]


def faults(one, answer):
    """What differs from the expert's word; empty where nothing does."""
    if answer.exit not in (0, 1, 2, 3):
        return [f"exit {answer.exit}"]
    if answer.exit == 2:
        return [] if answer.refused in one.get("refused", ()) else [f"refused [{answer.refused}]"]
    if "refused" in one and not one.get("or_judged"):
        return ["not refused"]
    wrong = []
    if answer.behaviour not in one["behaviour"]:
        wrong.append(f"behaviour {answer.behaviour}")
    elif "order" in one and answer.behaviour in ("proper", "reduced", "irregular") and (
            answer.order is None or not one["order"][0] <= answer.order <= one["order"][1]):
        wrong.append(f"order {answer.order}")
    if answer.verdict not in one["verdict"]:
        wrong.append(f"verdict {answer.verdict}")
    exits = one.get("exit", [EXIT_OF[verdict] for verdict in one["verdict"]])
    if answer.exit not in exits:
        wrong.append(f"exit {answer.exit}")
    allowed = ALWAYS_ALLOWED | set(one.get("may_say", ()))
    for codes, values in one.get("says", {}).items():
        names = codes.split("|")
        allowed |= set(names)
        if OF_THE_MODEL & set(names):
            allowed.add("wrong-limit")
        found = [name for name in names if name in answer.diagnoses]
        if not found:
            wrong.append(f"does not say {codes}")
        elif not any(value_fits(name, answer.diagnoses[name], values) for name in found):
            wrong.append(f"value of {found[0]}: {answer.diagnoses[found[0]]['value']}")
    wrong += [f"says {code}" for code in answer.diagnoses if code not in allowed]
    return wrong
