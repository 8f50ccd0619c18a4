"use strict";
// A system of masses as a drawing: blocks on columns, springs and stops, in one scale that lets the widest motion
// fit. The manual's figures are drawn by it too.

const stageWidth = 1000, stageHeight = 300, groundLevel = 262, roofLevel = 46, blockHeight = 30;

function svgElement(parent, tag, attributes, text) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  parent.append(element);
  return element;
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
  const scale = Math.min((stageWidth - slots * width) / metres, (1.5 * width) / reach);
  const x = [];
  let at = (stageWidth - slots * width - (metres - 2.4 * reach) * scale) / 2;
  for (let column = 0; column < slots; ++column) {
    for (const i of inColumn(column)) x[i] = at + width / 2;
    at += width + (gaps[column] || 0) * scale;
  }
  const y = scene.blocks.map((block) => groundLevel - block.height * (groundLevel - roofLevel));
  return { x, y, width, scale: scene.leftward ? -scale : scale };
}

// An arrow along positive displacements whose length is 1, 2 or 5 times a power of ten metres.
function drawRuler(svg, scale) {
  const most = 120 / Math.abs(scale), power = 10 ** Math.floor(Math.log10(most));
  const metres = power * [5, 2, 1].find((step) => step * power <= most), length = scale * metres;
  const from = length > 0 ? 12 : 12 - length, tip = from + length, back = tip - 7 * Math.sign(length);
  svgElement(svg, "path", {
    d: `M${from},18H${tip}M${back},14L${tip},18L${back},22`, stroke: "var(--muted)", "stroke-width": 1.5, fill: "none"
  });
  svgElement(svg, "text", { x: 20 + Math.abs(length), y: 22, fill: "var(--muted)" }, `u = ${+metres.toPrecision(3)} m`);
}

// Draws the system; `place(at)` moves the blocks to these places and the springs with them.
function drawScene(svg, scene) {
  const { x, y, width, scale } = layout(scene);
  drawRuler(svg, scale);
  svgElement(svg, "path", { d: `M0,${groundLevel}H${stageWidth}`, stroke: "var(--faint)", "stroke-width": 2 });
  const springs = scene.springs.map(({ one, other }) => ({
    one, other, path: svgElement(svg, "path", { stroke: "var(--muted)", "stroke-width": 2, fill: "none" })
  }));
  for (const { left, right, gap } of scene.contacts)
    if ((left < 0) !== (right < 0)) {  // a stop
      const mass = Math.max(left, right), side = left < 0 ? -1 : 1;
      const face = x[mass] + side * (width / 2 + gap * Math.abs(scale));
      svgElement(svg, "path", {
        d: `M${face},${y[mass] - blockHeight / 2}V${groundLevel}`, stroke: "var(--ink)", "stroke-width": 4
      });
    }
  const blocks = scene.blocks.map((_, i) => {
    const group = svgElement(svg, "g", { "data-block": i + 1 });
    svgElement(group, "rect", {
      x: -width / 2, y: -blockHeight / 2, width, height: blockHeight, rx: 3, fill: `var(--m${(i % 8) + 1})`, stroke: "var(--paper)"
    });
    if (width > 16)
      svgElement(group, "text", { "text-anchor": "middle", dy: "0.35em", fill: "var(--paper)" }, String(i + 1));
    return group;
  });
  function place(at) {
    blocks.forEach((block, i) => block.setAttribute("transform", `translate(${at[i].toFixed(2)},${y[i]})`));
    for (const { one, other, path } of springs) {
      const foot = other < 0 ? [x[one], groundLevel] : [at[other], y[other]];
      const isLevel = other >= 0 && y[one] === y[other], half = 0.42 * width;
      path.setAttribute("d", isLevel
        ? `M${at[one]},${y[one]}L${foot[0]},${foot[1]}`
        : [-half, half].map((side) => `M${at[one] + side},${y[one]}L${foot[0] + side},${foot[1]}`).join(""));
    }
  }
  return { x, y, width, scale, place };
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

function outlineColor(run) { return run === 0 ? "var(--ink)" : `var(--m${(run + 2) % 8 + 1})`; }

// The system in motion, with contacts that flash at impacts and the outlines of up to `most` runs beside it. The
// function returned draws an instant.
function drawMotion(svg, scene, most) {
  const { x, y, width, scale, place } = drawScene(svg, scene), end = scene.t.at(-1);
  const outlines = Array.from({ length: most }, (_, run) => scene.blocks.map((_, i) => svgElement(svg, "rect", {
    width, height: blockHeight, rx: 3, fill: "none", stroke: outlineColor(run), "stroke-width": 2, "stroke-dasharray": "5 3",
    y: y[i] - blockHeight / 2, visibility: "hidden", "data-outline": i + 1
  })));
  const sparks = scene.contacts.map((contact, k) => ({
    ...contact,
    times: scene.impacts.filter((impact) => impact.contact === k).map((impact) => impact.t),
    mark: svgElement(svg, "circle", { r: 13, fill: "var(--impact)", opacity: 0, "data-contact": k })
  }));
  const clock = svgElement(svg, "text", { x: stageWidth - 4, y: 18, "text-anchor": "end", fill: "var(--muted)" });
  const placesOf = ({ t, u }, now) => {
    const before = Math.min(Math.max(countUpTo(t, now), 1), t.length - 1) - 1;
    const share = Math.min(Math.max((now - t[before]) / (t[before + 1] - t[before] || 1), 0), 1);
    return u.map((of, i) => x[i] + scale * ((1 - share) * of[before] + share * of[before + 1]));
  };
  // The latest impact of a contact up to now counts for a moment: a third of the time between two.
  const flash = (times, now) => {
    const passed = countUpTo(times, now);
    const moment = Math.min(0.012 * end, end / (3 * (times.length + 1)));
    return passed > 0 ? Math.max(0, 1 - (now - times[passed - 1]) / moment) : 0;
  };
  return (now, runs) => {
    const at = placesOf(scene, now);
    outlines.forEach((blocks, run) => {
      const other = runs[run] && placesOf(runs[run], now);
      blocks.forEach((outline, i) => {
        outline.setAttribute("visibility", other ? "visible" : "hidden");
        if (other) outline.setAttribute("x", (other[i] - width / 2).toFixed(2));
      });
    });
    place(at);
    for (const { left, right, times, mark } of sparks) {
      const sides = [left >= 0 ? [at[left] + width / 2, y[left]] : null, right >= 0 ? [at[right] - width / 2, y[right]] : null]
        .filter((side) => side);
      const middle = (axis) => sides.reduce((sum, side) => sum + side[axis], 0) / sides.length;
      mark.setAttribute("cx", middle(0));
      mark.setAttribute("cy", middle(1) - blockHeight);
      mark.setAttribute("opacity", flash(times, now).toFixed(3));
    }
    clock.textContent = `${now.toFixed(3)} s`;
  };
}
