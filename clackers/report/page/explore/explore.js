"use strict";
// The dials: what they say is computed anew, shown in the figures and in the player, and kept in the address.

const dial = (name) => document.getElementById(name);
const names = ["X", "xi1", "a_t", "r", "eta", "steps"], paper = Object.fromEntries(names.map((name) => [name, dial(name).value]));
Object.entries(data.dials).forEach(([name, value]) => {
  dial(name).max = Math.max(dial(name).max, value);
  dial(name).min = Math.min(dial(name).min, value);
  dial(name).step = Number.isInteger((value - dial(name).min) / dial(name).step) ? dial(name).step : "any";
  dial(name).value = value;
});
const colorOf = Object.fromEntries(treatments.map(({ name }, i) => [name, `var(--m${i + 3})`]));
for (const specification of Object.values(specifications))
  JSON.stringify(specification, (key, value) => {
    if (value && value.domain === "$names")
      Object.assign(value, { domain: ["mass 1", "mass 2", ...Object.keys(colorOf)], range: ["var(--m1)", "var(--m2)", ...Object.values(colorOf)] });
    return value;
  });
treatments.forEach(({ name }, i) => {
  const label = document.createElement("label"), box = document.createElement("input"), line = document.createElement("i");
  Object.assign(box, { type: "checkbox", id: `run${i}`, checked: i < 2 });
  line.style.color = colorOf[name];
  label.append(box, line, name);
  dial("runs").append(label);
});
const boxes = treatments.map((_, i) => dial(`run${i}`));

function readAddress() {
  const given = new URLSearchParams(location.hash.slice(1));
  for (const name of names) if (given.has(name)) dial(name).value = given.get(name);
  if (given.has("runs")) boxes.forEach((box, i) => { box.checked = given.get("runs").includes(String(i)); });
}
function writeAddress() {
  const given = new URLSearchParams(names.map((name) => [name, dial(name).value]));
  given.set("runs", boxes.flatMap((box, i) => (box.checked ? [i] : [])).join(""));
  history.replaceState(null, "", `#${given}`);
}

// The parameters; a mass ratio that the motion does not allow is the largest that it does.
function chosenParameters() {
  const [X, xi1, a_t, wanted, eta, steps] = names.map((name) => Number(dial(name).value));
  const limit = largestRatio(X), r = wanted < limit ? wanted : Math.ceil(20 * limit - 1) / 20;
  dial("note").textContent = r === wanted ? "" : `With r of ${limit.toPrecision(4)} or more the masses touch away from their equilibrium: shown is r = ${r}.`;
  const pair = synchronizedPair({ X, r, xi1, eta }), end = 20 * a_t, perPeriod = 2 ** steps * 1.03, h = pair.fastPeriod / perPeriod;
  const said = { X: (X - 1) % 4 === 0 ? `${X} (N = ${(X - 1) / 4})` : `${X}`, xi1, a_t: `${a_t} (${end} s)`, r, eta, steps: `${perPeriod.toFixed(0)} (${h.toPrecision(3)} s)` };
  for (const name of names) {
    dial(name).nextElementSibling.textContent = said[name];
    dial(name).setAttribute("aria-valuetext", said[name]);
  }
  dial("again-command").textContent = commandOf({ pair, end }, { X, r, xi1, eta });
  return { pair, end, h };
}

// The command that has all digits.
function commandOf({ pair, end }, { X, r, xi1, eta }) {
  const values = r === 3 && eta === 1 && X % 4 === 1 ? `three-parameter --set N=${(X - 1) / 4},xi1=${xi1},a_t=${end / 20}`
    : `synchronized-pair --set X=${X},r=${r},xi1=${xi1},eta=${eta},t_end=${end}`;
  return `clackers respond ${values} --step ${(pair.fastPeriod / 40).toPrecision(2)} --format csv`;
}

const shown = () => treatments.filter((_, i) => boxes[i].checked);
const impactsOf = ({ pair, end }) => {
  const times = [];
  for (let number = 1; pair.impactTime(number) <= end; ++number) times.push(pair.impactTime(number));
  return times;
};

// A run of a treatment at the chosen step: states at all its times, and its largest error.
function runOf(chosen, treatment) {
  const run = { name: treatment.name, step: `h = ${chosen.h.toPrecision(3)} s`, t: [], states: [] };
  run.error = errorOf(chosen, treatment, chosen.h, (t, state) => { run.t.push(t); run.states.push(state); });
  return run;
}

// Rows of the figures: the exact motion and runs, at most `most` points each; of a run that grows its start.
function rowsOf({ pair, end }, times, runs) {
  const most = 1500, rows = [];
  const add = (is, name, t, state, flight) => {
    const energy = pair.energy(state);
    state.u.forEach((u, i) => rows.push({ is, of: name ?? `mass ${i + 1}`, curve: `${name ?? ""}${i}`, flight: `${i} ${flight}`, t, u, v: state.v[i], energy: energy[i] }));
  };
  for (let n = 0; n <= most; ++n) {
    const t = n * end / most;
    add("exact", null, t, pair.at(t), times.filter((time) => time <= t).length);
  }
  for (const { name, t, states } of runs) {
    const every = Math.max(1, Math.ceil(t.length / most));
    const grown = states.findIndex(({ u }) => Math.max(...u.map(Math.abs)) > 1.5 * pair.largest);
    states.slice(0, grown < 0 ? states.length : grown).forEach((state, n) => { if (n % every === 0) add("run", name, t[n], state, 0); });
  }
  return rows;
}

