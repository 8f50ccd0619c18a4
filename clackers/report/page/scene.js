"use strict";
// A system of masses as a drawing: blocks on columns, springs and stops, or bodies or strings where they are, in a scale
// that lets the widest motion fit. The manual's figures are drawn by it too.

const stageWidth = 1000, stageHeight = 300, groundLevel = 262, roofLevel = 46, blockHeight = 30, textSize = 13;

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
  const reach = Math.max(...scene.u.flat().map(Math.abs)) || 1;  // of a motion that rests from the start, any
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

// 1, 2 or 5 times a power of ten metres, at most 120 units long.
function rulerMetres(scale) {
  const most = 120 / Math.abs(scale), power = 10 ** Math.floor(Math.log10(most));
  return power * [5, 2, 1].find((step) => step * power <= most);
}

// An arrow along positive displacements.
function drawRuler(svg, scale) {
  const metres = rulerMetres(scale), length = scale * metres;
  const from = length > 0 ? 12 : 12 - length, tip = from + length, back = tip - 7 * Math.sign(length);
  svgElement(svg, "path", {
    d: `M${from},18H${tip}M${back},14L${tip},18L${back},22`, stroke: "var(--muted)", "stroke-width": 1.5, fill: "none"
  });
  svgElement(svg, "text", { x: 20 + Math.abs(length), y: 22, fill: "var(--muted)" }, `u = ${+metres.toPrecision(3)} m`);
}

// Draws the system. `place(u)` moves it to these displacements; `outline(attributes)` is another one on top, which its
// result moves, or hides without displacements; `touch(contact, u)` is where that contact flashes, `directions(contact)` are
// those in which its force acts, one a mass.
function drawScene(svg, scene) {
  if (scene.string?.length > 0) return drawString(svg, scene);
  return scene.plane != null || scene.lengths?.length > 0 ? drawBodies(svg, scene) : drawBlocks(svg, scene);
}

function drawBlocks(svg, scene) {
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
  const placeOf = (u, i) => x[i] + scale * u[i];
  function place(u) {
    const at = blocks.map((_, i) => placeOf(u, i));
    blocks.forEach((block, i) => block.setAttribute("transform", `translate(${at[i].toFixed(2)},${y[i]})`));
    for (const { one, other, path } of springs) {
      const foot = other < 0 ? [x[one], groundLevel] : [at[other], y[other]];
      const isLevel = other >= 0 && y[one] === y[other], half = 0.42 * width;
      path.setAttribute("d", isLevel
        ? `M${at[one]},${y[one]}L${foot[0]},${foot[1]}`
        : [-half, half].map((side) => `M${at[one] + side},${y[one]}L${foot[0] + side},${foot[1]}`).join(""));
    }
  }
  function outline(attributes) {
    const rects = blocks.map((_, i) => svgElement(svg, "rect", {
      width, height: blockHeight, rx: 3, y: y[i] - blockHeight / 2, visibility: "hidden", "data-outline": i + 1, ...attributes
    }));
    return (u) => rects.forEach((rect, i) => {
      rect.setAttribute("visibility", u ? "visible" : "hidden");
      if (u) rect.setAttribute("x", (placeOf(u, i) - width / 2).toFixed(2));
    });
  }
  function touch(contact, u) {
    const { left, right } = scene.contacts[contact];
    return middle([...(left < 0 ? [] : [[placeOf(u, left) + width / 2, y[left] - blockHeight]]),
      ...(right < 0 ? [] : [[placeOf(u, right) - width / 2, y[right] - blockHeight]])]);
  }
  const directions = (contact) => {
    const { left, right } = scene.contacts[contact];
    return [...(left < 0 ? [] : [[-1, 0]]), ...(right < 0 ? [] : [[1, 0]])];
  };
  return { place, outline, touch, directions, room: 0.45 * width };
}

