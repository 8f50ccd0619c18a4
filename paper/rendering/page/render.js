"use strict";
// node render.js FOLDER NAME ...: draws NAME.vl.json of the folder as NAME.svg. A warning of Vega-Lite is an error here: it would say that
// a part of a figure was left out.
const fs = require("fs");
const path = require("path");
const vm = require("vm");

for (const library of ["vega.min.js", "vega-lite.min.js"])
  vm.runInThisContext(fs.readFileSync(path.join(__dirname, library), "utf8"), { filename: library });

// Without a canvas Vega takes 0.8 of the font size for every character, half more than any font of
// ours needs. These are the widths of Arial, with a tenth for the wider fonts that may stand in.
function width(item, text) {
  const shape = (c) =>
    "ijl|'".includes(c) ? 0.22 : " fIt.,:;!()[]/".includes(c) ? 0.28 : "mMwW".includes(c) ? 0.85
      : c >= "A" && c <= "Z" ? 0.7 : 0.556;
  const words = String(text === undefined ? item.text : text);
  return 1.1 * (item.fontSize || 11) * [...words].reduce((sum, c) => sum + shape(c), 0);
}
vega.textMetrics.width = width;

function fail(message) {
  throw new Error(message);
}
const strict = { level() { return this; }, error: fail, warn: fail, info() { return this; }, debug() { return this; } };

async function draw(folder, name) {
  const specification = JSON.parse(fs.readFileSync(path.join(folder, `${name}.vl.json`), "utf8"));
  const compiled = vegaLite.compile(specification, { logger: strict }).spec;
  const view = new vega.View(vega.parse(compiled), { renderer: "none", logger: strict });
  const svg = await view.toSVG();
  fs.writeFileSync(path.join(folder, `${name}.svg`), svg + "\n");
  view.finalize();
}

(async () => {
  const [folder, ...names] = process.argv.slice(2);
  for (const name of names)
    await draw(folder, name).catch((error) => fail(`${name}: ${error.message}`));
})().catch((error) => {
  process.stderr.write(`${error.message}\n`);
  process.exit(1);
});