// The largest error of a displacement in a run; `visit(t, state)` sees its states.
function errorOf({ pair, end }, treatment, h, visit = () => {}) {
  let worst = 0;
  integrate(pair, treatment, end, h, (t, state) => {
    const exact = pair.at(t);
    for (const i of [0, 1]) worst = Math.max(worst, Math.abs(state.u[i] - exact.u[i]) / pair.largest);
    visit(t, state);
  });
  return worst;
}

// Errors over a ladder of steps, each half as long as the one before. No step divides the time between impacts:
// errors of such steps are smaller by coincidence.
function ladderOf(chosen) {
  const rows = [], finest = Math.min(9, Math.log2(60000 * chosen.pair.fastPeriod / chosen.end)) + 0.13;
  for (const treatment of shown())
    for (let level = finest - 6; level <= finest; ++level) {
      const h = chosen.pair.fastPeriod / 2 ** level, error = errorOf(chosen, treatment, h);
      if (error < 1e3) rows.push({ of: treatment.name, h, error });
    }
  return rows;
}

// The slope of the finest five points in logarithms.
function orderOf(rows) {
  const points = rows.slice(-5).map(({ h, error }) => [Math.log(h), Math.log(error)]);
  const [x, y] = [0, 1].map((axis) => points.reduce((sum, point) => sum + point[axis], 0) / points.length);
  return points.reduce((sum, [a, b]) => sum + (a - x) * (b - y), 0) / points.reduce((sum, [a]) => sum + (a - x) ** 2, 0);
}

function showFacts({ pair }, times, runs, ladder) {
  const facts = { "impacts in the motion": times.length, "time between impacts": `${(2 * pair.impactTime(1)).toPrecision(4)} s` };
  for (const { name, error } of runs) {
    const rows = ladder.filter((row) => row.of === name);
    facts[name] = rows.length > 1
      ? `error ${error.toExponential(1)} at this step, order ${orderOf(rows).toFixed(1)} over the finest steps`
      : "grows without bound";
  }
  dial("facts").replaceChildren(...Object.entries(facts).flatMap(([term, text]) => ["dt", "dd"].map((tag, i) => {
    const element = document.createElement(tag);
    element.textContent = i === 0 ? term : text;
    return element;
  })));
}

function motionOf({ pair, end }, times, runs) {
  const t = Array.from({ length: 1501 }, (_, n) => n * end / 1500);
  const places = (states) => [0, 1].map((i) => states.map((state) => state.u[i]));
  return {
    blocks: [{ column: 0, height: 1 }, { column: 1, height: 1 }], springs: [{ one: 0, other: -1 }, { one: 1, other: -1 }],
    contacts: [{ left: 0, right: 1, gap: 0 }], impacts: times.map((time) => ({ t: time, contact: 0 })), leftward: true,
    t, u: places(t.map(pair.at)), runs: runs.map(({ name, step, t: at, states }) => ({ name, step, t: at, u: places(states) }))
  };
}

// All that the dials decide; figures that are drawn already take the new rows.
function compute() {
  const chosen = chosenParameters(), times = impactsOf(chosen), ladder = ladderOf(chosen);
  const runs = shown().map((treatment) => runOf(chosen, treatment));
  Object.assign(data, {
    curves: rowsOf(chosen, times, runs), impacts: times.map((t, i) => ({ k: i + 1, t })), ladder, chosen: [{ h: chosen.h }], motion: motionOf(chosen, times, runs)
  });
  showFacts(chosen, times, runs, ladder);
  for (const [name, view] of Object.entries(embedded)) {
    for (const set of Object.keys(datasets(specifications[name]))) view.data(set, structuredClone(data[set]));
    view.runAsync();
  }
}

// The player starts anew with another motion.
function restartPlayer() {
  const old = document.querySelector("[data-player]"), tools = old.nextElementSibling, toggle = tools.querySelector("button");
  if (toggle && toggle.textContent === "Pause") toggle.click();
  const stage = old.cloneNode(false);
  old.replaceWith(stage);
  tools.replaceChildren();
  startPlayer(stage);
}

let waiting = false;
function change() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    compute();
    restartPlayer();
    writeAddress();
  });
}
dial("dials").addEventListener("input", change);
dial("runs").addEventListener("change", change);
dial("reset").addEventListener("click", () => { for (const name of names) dial(name).value = paper[name]; change(); });
window.addEventListener("hashchange", () => { readAddress(); change(); });
readAddress();
compute();
