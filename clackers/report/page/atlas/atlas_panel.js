"use strict";
// The panel beside the matrix: a cell, a method or a system.

const panel = document.getElementById("panel");
let opened = null;  // {method, system}

function figureHtml(name, rows, heading) {
  return `<figure class="figure" aria-labelledby="figure-${name}-title"><h3 id="figure-${name}-title">${escaped(heading)}</h3>` +
    `<div class="plot" data-plot="${name}" role="img" aria-label="${escaped(heading)}"></div>` +
    `<div class="tools" role="group" aria-label="Tools of the figure" data-tools="${name}" data-rows="${rows}"></div></figure>`;
}
function drawInPanel(name) {
  addTools(panel.querySelector(`[data-tools="${name}"]`));
  panel.dataset.drawn = "no";
  return redraw(name).then(() => { panel.dataset.drawn = name; });
}

const badgeHtml = (word) => `<span class="badge ${slug(word)}">${word}</span>`;
const factHtml = (term, text) => (text === "" || text === null ? "" : `<dt>${term}</dt><dd>${text}</dd>`);
const codes = (text) => text.split(" ").filter(Boolean).map((code) => `<code>${escaped(code)}</code>`).join(" ");
const commandHtml = (command) => `<div class="command"><pre id="panel-command">${escaped(command)}</pre>` +
  `<button type="button" data-copy="panel-command">Copy</button></div>`;
// What the author of a file wrote for a shell is not to be copied unread.
const foreignHtml = (command, author) => `<p class="below">A program, as ${escaped(author || "the specification")} calls it. Read the line before you run it.</p>` +
  `<div class="command"><pre id="panel-command">${escaped(command)}</pre></div>`;
const selectHtml = (id, name, list, chosenOne) => `<label>${name} <select id="${id}">${
  list.map(([key, text]) => `<option value="${escaped(key)}"${key === chosenOne ? " selected" : ""}>${escaped(text)}</option>`).join("")}</select></label>`;

function show(kind, heading, below, html) {
  panel.innerHTML = `<header><p class="kind">${kind}</p><button type="button" id="panel-close" aria-label="Close">✕</button></header>` +
    `<h3 id="panel-title" tabindex="-1">${heading}</h3>${below ? `<p class="below">${below}</p>` : ""}${html}`;
  panel.hidden = false;
  panel.scrollTop = 0;
  document.body.classList.add("has-panel");
  control("panel-close").addEventListener("click", closePanel);
  panel.querySelectorAll("[data-copy]").forEach(addCopy);
}

// ---- A cell.

function numbersHtml(cell) {
  const known = value(cell, "impacts_expected");
  const impacts = known === null ? "" : `${whole(value(cell, "impacts_matched"))} of ${whole(known)}` +
    ` (${value(cell, "impacts_missed")} missed, ${value(cell, "impacts_extra")} extra)`;
  const failed = ladderRuns(cell).filter((run) => run.u_error === null).length, time = value(cell, "impact_time_error");
  return `<dl class="facts">${factHtml("Claimed", escaped(value(cell, "claim").text))}${factHtml("Order", orderText(cell))}` +
    factHtml("Error in u, finest", scientific(value(cell, "u_error"), 2)) + factHtml("Error in v", scientific(value(cell, "v_error"), 2)) +
    factHtml("Energy error", scientific(value(cell, "energy_error"), 2)) + factHtml("Impacts", impacts) +
    factHtml("Impact time", time === null ? "" : `${scientific(time, 2)} s`) +
    factHtml("Steps, finest", whole(value(cell, "steps").at(-1) ?? null)) +
    factHtml("Force evaluations", whole(value(cell, "forces").at(-1) ?? null)) +
    factHtml("Failed runs", failed ? `${failed} of ${ladderRuns(cell).length}` : "") +
    factHtml("Reason", codes(value(cell, "reason"))) + factHtml("Diagnosis", codes(value(cell, "diagnosis"))) + "</dl>";
}

