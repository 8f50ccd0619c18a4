// Draws the figures of report pages as SVG, light and without a browser:
// node figures.mjs FOLDER PAGE.html ... writes FOLDER/PAGE-FIGURE.svg; of the page of a case only
// FOLDER/PAGE-case.svg: its system, or the response where that has no drawing. PAGE.html:FIGURE is one figure.
import { createRequire } from "node:module";
import { readFileSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";

const require = createRequire(new URL("../../../tools/web/package.json", import.meta.url));
const vega = require("vega");
const lite = require("vega-lite");

const page = (name) => readFileSync(new URL(`../../../clackers/report/page/${name}`, import.meta.url), "utf8");
const { Element, lightColors, drawScene, stageWidth, stageHeight } = new Function(
  `${page("svg_document.js")}; ${page("scene.js")}; return { Element, lightColors, drawScene, stageWidth, stageHeight };`)();

// The system where its motion starts.
function system(scene) {
  const svg = new Element("svg");
  for (const [key, value] of Object.entries({ xmlns: "http://www.w3.org/2000/svg", viewBox: `0 0 ${stageWidth} ${stageHeight}`,
    width: 0.6 * stageWidth, height: 0.6 * stageHeight, "font-family": "sans-serif", "font-size": 13 })) svg.setAttribute(key, value);
  drawScene(svg, scene).place(scene.u.map((u) => u[0]));
  return String(svg);
}

const [folder, ...pages] = process.argv.slice(2);
for (const [file, wanted] of pages.map((word) => word.split(":"))) {
  const html = readFileSync(file, "utf8");
  const read = (id) => JSON.parse(html.match(new RegExp(`<script type="application/json" id="${id}">(.*?)</script>`, "s"))[1]);
  const light = lightColors(html);
  const data = read("data");
  for (const [name, { columns, rows }] of Object.entries(data))  // as figures.js
    if (columns) data[name] = rows.map((row) => Object.fromEntries(columns.map((column, i) => [column, row[i]])));
  const write = (name, svg) => writeFileSync(join(folder, `${basename(file, ".html")}-${name}.svg`), svg);
  if (data.motion && !wanted) {
    write("case", light(system(data.motion)));
    continue;
  }
  for (const [name, specification] of Object.entries(read("specifications"))) {
    if (wanted && name !== wanted) continue;
    const layer = specification.layer.filter(({ mark }) => !mark || mark.opacity !== 0);  // points for tooltips
    const drawn = { ...specification, layer, datasets: data, width: 560, height: 220, background: "white",
      config: { legend: { orient: "bottom", columns: 3, labelLimit: 0 }, axis: { gridColor: "var(--grid)" } } };
    const view = new vega.View(vega.parse(lite.compile(JSON.parse(light(JSON.stringify(drawn)))).spec), { renderer: "none" });
    write(name === "response" && !wanted ? "case" : name, await view.toSVG());
  }
}
