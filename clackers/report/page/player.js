"use strict";
// The motion as an animation: blocks on columns, contacts that flash at impacts, and a cursor in the
// response. Displacements are drawn in one scale that lets the widest motion fit.

const stageWidth = 1000, stageHeight = 300, groundLevel = 262, roofLevel = 46, blockHeight = 30;

function svgElement(parent, tag, attributes, text) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  parent.append(element);
  return element;
}

// How many of ascending times are not after t.
function countUpTo(times, t) {
  let lo = 0, hi = times.length;
  while (lo < hi) {
    const middle = (lo + hi) >> 1;
    if (times[middle] <= t) lo = middle + 1;
    else hi = middle;
  }
  return lo;
}

// Where blocks rest and how large they are. Faces that may touch are their gap apart; other
// neighbours have room for both motions.
function layout(scene) {
  const slots = 1 + Math.max(...scene.blocks.map((block) => block.column));
  const inColumn = (column) => scene.blocks.flatMap((block, i) => (block.column === column ? [i] : []));
  const reach = Math.max(...scene.u.flat().map(Math.abs), Number.MIN_VALUE);
  const gaps = Array.from({ length: slots - 1 }, (_, column) => {
    const between = scene.contacts.filter(({ left, right }) => left >= 0 && right >= 0 &&
      scene.blocks[left].column === column && scene.blocks[right].column === column + 1);
    return between.length > 0 ? Math.max(0, ...between.map((contact) => contact.gap)) : 2.2 * reach;
  });
  const metres = gaps.reduce((sum, gap) => sum + gap, 0) + 2.4 * reach;
  const width = Math.min(90, (0.55 * stageWidth) / slots);
  const scale = Math.min((stageWidth - slots * width) / metres, (2.5 * width) / reach);
  const x = [];
  let at = (stageWidth - slots * width - (metres - 2.4 * reach) * scale) / 2;
  for (let column = 0; column < slots; ++column) {
    for (const i of inColumn(column)) x[i] = at + width / 2;
    at += width + (gaps[column] || 0) * scale;
  }
  const y = scene.blocks.map((block) => groundLevel - block.height * (groundLevel - roofLevel));
  return { x, y, width, scale };
}

