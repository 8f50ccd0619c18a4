"""The gallery: a card for each method and each case, from the record of `verify --all` and `clackers cite`."""
import html
import math

SEARCH = """<script>
document.getElementById("find").addEventListener("input", ({ target }) => {
  for (const card of document.querySelectorAll(".gallery > article"))
    card.hidden = !card.textContent.toLowerCase().includes(target.value.toLowerCase());
});
</script>"""


def points(subject):
    """The largest error of each level against its step, of levels whose runs finished and stayed below ten envelopes."""
    found = []
    for level in subject["levels"]:
        errors = [run["u_error"] for run in level["runs"] if run["finished"]]
        if errors and all(isinstance(error, float) and 0.0 < error < 10.0 for error in errors):
            found.append((level["step"], max(errors)))
    return found


def picture(subject, box):
    """Error against step, both logarithmic, in the box that all cards share."""
    (left, right), (low, high) = box
    path = " ".join(f"{8 + 204 * (math.log10(h) - left) / (right - left):.1f},"
                    f"{112 - 104 * (math.log10(e) - low) / (high - low):.1f}" for h, e in points(subject))
    finest = points(subject)[0 if points(subject)[0][0] < points(subject)[-1][0] else -1]
    return (f'<svg viewBox="0 0 220 120" role="img" aria-label="Error in u against the {subject["resolution"]}: {finest[1]:.1e} at '
            f'{finest[0]:.2g}"><path d="M8 8V112H212" /><polyline points="{path}" /></svg>')


def box_of(subjects):
    both = [(math.log10(h), math.log10(e)) for subject in subjects for h, e in points(subject)]
    return [(min(values), max(values)) for values in zip(*both)]


def stamp(subject):
    """What the method may say of itself, in a few words."""
    found = subject["assessment"]["displacement"]
    order = f"order {found['order']:.1f} through impacts" if found["has_line"] else "no order through impacts"
    return "exact through impacts" if found["behaviour"] == "exact" else f"{order}, {found['behaviour']}"


def card(name, link, body, cite):
    return (f'<article><h3><a href="{link}">{html.escape(name)}</a></h3>\n{body}\n<details><summary>BibTeX</summary>'
            f'<pre>{html.escape(cite)}</pre></details></article>')


def own_source(command, *names):
    """What `cite` adds to the program and the paper."""
    return command.text("cite", *names).split("\n\n", 2)[-1].strip() or "the program"


def method_cards(command, record, rows):
    subjects = {subject["name"]: subject for subject in record["cases"][0]["subjects"] if subject.get("assessment")}
    boxes = {kind: box_of([subject for subject in subjects.values() if subject["resolution"] == kind])
             for kind in ("step", "tolerance")}
    for name, kind, _, summary in rows:
        specification = f"newmark+{name}" if kind == "contact" and name != "event-driven" else name
        subject = subjects.get("newmark" if name == "event-driven" else specification)
        body = f"<p>{html.escape(summary[0].upper() + summary[1:])}.</p>"
        if subject and points(subject):
            verdict = subject["assessment"]["verdict"]
            body = (f'{picture(subject, boxes[subject["resolution"]])}\n<p class="stamp {verdict.replace(" ", "-")}">{stamp(subject)}; '
                    f'{verdict}{" with its claim" if "agrees" in verdict else ""}</p>\n{body}')
        yield card(name, f"methods/{name}.html", body, own_source(command, name))


def page(command, record):
    methods = "\n".join(method_cards(command, record, command.json("list", "methods")["rows"]))
    cases = "\n".join(
        card(name, f"cases.html#{name}", f'<img alt="The case {name}" src="../_static/{name}-case.svg">\n<p>{html.escape(summary)}</p>',
             own_source(command, name)) for name, _, _, summary in command.json("list", "cases")["rows"])
    return ("# Gallery\n\nEach method on the default case, by `clackers verify --all`: error in u against the step, both logarithmic, in one "
            "scale for all (tolerances of adaptive methods in their own). A contact treatment is joined to `newmark`. `clackers cite NAME` prints the BibTeX.\n\n"
            '```{raw} html\n<input id="find" type="search" placeholder="Search" aria-label="Search methods and cases">\n```\n\n'
            f'## Methods\n\n```{{raw}} html\n<div class="gallery">\n{methods}\n</div>\n```\n\n'
            f'## Cases\n\n```{{raw}} html\n<div class="gallery">\n{cases}\n</div>\n{SEARCH}\n```\n')
