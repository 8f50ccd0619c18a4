"use strict";
// The data of the figures of an atlas, made when a figure is asked for.

// Draws anew a figure whose frame is in the page.
let drawing = Promise.resolve();
function redraw(name) {
  const next = drawing.then(async () => {
    if (!document.querySelector(`[data-plot="${name}"]`)) return;
    if (embedded[name]) embedded[name].finalize();
    await draw(name);
  });
  drawing = next.catch((error) => console.error(error));
  return next;
}
const axisOf = (specification, axis) => (specification.encoding || specification.layer[0].encoding)[axis];

// ---- Convergence of a cell.

function ladderRuns(cell) {
  const ladder = atlas.ladders[value(cell, "ladder")], errors = value(cell, "errors");
  let run = 0;
  return ladder.runs.flatMap((count, level) => Array.from({ length: count }, () => {
    const row = { level: level + 1, step: ladder.steps[run], u_error: errors[run] };
    ++run;
    return row;
  }));
}
const isDrawable = (row) => row.u_error > 0 && row.u_error <= largestDrawn && row.step > 0;
const largestDrawn = 10;  // envelopes: what is farther away has blown up

function prepareLadder(cell) {
  const runs = ladderRuns(cell).filter(isDrawable), levels = new Map();
  for (const run of runs)
    if (!levels.has(run.level) || levels.get(run.level).u_error < run.u_error) levels.set(run.level, run);
  data.ladder_runs = runs;
  data.ladder_envelope = [...levels.values()];
  data.ladder_claim = runs.slice(0, 1).map((run) => ({ ...run, label: "" }));  // a point, which draws no line
  const claim = value(cell, "claim");
  if (claim.order > 0 && runs.length > 1) {
    // Through the middle of the envelope.
    const logs = data.ladder_envelope.map((row) => Math.log(row.u_error) - claim.order * Math.log(row.step)).sort((a, b) => a - b);
    const constant = Math.exp(logs[Math.floor(logs.length / 2)]);
    const steps = runs.map((row) => row.step), ends = [Math.min(...steps), Math.max(...steps)];
    const errors = runs.map((row) => row.u_error), stepAt = (error) => (error / constant) ** (1 / claim.order);
    const from = Math.max(ends[0], stepAt(Math.min(...errors) / 3)), to = Math.min(ends[1], stepAt(Math.max(...errors) * 3));
    data.ladder_claim = [from, to].map((step, i) =>
      ({ step, u_error: constant * step ** claim.order, label: i === 0 ? `claimed order ${claim.order}` : "" }));
  }
  const ladder = atlas.ladders[value(cell, "ladder")];
  axisOf(specifications.ladder, "x").axis.title = ladder.by === "tolerance" ? "tolerance" : "step h [s]";
  return runs.length > 0;
}

// ---- Map of a method over two parameters of a case.

// The worst of several cells: what every value of the other parameters keeps.
function worst(cells, field) {
  const numbers = cells.map((cell) => value(cell, field));
  if (numbers.some((number) => number === null)) return null;
  return field === "order" ? Math.min(...numbers) : Math.max(...numbers);
}
const worstBehaviour = (cells) => cells.map(behaviourOf).sort((a, b) => behaviours.indexOf(b) - behaviours.indexOf(a))[0];

const inkOf = (fill) => ({ background: `var(--${fill})`, ink: `var(--${fill}-ink)` });
function mapCell(cells, what) {
  const order = worst(cells, "order"), error = worst(cells, "u_error"), behaviour = worstBehaviour(cells);
  const number = what === "order" ? order : error;
  const colours = inkOf(what === "behaviour" ? `b-${behaviour}` : `s-${band(what, number)}`);
  return { behaviour, verdict: cells.map(verdictOf).sort((a, b) => verdicts.indexOf(b) - verdicts.indexOf(a))[0],
    order: order === null ? "–" : order.toFixed(2), u_error: scientific(error), fill: colours.background, ink: colours.ink,
    label: what === "behaviour" ? behaviour : what === "order" ? (order === null ? "–" : minus(order.toFixed(2))) : scientific(error, 0) };
}

function prepareMap(method, name, x, y, what) {
  const systems = atlas.systems.map((system, i) => [system, i]).filter(([system, i]) => system.case === name && byPlace[method][i]);
  const values = (key) => [...new Set(systems.map(([system]) => system.set[key]))]
    .sort((a, b) => (typeof a === "number" && typeof b === "number" ? a - b : String(a).localeCompare(String(b))));
  const ys = y === null ? [""] : values(y).reverse();
  const text = (key) => shortOf[name][key] || String;
  data.map = ys.flatMap((row) => values(x).flatMap((column) => {
    const some = systems.filter(([system]) => system.set[x] === column && (y === null || system.set[y] === row));
    if (some.length === 0) return [];
    return [{ x: text(x)(column), y: text(y)(row), system: some.length === 1 ? systemName(some[0][1]) : `the worst of ${some.length} systems`,
      ...mapCell(some.map(([, i]) => byPlace[method][i]), what) }];
  }));
  specifications.map.height = 60 + 44 * ys.length;
  for (const [axis, title, list] of [["x", x, values(x)], ["y", y, ys]])
    Object.assign(axisOf(specifications.map, axis), { sort: list.map(text(title)), axis: { labelAngle: 0, title } });
}

