"use strict";
// Draws the figures. Colours in specifications are variables of the style sheet, so that a change
// between light, dark and paper needs no new drawing; exports put the light values in their place.

const read = (id) => JSON.parse(document.getElementById(id).textContent);
const data = read("data");
const specifications = read("specifications");
for (const [name, { columns, rows }] of Object.entries(data))
  if (columns)
    data[name] = rows.map((row) => Object.fromEntries(columns.map((column, i) => [column, row[i]])));

const embedded = {};  // name of a figure -> its Vega view

function configuration(exporting) {
  const font = getComputedStyle(document.body).fontFamily;
  const ink = "var(--ink)", muted = "var(--muted)", line = "var(--line)";
  return {
    background: exporting ? "var(--paper)" : "transparent",
    font,
    aria: false,  // the frame around the figure carries the description
    padding: exporting ? 16 : { left: 2, right: 22, top: 8, bottom: 4 },
    view: { stroke: line },
    axis: {
      domainColor: "var(--faint)", tickColor: "var(--faint)", gridColor: "var(--grid)",
      labelColor: muted, titleColor: ink, labelFontSize: 12, titleFontSize: 12.5,
      titleFontWeight: "normal", titlePadding: 10, labelPadding: 5, labelFlush: false
    },
    title: { color: ink, fontSize: 14, fontWeight: 600, anchor: "start", offset: 12 },
    legend: {
      disable: !exporting, orient: "bottom", columns: 3, labelColor: ink, labelLimit: 320,
      symbolSize: 90, symbolStrokeWidth: 2, direction: "horizontal"
    },
    point: { shape: "circle" }
  };
}

// The title of the x axis follows the counter that the reader has chosen. Vega-Lite takes a fixed
// title alone, so that the compiled specification is given one that follows.
function followCounter(name) {
  const titles = (specifications[name].usermeta || {}).counters;
  return (compiled) => {
    for (const axis of titles ? compiled.axes : [])
      if (Object.values(titles).includes(axis.title)) axis.title = { signal: `${JSON.stringify(titles)}[counter]` };
    return compiled;
  };
}

// The data that a specification names, and no more.
function datasets(specification) {
  const names = new Set();
  JSON.stringify(specification, (key, value) => {
    if (key === "data" && value && value.name) names.add(value.name);
    return value;
  });
  return Object.fromEntries([...names].map((name) => [name, data[name]]));
}

function complete(name) {
  const specification = structuredClone(specifications[name]);
  specification.datasets = structuredClone(datasets(specification));
  return specification;
}

// Expressions are interpreted ("ast"), since the page's policy allows no code made of texts.
async function draw(name) {
  const frame = document.querySelector(`[data-plot="${name}"]`);
  const result = await vegaEmbed(frame, complete(name), {
    mode: "vega-lite", renderer: "svg", actions: false, ast: true, patch: followCounter(name), config: configuration(false),
    tooltip: { theme: "custom", disableDefaultStyle: false }
  });
  embedded[name] = result.view;
  frame.querySelector("svg").setAttribute("aria-hidden", "true");  // the frame has the description
  frame.dataset.drawn = "yes";
}

// Signals that say what the reader has chosen to see.
function chosen(view) {
  return view.getState({ signals: (name) => ["hidden", "mass", "counter"].includes(name), data: () => false }).signals;
}

// Zooms by a factor around the middle; on a logarithmic axis in decades.
function zoom(name, factor) {
  const view = embedded[name];
  for (const axis of ["x", "y"]) {
    const scale = view.scale(axis);
    const signal = zoomSignal(name, axis);
    const [lo, hi] = scale.domain();
    const bend = scale.type === "log" ? Math.log : (x) => x;
    const back = scale.type === "log" ? Math.exp : (x) => x;
    const middle = (bend(lo) + bend(hi)) / 2, half = (bend(hi) - bend(lo)) / 2 / factor;
    view.signal(signal, [back(middle - half), back(middle + half)]);
  }
  return view.runAsync();
}