// A string whose nodes move up and down, in a scale of their own, above what they may touch: a point, or a line.
function drawString(svg, scene) {
  const nodes = scene.string, top = 28, bottom = stageHeight - 28, side = 60;
  const levels = scene.contacts.map(({ left, gap }) => (left < 0 ? -gap : gap));
  const all = [...scene.u.flat(), ...levels, 0], low = Math.min(...all), high = Math.max(...all);
  const across = (stageWidth - 2 * side) / (nodes.at(-1).x - nodes[0].x), scale = (bottom - top) / (high - low);
  const levelOf = (u) => bottom - scale * (u - low), xOf = (x) => side + across * (x - nodes[0].x);
  const placeOf = ({ x, mass }, u) => [xOf(x), levelOf(mass < 0 ? 0 : u[mass])];
  // Where both halves move alike, a contact in the middle.
  const touched = scene.contacts.map(({ left, right }, i) => {
    const own = nodes.filter(({ mass }) => mass === Math.max(left, right));
    return [xOf(own.reduce((sum, { x }) => sum + x, 0) / own.length), levelOf(levels[i])];
  });
  const metres = rulerMetres(scale);
  svgElement(svg, "path", {
    d: `M12,${bottom}V${bottom - scale * metres}m-4,7l4,-7l4,7`, stroke: "var(--muted)", "stroke-width": 1.5, fill: "none"
  });
  svgElement(svg, "text", { x: 4, y: bottom + 18, fill: "var(--muted)" }, `u = ${+metres.toPrecision(3)} m`);
  svgElement(svg, "path", {
    d: touched.length === 1 ? `M${touched[0]}V${stageHeight}` : `M${xOf(nodes[0].x)},${touched[0][1]}H${xOf(nodes.at(-1).x)}`,
    stroke: "var(--ink)", "stroke-width": 4, "data-obstacle": touched.length
  });
  // Between two nodes that move alike one without mass, which is level with them or on the point.
  const corners = (u) => nodes.flatMap((node, i) => {
    const [x, y] = placeOf(node, u), isTwin = node.mass >= 0 && nodes[i + 1].mass === node.mass;
    return isTwin ? [[x, y], [touched[0][0], Math.min(y, touched[0][1])]] : [[x, y]];
  });
  function draw(attributes) {
    const path = svgElement(svg, "path", { fill: "none", "stroke-width": 2, ...attributes });
    return (u) => {
      path.setAttribute("visibility", u ? "visible" : "hidden");
      if (u) path.setAttribute("d", `M${corners(u).map((corner) => corner.map((at) => at.toFixed(2))).join("L")}`);
    };
  }
  const line = draw({ stroke: "var(--m1)", "data-string": nodes.length });
  const points = nodes.map(({ mass }) => svgElement(svg, "circle", { r: 4, fill: mass < 0 ? "var(--ink)" : "var(--m1)", "data-block": mass + 1 }));
  function place(u) {
    line(u);
    points.forEach((point, i) => placeOf(nodes[i], u).forEach((at, axis) => point.setAttribute(["cx", "cy"][axis], at.toFixed(2))));
  }
  return {
    place, outline: (attributes) => draw({ ...attributes, "data-outline": 1, visibility: "hidden" }),
    touch: (contact) => touched[contact], directions: () => [[0, -1]]
  };
}

function middle(points) {
  return [0, 1].map((axis) => points.reduce((sum, point) => sum + point[axis], 0) / points.length);
}