// ---- Pareto front of a system.

function prepareWork(system, counter) {
  const field = counter === "steps" ? "steps" : "forces";
  const points = shownMethods().flatMap((method) => {
    const cell = byPlace[method][system];
    if (!cell) return [];
    const runs = ladderRuns(cell);
    return value(cell, field).flatMap((work, level) => {
      const errors = runs.filter((run) => run.level === level + 1).map((run) => run.u_error);
      const failed = errors.some((error) => error === null);
      return work > 0 && !failed && errors.length ? [{ method: methodName(method), place: method, work, u_error: Math.max(...errors) }] : [];
    });
  }).filter((row) => row.u_error > 0 && row.u_error <= largestDrawn).sort((a, b) => a.work - b.work || a.u_error - b.u_error);
  let best = Infinity;
  const front = points.filter((row) => row.u_error < best && ((best = row.u_error), true));
  const numbers = new Map();
  for (const row of front) {
    if (!numbers.has(row.method)) numbers.set(row.method, numbers.size + 1);
    row.number = numbers.get(row.method);
  }
  data.work_levels = points;
  data.work_front = front;
  const title = counter === "steps" ? "steps" : "force evaluations";
  axisOf(specifications.work, "x").axis.title = title;
  for (const layer of specifications.work.layer)
    for (const row of layer.encoding.tooltip || []) if (row.field === "work") row.title = title;
  return front;
}

// ---- Performance profile of the methods that the matrix shows.

const profile = { counter: 0, asked: false };
// The area below a line up to 100 times the least work: cheap and dependable methods have more.
function area([ratios, solved], tasks) {
  const end = Math.log(100);
  return ratios.reduce((sum, ratio, i) => sum + Math.max(0, end - Math.log(ratio)) * (solved[i] - (i ? solved[i - 1] : 0)), 0) / tasks / end;
}

function prepareProfile(methods) {
  const { lines, tasks, counter, title } = atlas.profiles[profile.counter];
  const best = methods.filter((method) => lines[method][0].length > 0)
    .sort((a, b) => area(lines[b], tasks) - area(lines[a], tasks)).slice(0, atlas.styles.length);
  const end = Math.max(1.1, ...best.map((method) => lines[method][0].at(-1)));
  data.profile = best.map((method) => {
    const [ratios, solved] = lines[method], all = solved.at(-1);
    return { method: methodName(method), counter, ratio: [...ratios, end], share: [...solved, all].map((count) => count / tasks),
      solved: [...solved, all].map((count) => `${count} of ${tasks}`), failed: tasks - all };
  });
  const names = data.profile.map((row) => row.method), specification = specifications.profile;
  JSON.stringify(specification, (key, part) => {
    if (part && part.domain) part.domain = names;
    return part;
  });
  specification.params.find((parameter) => parameter.name === "counter").value = counter;
  specification.encoding.x.axis.title = `times the least ${title}`;
  control("profile-legend").innerHTML = best.map((method, i) =>
    `<span class="entry">${atlas.styles[i]}${breakable(methodName(method))}</span>`).join("");
  control("profile-caption").textContent = `${best.length} of the ${methods.length} methods of the matrix: those with the largest area below ` +
    `their line, of ${tasks} tasks on ${atlas.systems.length} systems.`;
  return best.length > 0;
}

let shownProfile = "";
function profileChanged(methods) {
  if (!atlas.profiles.length) return;
  const key = `${profile.counter} ${methods}`;
  if (!profile.asked || key === shownProfile) return;
  shownProfile = key;
  if (prepareProfile(methods)) redraw("profile").then(() => { document.documentElement.dataset.profile = key; });
}

function startProfile() {
  const section = document.getElementById("profile");
  if (!atlas.profiles.length) {
    section.querySelector("figure").replaceWith("No profile: no method reaches an error of 0.1 on any system, or work was not counted.");
    return;
  }
  atlas.profiles.forEach(({ title }, i) => {
    const press = button(title, `Count ${title}`, () => {
      profile.counter = i;
      for (const other of control("profile-counters").children) other.setAttribute("aria-pressed", String(other === press));
      profileChanged(shownMethods());
    });
    press.setAttribute("aria-pressed", String(i === 0));
    control("profile-counters").append(press);
  });
  new IntersectionObserver((entries, observer) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    observer.disconnect();
    profile.asked = true;
    profileChanged(shownMethods());
  }, { rootMargin: "200px" }).observe(section);
}
