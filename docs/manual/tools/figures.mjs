// Draws the figures of report pages as SVG, light and without a browser:
// node figures.mjs FOLDER PAGE.html ... writes FOLDER/PAGE-FIGURE.svg.
import { createRequire } from "node:module";
import { readFileSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";

const require = createRequire(new URL("../../../tools/web/package.json", import.meta.url));
const vega = require("vega");
const lite = require("vega-lite");

const [folder, ...pages] = process.argv.slice(2);
for (const page of pages) {
  const html = readFileSync(page, "utf8");
  const read = (id) => JSON.parse(html.match(new RegExp(`<script type="application/json" id="${id}">(.*?)</script>`, "s"))[1]);
  const colors = Object.fromEntries([...html.matchAll(/(--[\w-]+): light-dark\((#\w+),/g)].map((found) => found.slice(1)));
  const data = read("data");
  for (const [name, specification] of Object.entries(read("specifications"))) {
    const drawn = { ...specification, datasets: data, width: 560, height: 220, background: "white",
      config: { legend: { orient: "bottom" }, axis: { gridColor: "var(--grid)" } } };
    const light = JSON.parse(JSON.stringify(drawn).replace(/var\((--[\w-]+)\)/g, (all, variable) => colors[variable]));
    const view = new vega.View(vega.parse(lite.compile(light).spec), { renderer: "none" });
    writeFileSync(join(folder, `${basename(page, ".html")}-${name}.svg`), await view.toSVG());
  }
}