function startPlayer(stage) {
  const scene = data[stage.dataset.player], tools = stage.nextElementSibling;
  const what = stage.closest("figure").querySelector("h3").textContent;
  const { x, y, width, scale } = layout(scene);
  const masses = scene.blocks.length, end = scene.t.at(-1);
  const color = (i) => `var(--m${(i % 8) + 1})`;
  const svg = svgElement(stage, "svg", {
    viewBox: `0 0 ${stageWidth} ${stageHeight}`, "aria-hidden": "true", xmlns: "http://www.w3.org/2000/svg",
    "font-family": "sans-serif", "font-size": 13
  });
  svgElement(svg, "path", { d: `M0,${groundLevel}H${stageWidth}`, stroke: "var(--faint)", "stroke-width": 2 });
  const springs = scene.springs.map(({ one, other }) => ({
    one, other, path: svgElement(svg, "path", { stroke: "var(--muted)", "stroke-width": 2, fill: "none" })
  }));
  for (const { left, right, gap } of scene.contacts)
    if ((left < 0) !== (right < 0)) {  // a stop
      const mass = Math.max(left, right), side = left < 0 ? -1 : 1;
      const face = x[mass] + side * (width / 2 + gap * scale);
      svgElement(svg, "path", {
        d: `M${face},${y[mass] - blockHeight / 2}V${groundLevel}`, stroke: "var(--ink)", "stroke-width": 4
      });
    }
  const blocks = scene.blocks.map((_, i) => {
    const group = svgElement(svg, "g", { "data-block": i + 1 });
    svgElement(group, "rect", {
      x: -width / 2, y: -blockHeight / 2, width, height: blockHeight, rx: 3, fill: color(i), stroke: "var(--paper)"
    });
    if (width > 16)
      svgElement(group, "text", { "text-anchor": "middle", dy: "0.35em", fill: "var(--paper)" }, String(i + 1));
    return group;
  });
  // A run beside the exact motion: outlines.
  const outlines = scene.blocks.map((_, i) => svgElement(svg, "rect", {
    width, height: blockHeight, rx: 3, fill: "none", stroke: "var(--ink)", "stroke-width": 2, "stroke-dasharray": "5 3",
    y: y[i] - blockHeight / 2, visibility: "hidden", "data-outline": i + 1
  }));
  const sparks = scene.contacts.map((contact, k) => ({
    ...contact,
    times: scene.impacts.filter((impact) => impact.contact === k).map((impact) => impact.t),
    mark: svgElement(svg, "circle", { r: 13, fill: "var(--collision)", opacity: 0, "data-contact": k })
  }));
  const clock = svgElement(svg, "text", { x: stageWidth - 4, y: 18, "text-anchor": "end", fill: "var(--muted)" });

  const frame = document.querySelector(`[data-plot="${CSS.escape(stage.dataset.response)}"]`);
  const cursor = document.createElement("div");
  cursor.className = "cursor";
  cursor.hidden = true;
  function moveCursor() {
    const view = embedded[stage.dataset.response];
    if (!view || !frame) return;
    if (cursor.parentElement !== frame) frame.append(cursor);
    const axis = view.scale("x"), [lo, hi] = axis.domain();
    cursor.hidden = now < lo || now > hi;
    cursor.style.left = `${view.origin()[0] + axis(now)}px`;
  }

  // The latest impact of a contact up to now counts for a moment: a third of the time between two.
  function flash(times) {
    const passed = countUpTo(times, now);
    const moment = Math.min(0.012 * end, end / (3 * (times.length + 1)));
    return passed > 0 ? Math.max(0, 1 - (now - times[passed - 1]) / moment) : 0;
  }

  let now = 0, playing = false, last = 0, speed = 1;
  let beside = null;  // a run
  function placesOf({ t, u }) {
    const before = Math.min(Math.max(countUpTo(t, now), 1), t.length - 1) - 1;
    const share = Math.min(Math.max((now - t[before]) / (t[before + 1] - t[before] || 1), 0), 1);
    return u.map((of, i) => x[i] + scale * ((1 - share) * of[before] + share * of[before + 1]));
  }
  function show() {
    const at = placesOf(scene);
    const other = beside ? placesOf(beside) : [];
    outlines.forEach((outline, i) => {
      outline.setAttribute("visibility", beside ? "visible" : "hidden");
      if (beside) outline.setAttribute("x", (other[i] - width / 2).toFixed(2));
    });
    blocks.forEach((block, i) => block.setAttribute("transform", `translate(${at[i].toFixed(2)},${y[i]})`));
    for (const { one, other, path } of springs) {
      const foot = other < 0 ? [x[one], groundLevel] : [at[other], y[other]];
      const isLevel = other >= 0 && y[one] === y[other], half = 0.42 * width;
      path.setAttribute("d", isLevel
        ? `M${at[one]},${y[one]}L${foot[0]},${foot[1]}`
        : [-half, half].map((side) => `M${at[one] + side},${y[one]}L${foot[0] + side},${foot[1]}`).join(""));
    }
    sparks.forEach(({ left, right, times, mark }, k) => {
      const sides = [left >= 0 ? [at[left] + width / 2, y[left]] : null, right >= 0 ? [at[right] - width / 2, y[right]] : null]
        .filter((side) => side);
      // A contact of more than two masses has no place of its own: a lamp above.
      const middle = (axis) => sides.reduce((sum, side) => sum + side[axis], 0) / sides.length;
      mark.setAttribute("cx", sides.length ? middle(0) : 20 + 30 * k);
      mark.setAttribute("cy", sides.length ? middle(1) - blockHeight : 16);
      mark.setAttribute("opacity", flash(times).toFixed(3));
    });
    const text = `${now.toFixed(3)} s`;
    clock.textContent = text;
    slider.value = String(now);
    slider.setAttribute("aria-valuetext", text);
    moveCursor();
  }
  function seek(time) {
    now = Math.min(Math.max(time, 0), end);
    show();
  }
  function play(on) {
    playing = on;
    toggle.textContent = on ? "Pause" : "Play";
    toggle.setAttribute("aria-label", `${toggle.textContent}: ${what}`);
    if (!on) return;
    if (now >= end) now = 0;
    last = performance.now();
    requestAnimationFrame(tick);
  }
  function tick(time) {
    if (!playing) return;
    seek(now + (speed * Math.max(0, time - last)) / 1000);
    last = time;
    if (now >= end) play(false);
    else requestAnimationFrame(tick);
  }
  const allTimes = [...new Set(scene.impacts.map((impact) => impact.t))];
  const jump = (time) => { play(false); seek(time); };

  const toggle = button("Play", `Play: ${what}`, () => play(!playing));
  const slider = document.createElement("input");
  Object.assign(slider, { type: "range", min: "0", max: String(end), step: "any" });
  slider.setAttribute("aria-label", `Time: ${what}`);
  slider.addEventListener("input", () => jump(Number(slider.value)));
  const rate = document.createElement("select");
  rate.setAttribute("aria-label", `Speed: ${what}`);
  for (const [name, value] of [["1/16", 1 / 16], ["1/4", 1 / 4], ["1", 1], ["4", 4], ["16", 16]])
    rate.append(new Option(`${name} x`, String(value), value === 1, value === 1));
  rate.addEventListener("change", () => { speed = Number(rate.value); });
  const choice = document.createElement("select");
  choice.setAttribute("aria-label", `Beside the exact motion: ${what}`);
  choice.append(new Option("exact motion alone", "-1"));
  scene.runs.forEach((run, k) => choice.append(new Option(`beside it: ${run.name}, ${run.step}`, String(k))));
  choice.addEventListener("change", () => { beside = scene.runs[Number(choice.value)] || null; show(); });
  const frameSvg = () => withLightColors(new XMLSerializer().serializeToString(svg)
    .replace("<svg ", `<svg width="${stageWidth}" height="${stageHeight}" style="background:var(--paper)" `));
  const file = () => `clackers-${stage.dataset.player}-${now.toFixed(3)}s`;
  tools.append(
    toggle,
    button("◂ impact", `Impact before: ${what}`, () => jump(allTimes.findLast((t) => t < now - 1e-9 * end) ?? 0)),
    button("impact ▸", `Impact after: ${what}`, () => jump(allTimes.find((t) => t > now + 1e-9 * end) ?? end)),
    slider, rate, ...(scene.runs.length ? [choice] : []),
    button("SVG", `Save this moment as SVG: ${what}`, () => save(frameSvg(), "image/svg+xml", `${file()}.svg`)),
    button("PNG", `Save this moment as PNG: ${what}`, async () => save(await rasterized(frameSvg(), 2), "image/png", `${file()}.png`)));
  stage.addEventListener("keydown", (event) => {
    const step = end / 500;
    const moves = { ArrowLeft: -step, ArrowRight: step, PageUp: -10 * step, PageDown: 10 * step };
    if (event.key === " ") play(!playing);
    else if (event.key === "Home") jump(0);
    else if (event.key === "End") jump(end);
    else if (event.key in moves) jump(now + moves[event.key]);
    else return;
    event.preventDefault();
  });
  if (masses > 0) show();
}

for (const stage of document.querySelectorAll("[data-player]")) startPlayer(stage);