// The name of the signal; null for a figure that has no zoom.
function zoomSignal(name, axis) {
  const find = (part) => {
    if (part.encoding && part.encoding[axis] && part.encoding[axis].field) return part.encoding[axis].field;
    for (const layer of part.layer || []) {
      const field = find(layer);
      if (field) return field;
    }
    return null;
  };
  const layers = specifications[name].layer || [];
  const zooms = layers.some((layer) => (layer.params || []).some((parameter) => parameter.name === "zoom"));
  return zooms ? `zoom_${find(specifications[name])}` : null;
}

function resetZoom(name) {
  const view = embedded[name];
  for (const axis of ["x", "y"]) view.signal(zoomSignal(name, axis), null);
  return view.runAsync();
}

// The light colours, whatever is on the screen.
function lightColors() {
  const rules = [...document.styleSheets].flatMap((sheet) => [...sheet.cssRules])
    .filter((rule) => rule.selectorText === ":root");
  return (variable) => {
    const rule = rules.find((one) => one.style.getPropertyValue(variable) !== "");
    if (rule === undefined) throw new Error(`the style sheet has no ${variable}`);
    return rule.style.getPropertyValue(variable).trim().replace(/^light-dark\((.*),.*\)$/, "$1");
  };
}

function withLightColors(text) {
  const color = lightColors();
  return text.replace(/var\((--[\w-]+)\)/g, (all, variable) => color(variable));
}

function title(name) {
  return document.querySelector(`[data-plot="${name}"]`).closest("figure").querySelector("h3").textContent;
}

// A specification that any Vega-Lite of version 5 draws: with its data, its legend and light colours.
function standalone(name) {
  const specification = complete(name);
  const state = chosen(embedded[name]);
  for (const parameter of specification.params || [])
    if (parameter.name in state) parameter.value = state[parameter.name];
  const titles = (specification.usermeta || {}).counters;
  if (titles)
    JSON.stringify(specification, (key, value) => {
      if (value && Object.values(titles).includes(value.title) && value.labelExpr) value.title = titles[state.counter];
      return value;
    });
  delete specification.usermeta;
  specification.width = 760;
  specification.title = title(name);
  specification.config = configuration(true);
  return JSON.parse(withLightColors(JSON.stringify(specification)));
}

async function asSvg(name) {
  const drawing = await vegaEmbed(document.createElement("div"), standalone(name), {
    mode: "vega-lite", renderer: "svg", actions: false, ast: true, tooltip: false
  });
  const view = drawing.view;
  // The picture shows the stretch that is on the screen.
  for (const axis of zoomSignal(name, "x") === null ? [] : ["x", "y"]) {
    const domain = embedded[name].signal(zoomSignal(name, axis));
    if (domain) view.signal(zoomSignal(name, axis), domain);
  }
  await view.runAsync();
  const text = await view.toSVG();
  drawing.finalize();
  return text;
}

const asPng = async (name) => rasterized(await asSvg(name), 2);

async function imageOf(svg) {
  const url = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = url;
    await image.decode();
    return image;
  } finally {
    URL.revokeObjectURL(url);
  }
}

async function rasterized(svg, scale) {
  const image = await imageOf(svg), canvas = document.createElement("canvas");
  canvas.width = image.width * scale;
  canvas.height = image.height * scale;
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
  return await new Promise((done) => canvas.toBlob(done, "image/png"));
}

// Rows with lists become rows with numbers, as Vega-Lite's "flatten" does.
function flat(rows) {
  return rows.flatMap((row) => {
    const lists = Object.keys(row).filter((key) => Array.isArray(row[key]));
    if (lists.length === 0) return [row];
    return row[lists[0]].map((_, i) =>
      Object.fromEntries(Object.entries(row).map(([key, value]) => [key, Array.isArray(value) ? value[i] : value])));
  });
}

function asCsv(rows) {
  const names = Object.keys(rows[0] || {});
  const cell = (value) => {
    const text = value === null || value === undefined ? "" : String(value);
    return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  return [names, ...flat(rows).map((row) => names.map((name) => row[name]))]
    .map((cells) => cells.map(cell).join(",")).join("\n") + "\n";
}
