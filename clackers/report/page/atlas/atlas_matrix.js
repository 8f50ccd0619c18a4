"use strict";
// The matrix: its controls, its cells, and the keys that move in it.

const grid = document.getElementById("grid");
const frame = document.getElementById("frame");
const tip = document.getElementById("tip");

const sign = (word) => `<svg class="sign" aria-hidden="true"><use href="#sign-${slug(word)}"/></svg>`;

// ---- Cells.

function inside(cell) {
  if (choice.show === "behaviour") return sign(behaviourOf(cell));
  if (choice.show === "verdict") return sign(verdictOf(cell));
  const label = bandLabel(choice.show, value(cell, choice.show));
  return label || (verdictOf(cell) === "refused" ? sign("refused") : "");
}
function look(cell) {
  if (choice.show === "behaviour") return `b-${behaviourOf(cell)}${verdictOf(cell) === "disagrees" ? " wrong-claim" : ""}`;
  if (choice.show === "verdict") return `v-${slug(verdictOf(cell))}`;
  return `s-${band(choice.show, value(cell, choice.show))}`;
}
const words = (cell) => (verdictOf(cell) === "refused" ? "refused"
  : `${behaviourOf(cell)}, ${verdictOf(cell)}, order ${orderText(cell)}, error ${scientific(value(cell, "u_error"))}`);

function cellHtml(method, system) {
  const cell = byPlace[method][system];
  if (!cell) return `<td role="gridcell" tabindex="-1" class="cell" aria-label="not run"></td>`;
  const dim = isNarrowed() && !isPicked(cell) ? " dim" : "";
  return `<td role="gridcell" tabindex="-1" class="cell ${look(cell)}${dim}" data-m="${method}" data-s="${system}" ` +
    `aria-label="${escaped(`${methodName(method)} on ${systemName(system)}: ${words(cell)}`)}">${inside(cell)}</td>`;
}

// How many systems have which verdict, as a bar.
function shares(method, systems) {
  const cells = systems.map((system) => byPlace[method][system]).filter(Boolean);
  let from = 0;
  const stops = verdicts.flatMap((word) => {
    const count = cells.filter((cell) => verdictOf(cell) === word).length;
    if (count === 0) return [];
    const to = from + 100 * count / cells.length, stop = `var(--v-${slug(word)}) ${from.toFixed(1)}% ${to.toFixed(1)}%`;
    from = to;
    return [stop];
  });
  const agree = cells.filter((cell) => verdictOf(cell) === "agrees").length;
  return `<span class="bar-of" style="background:linear-gradient(90deg,${stops.join(",")})"></span>` +
    `<span class="share">${agree}/${cells.length}</span>`;
}

function rowHtml(method, systems) {
  const name = choice.grouped ? shortName(method) : atlas.methods[method].name;
  const origin = atlas.parts[atlas.methods[method].part].origin;
  return `<tr><th scope="row" tabindex="-1" data-m="${method}" aria-label="${escaped(methodName(method))}: its map">` +
    `<span class="line"><span class="name">${breakable(name)}</span>` +
    (origin ? `<span class="origin">${escaped(origin)}</span>` : "") + `${shares(method, systems)}</span></th>` +
    systems.map((system) => cellHtml(method, system)).join("") + "</tr>";
}

function headHtml(systems) {
  const spans = [];
  for (const system of systems) {
    const name = atlas.systems[system].case;
    if (spans.length && spans[spans.length - 1][0] === name) ++spans[spans.length - 1][1];
    else spans.push([name, 1]);
  }
  const starts = new Set(systems.filter((system, i) => i === 0 || atlas.systems[system].case !== atlas.systems[systems[i - 1]].case));
  const top = spans.map(([name, count]) => `<th scope="colgroup" colspan="${count}" class="case"><span title="${escaped(name)}">${
    count > 2 ? escaped(name) : ""}</span></th>`).join("");
  const counts = Object.fromEntries(spans);
  const low = systems.map((system) => {
    const { case: name } = atlas.systems[system], rest = settingText(atlas.systems[system], varyingOf[name], shortOf[name]);
    const text = counts[name] > 2 ? rest : [name, rest].filter(Boolean).join(" ");
    return `<th scope="col" tabindex="-1" data-s="${system}" class="system${starts.has(system) ? " first" : ""}" ` +
      `title="${escaped(systemName(system))}" aria-label="${escaped(systemName(system))}: its Pareto front"><span>${escaped(text || name)}</span></th>`;
  }).join("");
  return `<thead><tr class="cases"><td class="corner"></td>${top}</tr><tr><td class="corner"><span>method</span><span>agrees</span></td>${low}</tr></thead>`;
}

