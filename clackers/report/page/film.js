"use strict";
// The frames of a film: node film.js FOLDER FRAMES WIDTH, after svg_document.js and scene.js in one file. FOLDER has
// motion.json, what player.js draws, and page.css; it gets 00001.svg, 00002.svg, ...
const { readFileSync, writeFileSync } = require("node:fs");
const { join } = require("node:path");

const [folder, frames, pixels] = [process.argv[2], Number(process.argv[3]), Number(process.argv[4])];
const scene = JSON.parse(readFileSync(join(folder, "motion.json"), "utf8"));
const light = lightColors(readFileSync(join(folder, "page.css"), "utf8"));
const most = 7, runs = scene.runs.slice(0, most);  // colours to tell them apart
const escaped = (text) => text.replace(/[&<>]/g, (sign) => `&#${sign.charCodeAt(0)};`);

const svg = new Element("svg");
for (const [key, value] of Object.entries({ xmlns: "http://www.w3.org/2000/svg", viewBox: `0 0 ${stageWidth} ${stageHeight}`,
  width: pixels, height: (pixels * stageHeight) / stageWidth, "font-family": "sans-serif", "font-size": textSize })) svg.setAttribute(key, value);
const show = drawMotion(svg, scene, runs.length);
let x = 12;
const names = ["exact", ...runs.map((run) => `${run.name}, ${run.step}`)];
names.forEach((name, k) => {
  const text = svgElement(svg, "text", { x, y: stageHeight - 12, fill: k === 0 ? "var(--ink)" : outlineColor(k - 1) }, escaped(name));
  x += 8 * name.length + 24;
});
for (let i = 0; i < frames; ++i) {
  show((scene.t.at(-1) * i) / (frames - 1), runs);
  writeFileSync(join(folder, `${String(i + 1).padStart(5, "0")}.svg`), light(String(svg)));
}