function showCell(cell) {
  const behaviour = behaviourOf(cell), refusal = value(cell, "refusal");
  const method = atlas.methods[cell[0]], part = atlas.parts[method.part];
  const head = `<p class="found"><span class="swatch b-${behaviour}">${sign(behaviour)}</span>${refusal ? "" : ` ${behaviour}`} ${badgeHtml(verdictOf(cell))}</p>`;
  const origin = part.origin ? `<p class="below">Results of ${escaped(part.origin)}, ${escaped(part.date)}, clackers ${escaped(part.version)}.</p>` : "";
  const drawable = !refusal && prepareLadder(cell);
  const figure = drawable ? figureHtml("ladder", "ladder_runs", "Convergence")
    : `<p class="notice">${refusal ? `${escaped(refusal)} <span class="code">[${escaped(value(cell, "refusal_code"))}]</span>` : "There is no error to draw: all are zero, or above ten times the motion."}</p>`;
  const beyond = ladderRuns(cell).filter((run) => run.u_error > largestDrawn).length;
  const legend = drawable ? `<p class="below">Points: runs. Line: the worst of each level. Dashed: the claimed slope.${
    beyond ? ` Not drawn: ${beyond} with an error above ${largestDrawn}.` : ""}</p>` : "";
  show("Method on a system", breakable(methodName(cell[0])), escaped(systemName(cell[1])),
    head + origin + figure + legend + (refusal ? "" : numbersHtml(cell)) + "<h4>Compute it again</h4>" +
    (method.program ? foreignHtml(commandOf(cell), part.origin) : commandHtml(commandOf(cell))));
  return drawable ? drawInPanel("ladder") : null;
}

// ---- A method: its map.

const mapChoice = { case: null, x: null, y: null, what: "order" };
function showMethod(method) {
  const cells = byPlace[method].filter(Boolean);
  const counts = behaviours.map((word) => [word, cells.filter((cell) => behaviourOf(cell) === word).length]).filter(([, count]) => count);
  const list = counts.map(([word, count]) => `<span class="chip"><span class="swatch b-${word}">${sign(word)}</span>${word} <small>${count}</small></span>`).join("");
  const usable = cases.filter((name) => varyingOf[name].length > 0 && atlas.systems.some((system, i) => system.case === name && byPlace[method][i]));
  const claims = [...new Set(cells.map((cell) => value(cell, "claim").text).filter(Boolean))];
  const head = `<div class="chips">${list}</div><dl class="facts">${factHtml("Treatment", escaped(treatmentName(atlas.methods[method].treatment)))}` +
    factHtml("Claimed", claims.map(escaped).join("; ")) + factHtml("More", atlas.methods[method].program ? "" : `<code>clackers show ${escaped(atlas.methods[method].name)}</code>`) + "</dl>";
  if (!usable.includes(mapChoice.case)) mapChoice.case = usable[0] ?? null;
  show("Method", breakable(methodName(method)), `${cells.length} systems`,
    head + (usable.length ? "<div id=\"map-controls\" class=\"controls\"></div><div id=\"map-figure\"></div>"
      : "<p class=\"notice\">No case has a parameter that varies, so there is no map.</p>"));
  return usable.length ? drawMap(method, usable) : null;
}

function drawMap(method, usable) {
  const keys = varyingOf[mapChoice.case];
  if (!keys.includes(mapChoice.x)) mapChoice.x = keys[0];
  if (!keys.includes(mapChoice.y) || mapChoice.y === mapChoice.x) mapChoice.y = keys.find((key) => key !== mapChoice.x) ?? null;
  const pairs = (list) => list.map((key) => [key, key]);
  control("map-controls").innerHTML = selectHtml("map-case", "Case", pairs(usable), mapChoice.case) +
    selectHtml("map-x", "Across", pairs(keys), mapChoice.x) +
    (keys.length > 1 ? selectHtml("map-y", "Up", pairs(keys.filter((key) => key !== mapChoice.x)), mapChoice.y) : "") +
    selectHtml("map-what", "Shows", [["order", "observed order"], ["u_error", "error at the finest step"], ["behaviour", "behaviour"]], mapChoice.what);
  for (const id of ["case", "x", "y", "what"])
    control(`map-${id}`)?.addEventListener("change", (event) => {
      mapChoice[id] = event.target.value;
      drawMap(method, usable);
      control(`map-${id}`).focus();
    });
  const rest = keys.filter((key) => key !== mapChoice.x && key !== mapChoice.y);
  control("map-figure").innerHTML = figureHtml("map", "map", { order: "Observed order", u_error: "Error in u at the finest step", behaviour: "Behaviour" }[mapChoice.what]) +
    (rest.length ? `<p class="below">The worst over ${rest.map(escaped).join(", ")}.</p>` : "");
  prepareMap(method, mapChoice.case, mapChoice.x, mapChoice.y, mapChoice.what);
  return drawInPanel("map");
}