// Bodies where they are: pendula, or one body in the plane, turned by its third displacement. Bodies are drawn with a
// radius that they do not have: walls stand off by it, and pendula that meet hang side by side.
function drawBodies(svg, scene) {
  const { contacts } = scene, isPlane = scene.plane != null, spins = isPlane && scene.u.length > 2;
  const radius = spins ? 24 : isPlane ? 7 : 12, sign = scene.leftward ? -1 : 1;
  const shiftOf = (i) => radius * (contacts.some(({ left, right }) => left >= 0 && right === i)
    - contacts.some(({ left, right }) => left === i && right >= 0));
  const bodies = isPlane
    ? [{ arm: 0, shift: 0, pivot: (u) => u, angle: (u) => (spins ? (u[2] * scale) / radius : 0) }]
    : scene.lengths.map((arm, i) => ({ arm, shift: shiftOf(i), pivot: () => [0, arm], angle: (u) => (sign * u[i]) / arm }));
  const walls = contacts.map(({ left, right, gap }) => {
    const mass = Math.max(left, right), side = left < 0 ? -1 : 1;
    if (left >= 0 && right >= 0) return null;
    return isPlane ? { side, axis: mass, at: side * gap } : { side, axis: 0, at: side * bodies[mass].arm * Math.sin(gap / bodies[mass].arm) };
  });

  const states = scene.t.map((_, k) => scene.u.map((of) => of[k])), wall = scene.plane ?? 0;
  const [wide, tall] = [0, 1].map((axis) => [...(wall > 0 ? [-wall, wall] : []),
    ...walls.flatMap((one) => (one?.axis === axis ? [one.at] : [])),
    ...bodies.flatMap(({ arm, pivot, angle }) => states.flatMap((u) => [pivot(u)[axis],
      pivot(u)[axis] + (arm && arm * [Math.sin(angle(u)), -Math.cos(angle(u))][axis])]))
  ].reduce(([lo, hi], value) => [Math.min(lo, value), Math.max(hi, value)], [Infinity, -Infinity]));
  const margin = 4 + radius * (isPlane ? 1 : 2), top = 28, bottom = stageHeight - 28;
  const scale = Math.min((stageWidth - 2 * margin) / (wide[1] - wide[0]), (bottom - top - 2 * margin) / (tall[1] - tall[0]));
  const pixel = ([x, y]) => [stageWidth / 2 + scale * (x - (wide[0] + wide[1]) / 2), (top + bottom) / 2 - scale * (y - (tall[0] + tall[1]) / 2)];
  const hung = ({ shift, pivot }, u) => { const [x, y] = pixel(pivot(u)); return [x + shift, y]; };
  const center = (body, u) => {
    const [x, y] = hung(body, u), angle = body.angle(u), arm = scale * body.arm;
    return [x + arm * Math.sin(angle), y + arm * Math.cos(angle)];
  };

  drawRuler(svg, sign * scale);
  const line = { stroke: "var(--ink)", "stroke-width": 4, fill: "none" }, [cx, cy] = pixel([0, 0]);
  if (wall > 0) svgElement(svg, "circle", { cx, cy, r: scale * wall + radius + 2, ...line });
  for (const { side, axis, at } of walls.filter((one) => one)) {
    const off = side * (radius + 2), [x, y] = pixel([at, at]), from = pixel([wide[0], tall[0]]), to = pixel([wide[1], tall[1]]);
    svgElement(svg, "path", { d: axis === 0 ? `M${x + off},${to[1] - radius - 4}V${from[1] + radius + 4}`
      : `M${from[0] - radius - 4},${y - off}H${to[0] + radius + 4}`, ...line });
  }
  bodies.forEach((body, i) => {
    let last = [Infinity, 0], d = "";
    for (const point of states.map((u) => center(body, u)))
      if (Math.hypot(point[0] - last[0], point[1] - last[1]) >= 1) {
        d += `${d ? "L" : "M"}${point.map((value) => value.toFixed(1))}`;
        last = point;
      }
    svgElement(svg, "path", { d, stroke: "var(--faint)", fill: "none", "data-path": i + 1 });
  });
  // Moves and turns about the center, to which a spoke leads, or the pivot, on which a rod hangs.
  function draw(body, attributes) {
    const group = svgElement(svg, "g", attributes), arm = scale * body.arm;
    if (arm > 0) svgElement(group, "path", { d: `M0,0V${arm}` });
    svgElement(group, "circle", { cy: arm, r: radius });
    if (spins) svgElement(group, "path", { d: `M0,0H${radius}`, ...(attributes.fill === "none" ? {} : { stroke: "var(--paper)" }) });
    return (u) => {
      group.setAttribute("visibility", u ? "visible" : "hidden");
      if (u) group.setAttribute("transform",
        `translate(${hung(body, u).map((at) => at.toFixed(2))}) rotate(${((-180 / Math.PI) * body.angle(u)).toFixed(2)})`);
    };
  }
  const drawAll = (attributesOf) => {
    const moves = bodies.map((body, i) => draw(body, attributesOf(i)));
    return (u) => moves.forEach((move) => move(u));
  };
  return {
    place: drawAll((i) => ({ fill: `var(--m${(i % 8) + 1})`, stroke: "var(--ink)", "stroke-width": 2, "data-block": i + 1 })),
    outline: (attributes) => drawAll((i) => ({ ...attributes, "data-outline": i + 1, visibility: "hidden" })),
    // Of a round wall, which is no contact of the problem, at the body itself.
    touch: (contact, u) => {
      const { left, right } = contacts[contact] ?? {}, { side = 0, axis } = walls[contact] ?? {};
      const [x, y] = middle(bodies.filter((_, i) => isPlane || i === left || i === right).map((body) => center(body, u)));
      return axis === 0 ? [x + side * radius, y] : [x, y - side * radius];
    },
    directions: (contact) => {
      const { side, axis } = walls[contact] ?? {};
      return side === undefined ? [[-1, 0], [1, 0]] : [axis === 0 ? [-side, 0] : [0, side]];
    }
  };
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

// Arrows of the forces of contacts that stay closed, the largest of them `room` units long. The function returned draws
// those of an instant.
function drawForces(svg, forces, { touch, directions, room = 40 }) {
  const largest = Math.max(...forces.u.flat(), 0);
  const arrows = forces.u.flatMap((of, contact) => (of.every((force) => !(force > 0)) ? [] : [{
    contact,
    path: svgElement(svg, "path", { stroke: "var(--impact)", "stroke-width": 3, fill: "none", visibility: "hidden", "data-force": contact })
  }]));
  return (now, u) => arrows.forEach(({ contact, path }) => {
    const force = valuesAt(forces, now)[contact], length = (room * force) / largest;
    path.setAttribute("visibility", force > 0 ? "visible" : "hidden");
    if (!(force > 0)) return;
    const [x, y] = touch(contact, u), head = Math.min(7, length);
    path.setAttribute("d", [`M${x - 5},${y}a5,5 0 1 0 10,0a5,5 0 1 0 -10,0`, ...directions(contact).map(([dx, dy]) => {
      const tip = [x + dx * length, y + dy * length], back = [tip[0] - dx * head, tip[1] - dy * head];
      return `M${x},${y}L${tip}M${back[0] - dy * head},${back[1] + dx * head}L${tip}L${back[0] + dy * head},${back[1] - dx * head}`;
    })].join(""));
  });
}

// The rows of a curve at an instant, between its points on straight lines.
function valuesAt({ t, u }, now) {
  const before = Math.min(Math.max(countUpTo(t, now), 1), t.length - 1) - 1;
  const share = Math.min(Math.max((now - t[before]) / (t[before + 1] - t[before] || 1), 0), 1);
  return u.map((of) => (1 - share) * of[before] + share * of[before + 1]);
}

// The system in motion, with contacts that flash at impacts and show their force while they stay closed, and the
// outlines of up to `most` runs beside it. The function returned draws an instant.
function drawMotion(svg, scene, most) {
  const drawn = drawScene(svg, scene), { place, outline, touch } = drawn, end = scene.t.at(-1);
  const outlines = Array.from({ length: most }, (_, run) => outline({
    fill: "none", stroke: outlineColor(run), "stroke-width": 2, "stroke-dasharray": "5 3"
  }));
  const sparks = [...new Set(scene.impacts.map((impact) => impact.contact))].map((contact) => ({
    contact,
    times: scene.impacts.filter((impact) => impact.contact === contact).map((impact) => impact.t),
    mark: svgElement(svg, "circle", { r: 13, fill: "var(--impact)", opacity: 0, "data-contact": contact })
  }));
  const forcesAt = drawForces(svg, scene.forces ?? { t: [0], u: [] }, drawn);
  const clock = svgElement(svg, "text", { x: stageWidth - 4, y: 22, "text-anchor": "end", fill: "var(--muted)" });
  return (now, runs) => {
    const u = valuesAt(scene, now);
    outlines.forEach((move, run) => move(runs[run] && valuesAt(runs[run], now)));
    place(u);
    forcesAt(now, u);
    // The latest impact of a contact up to now counts for a moment: a third of the time between two.
    for (const { contact, times, mark } of sparks) {
      const latest = times[countUpTo(times, now) - 1] ?? -Infinity;
      const moment = Math.min(0.012 * end, end / (3 * (times.length + 1)));
      const flash = Math.max(0, 1 - (now - latest) / moment);
      mark.setAttribute("opacity", flash.toFixed(3));
      if (flash === 0) continue;
      const [cx, cy] = touch(contact, valuesAt(scene, latest));
      mark.setAttribute("cx", cx);
      mark.setAttribute("cy", cy);
    }
    clock.textContent = `${now.toFixed(3)} s`;
  };
}