function groupHtml(treatment, methods, systems) {
  if (treatment === null) return methods.map((method) => rowHtml(method, systems)).join("");
  const open = !choice.closed.has(treatment);
  return `<tr class="group"><th scope="colgroup" colspan="${systems.length + 1}" tabindex="-1" data-t="${escaped(treatment)}" ` +
    `aria-expanded="${open}"><span class="stay">${escaped(treatmentName(treatment))} <small>${methods.length}</small></span></th></tr>` +
    (open ? methods.map((method) => rowHtml(method, systems)).join("") : "");
}

let onRender = () => {};
function render() {
  const systems = shownSystems(), methods = shownMethods(systems);
  const body = groups(methods).map(([treatment, some]) => groupHtml(treatment, some, systems)).join("");
  grid.innerHTML = headHtml(systems) + `<tbody>${body || `<tr><td class="nothing" colspan="${systems.length + 1}">No method passes the filters.</td></tr>`}</tbody>`;
  for (const th of grid.querySelectorAll("th.first")) {
    const column = [...th.parentElement.children].indexOf(th) + 1;
    if (column > 2) th.classList.add("edge");
  }
  const picked = methods.flatMap((method) => systems.map((system) => byPlace[method][system])).filter((cell) => cell && isPicked(cell));
  control("status").textContent = `${methods.length} of ${atlas.methods.length} methods, ${systems.length} of ${atlas.systems.length} systems` +
    (isNarrowed() ? `, ${picked.length} cells` : "");
  control("scale").hidden = !(choice.show in scales);
  if (choice.show in scales)
    control("scale").innerHTML = scales[choice.show].map(([end, name]) =>
      `<span class="chip"><span class="swatch s-${band(choice.show, end === Infinity ? 1e9 : end * 0.999)}"></span>${name}</span>`).join("");
  grid.querySelector("[tabindex]")?.setAttribute("tabindex", "0");
  marked();
  onRender(methods);
}

// ---- Controls.

function chips(id, list, of, kind) {
  const counts = Object.fromEntries(list.map((word) => [word, 0]));
  for (const cell of atlas.cells) ++counts[of(cell)];
  for (const word of list) {
    if (!counts[word]) continue;
    const chip = button("", `Only ${word}`, () => {
      choice[id].has(word) ? choice[id].delete(word) : choice[id].add(word);
      chip.setAttribute("aria-pressed", String(choice[id].has(word)));
      render();
    });
    chip.className = "chip";
    chip.dataset.word = word;
    chip.setAttribute("aria-pressed", "false");
    chip.innerHTML = `<span class="swatch ${kind}-${slug(word)}">${sign(word)}</span>${word} <small>${whole(counts[word])}</small>`;
    control(id).append(chip);
  }
}
control("behaviours").innerHTML = "<span class=\"of\">Behaviour</span>";
control("verdicts").innerHTML = "<span class=\"of\">Verdict</span>";
chips("behaviours", behaviours, behaviourOf, "b");
chips("verdicts", verdicts, verdictOf, "v");
if (atlas.cells.some((cell) => verdictOf(cell) === "disagrees"))
  control("behaviours").insertAdjacentHTML("beforeend",
    "<span class=\"chip\"><span class=\"swatch wrong-claim\"></span>a corner: not as claimed</span>");

function options(id, list, name) {
  for (const one of list) control(id).add(new Option(name(one), one));
}
options("treatment", [...new Set(atlas.methods.map((method) => method.treatment))], treatmentName);
options("case", cases, (name) => name);
for (const id of ["treatment", "case", "sort", "show"])
  control(id).addEventListener("change", () => { choice[id] = control(id).value; render(); });