// ---- A system: its Pareto front.

let workCounter = "force_evaluations";
function showSystem(system) {
  const cells = atlas.methods.map((_, method) => byPlace[method][system]).filter(Boolean);
  const counts = verdicts.map((word) => [word, cells.filter((cell) => verdictOf(cell) === word).length]).filter(([, count]) => count);
  const list = counts.map(([word, count]) => `<span class="chip"><span class="swatch v-${slug(word)}">${sign(word)}</span>${word} <small>${count}</small></span>`).join("");
  show("System", escaped(atlas.systems[system].case), escaped(settingText(atlas.systems[system], Object.keys(atlas.systems[system].set))),
    `<div class="chips">${list}</div><div class="tools"><button type="button" id="sort-here">Sort the methods by their error here</button></div>` +
    `<div class="controls">${selectHtml("work-counter", "Work", [["force_evaluations", "force evaluations"], ["steps", "steps"]], workCounter)}</div>` +
    "<div id=\"work-figure\"></div><h4>The system</h4>" + commandHtml(`clackers show ${atlas.systems[system].command.replace(/^--case /, "")}`));
  control("sort-here").addEventListener("click", () => sortBySystem(system));
  control("work-counter").addEventListener("change", (event) => { workCounter = event.target.value; drawWork(system); });
  return drawWork(system);
}

function drawWork(system) {
  const front = prepareWork(system, workCounter), seen = new Set();
  if (front.length === 0) {
    control("work-figure").innerHTML = "<p class=\"notice\">No level of a method that the matrix shows has work and an error above zero.</p>";
    return null;
  }
  const rows = front.filter((row) => !seen.has(row.number) && seen.add(row.number)).map((row) =>
    `<li><button type="button" class="quiet" data-front="${row.place}">${breakable(row.method)}</button></li>`).join("");
  control("work-figure").innerHTML = figureHtml("work", "work_levels", "Pareto front of error against work") +
    `<p class="below">Points: levels of the ${shownMethods().length} methods of the matrix. The methods on the front, cheapest first:</p><ol class="front">${rows}</ol>`;
  for (const one of panel.querySelectorAll("[data-front]"))
    one.addEventListener("click", () => openPanel(Number(one.dataset.front), system, true));
  return drawInPanel("work");
}

// ---- FirstRows and closing.

function marked() {
  for (const old of grid.querySelectorAll(".opened")) old.classList.remove("opened");
  if (!opened) return;
  const { method, system } = opened;
  const key = method === null ? `th[data-s="${system}"]` : system === null ? `th[data-m="${method}"]` : `td[data-m="${method}"][data-s="${system}"]`;
  grid.querySelector(key)?.classList.add("opened");
}
function openPanel(method, system, byKey) {
  opened = { method, system };
  hideTip();
  marked();
  if (system === null) showMethod(method);
  else if (method === null) showSystem(system);
  else showCell(byPlace[method][system]);
  if (byKey) control("panel-title").focus();
  else grid.querySelector(".opened")?.scrollIntoView({ block: "nearest", inline: "nearest" });
}
// While the panel is open it shows what the keys move to.
let following = null;
function followPanel(element) {
  const { m, s } = element.dataset;
  if (!opened || (m === undefined && s === undefined)) return;
  clearTimeout(following);
  following = setTimeout(() => opened && openPanel(m === undefined ? null : Number(m), s === undefined ? null : Number(s), false), 150);
}
function closePanel() {
  const back = grid.querySelector(".opened");
  opened = null;
  panel.hidden = true;
  panel.innerHTML = "";
  document.body.classList.remove("has-panel");
  marked();
  focusOn(back);
}
addEventListener("keydown", (event) => {
  if (event.key === "Escape" && opened) closePanel();
});