control("find").addEventListener("input", () => { choice.find = control("find").value; render(); });
control("grouped").addEventListener("change", () => { choice.grouped = control("grouped").checked; render(); });
control("reset").addEventListener("click", () => {
  Object.assign(choice, { find: "", treatment: "*", case: "*" });
  for (const set of [choice.behaviours, choice.verdicts, choice.closed]) set.clear();
  for (const id of ["find", "treatment", "case"]) control(id).value = choice[id];
  for (const chip of document.querySelectorAll(".chips [aria-pressed]")) chip.setAttribute("aria-pressed", "false");
  render();
});
function sortBySystem(system) {
  if (![...control("sort").options].some((option) => option.value === "system")) control("sort").add(new Option("", "system"));
  control("sort").querySelector("[value=system]").textContent = `by error on ${systemName(system)}`;
  control("sort").value = choice.sort = "system";
  choice.system = system;
  render();
}

// ---- Pointer and keys.

const target = (event) => event.target.closest("td.cell, th[tabindex]");
function act(element, byKey) {
  const { m, s, t } = element.dataset;
  if (t !== undefined) {
    choice.closed.has(t) ? choice.closed.delete(t) : choice.closed.add(t);
    render();
    focusOn([...grid.querySelectorAll("[data-t]")].find((head) => head.dataset.t === t));
  } else if (m !== undefined || s !== undefined)
    openPanel(m === undefined ? null : Number(m), s === undefined ? null : Number(s), byKey);
}
function focusOn(element) {
  if (!element) return;
  grid.querySelector("[tabindex='0']")?.setAttribute("tabindex", "-1");
  element.setAttribute("tabindex", "0");
  element.focus({ preventScroll: true });
  element.scrollIntoView({ block: "nearest", inline: "nearest" });
}
grid.addEventListener("click", (event) => {
  const element = target(event);
  if (!element) return;
  focusOn(element);
  act(element, false);
});
grid.addEventListener("keydown", (event) => {
  const element = target(event);
  if (!element) return;
  if (event.key === "Enter" || event.key === " ") {
    event.preventDefault();
    act(element, true);
    return;
  }
  const rows = [...grid.rows].filter((row) => row.querySelector("[tabindex]"));
  const row = rows.indexOf(element.parentElement), column = element.cellIndex;
  const last = element.parentElement.cells.length - 1;
  const moves = { ArrowUp: [row - 1, column], ArrowDown: [row + 1, column], ArrowLeft: [row, column - 1], ArrowRight: [row, column + 1],
    Home: [event.ctrlKey ? 0 : row, 0], End: [event.ctrlKey ? rows.length - 1 : row, last], PageUp: [row - 10, column], PageDown: [row + 10, column] };
  const move = moves[event.key];
  if (!move) return;
  event.preventDefault();
  const to = rows[Math.min(Math.max(move[0], 0), rows.length - 1)];
  // The heading of a group is one cell wide; behind it the column goes on.
  const wanted = event.key.startsWith("Arrow") && "UD".includes(event.key[5]) || event.key.startsWith("Page") ? (focusOn.column ?? column) : move[1];
  focusOn.column = wanted;
  let cell = to.cells[Math.min(Math.max(wanted, 0), to.cells.length - 1)];
  if (!cell.hasAttribute("tabindex")) cell = to.querySelector("[tabindex]");
  focusOn(cell);
  followPanel(cell);
});

function showTip(element) {
  const { m, s } = element.dataset;
  if (m === undefined || s === undefined) return hideTip();
  const cell = byPlace[m][s];
  tip.innerHTML = `<strong>${breakable(methodName(m))}</strong><br>${escaped(systemName(s))}<br>` +
    `<span class="swatch b-${behaviourOf(cell)}">${sign(behaviourOf(cell))}</span> ${words(cell)}`;
  tip.hidden = false;
  const at = element.getBoundingClientRect(), box = tip.getBoundingClientRect();
  tip.style.left = `${Math.max(8, Math.min(at.left, innerWidth - box.width - 16))}px`;
  tip.style.top = `${at.bottom + box.height + 12 > innerHeight ? at.top - box.height - 8 : at.bottom + 8}px`;
}
function hideTip() { tip.hidden = true; }
grid.addEventListener("mouseover", (event) => { const element = target(event); element ? showTip(element) : hideTip(); });
grid.addEventListener("mouseleave", hideTip);
grid.addEventListener("focusin", (event) => { const element = target(event); if (element && element.matches(":focus-visible")) showTip(element); });
grid.addEventListener("focusout", hideTip);
frame.addEventListener("scroll", hideTip);
addEventListener("scroll", hideTip);

onRender = profileChanged;
startProfile();
render();
document.documentElement.dataset.atlas = "shown";
