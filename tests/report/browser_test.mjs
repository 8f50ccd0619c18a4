// Opens the html report in headless Chromium as a reader would: node browser_test.mjs FILE.html
// Every sentence below is a check; the program fails if one of them is false.
import { readFileSync, statSync } from "node:fs";
import { check, file, open as openPage, run, violations } from "./browser.mjs";

const figures = ["response", "convergence", "history", "work", "profile"];
const open = (options) => openPage(() => ["drawn", "failed"].includes(document.documentElement.dataset.figures), options);

// How many marks of a kind a figure has drawn.
const marks = (page, name, selector) => page.locator(`[data-plot="${name}"] svg ${selector}`).count();

async function download(page, name, label) {
  const [saved] = await Promise.all([
    page.waitForEvent("download"),
    page.locator(`[data-tools="${name}"] button`, { hasText: label }).click()
  ]);
  return readFileSync(await saved.path());
}

await run(async () => {
  const bytes = statSync(file).size;
  check("the page is smaller than 2 MB", bytes < 2e6, `${bytes} bytes`);

  const page = await open();
  check("all figures are drawn", await page.evaluate(() => document.documentElement.dataset.figures) === "drawn");
  for (const name of figures)
    check(`figure ${name} has lines`, await marks(page, name, "g.mark-line path") > 0);
  check("the response marks six impacts",
    await marks(page, "response", "g.mark-rule.role-mark line") === 6 && await marks(page, "response", "g.mark-symbol path[fill='var(--impact)']") === 6);
  const methods = await page.locator('[data-legend^="convergence"] button[data-series]').count();
  check("the convergence plot has an envelope for every method that ran", methods === 7 &&
    await page.evaluate(() => new Set(data.levels.map((row) => row.method)).size) === methods);
  check("the convergence plot shows every finished run",
    await marks(page, "convergence", "g.mark-symbol path[opacity='0.38']") === await page.evaluate(
      () => data.runs.filter((run) => run.finished === "yes").length));
  check("three slope triangles are labelled", JSON.stringify(await page.evaluate(() => data.slopes.map((s) => s.order))) === '["1","2","4"]');
  check("the verdict table comes first", await page.evaluate(() =>
    Boolean(document.querySelector("table.verdicts").compareDocumentPosition(document.querySelector("figure"))
      & Node.DOCUMENT_POSITION_FOLLOWING)));
  check("every link within the page leads somewhere", await page.evaluate(() =>
    [...document.querySelectorAll('a[href^="#"]')].every((link) => document.querySelector(link.getAttribute("href")))));

  // What can be pressed.
  const first = page.locator('[data-legend^="convergence"] button[data-series]').first();
  const before = await marks(page, "convergence", "g.mark-symbol path");
  await first.focus();
  await page.keyboard.press("Enter");
  await page.waitForFunction(([was]) => document.querySelectorAll('[data-plot="convergence"] svg g.mark-symbol path').length < was, [before]);
  check("a legend entry pressed on the keyboard hides its method",
    await first.getAttribute("aria-pressed") === "false");
  await first.press("Enter");
  await page.waitForFunction(([was]) => document.querySelectorAll('[data-plot="convergence"] svg g.mark-symbol path').length === was, [before]);

  const span = () => page.evaluate(() => { const [lo, hi] = embedded.convergence.scale("x").domain(); return Math.log(hi / lo); });
  const whole = await span();
  const tools = page.locator('[data-tools="convergence"] button');
  await tools.nth(0).click();
  await page.waitForTimeout(100);
  check("the zoom button zooms by its factor in decades", Math.abs(await span() / whole - 1 / 1.5) < 1e-9, `${await span()} of ${whole}`);
  await tools.nth(2).click();
  await page.waitForTimeout(100);
  check("the reset button shows everything again", Math.abs(await span() / whole - 1) < 1e-9);

  await page.locator('[data-plot="convergence"]').evaluate((frame) => frame.scrollIntoView({ block: "center" }));
  await page.waitForTimeout(100);
  const box = await page.locator('[data-plot="convergence"] svg').boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.keyboard.down("Control");
  await page.mouse.wheel(0, -200);
  await page.keyboard.up("Control");
  await page.waitForTimeout(100);
  check("Ctrl and the wheel zoom", await span() < 0.95 * whole);
  const zoomed = await span();
  await page.mouse.wheel(0, 50);
  await page.waitForTimeout(100);
  check("the wheel alone scrolls the page and does not zoom", await span() === zoomed);
  await tools.nth(2).click();

  await page.locator('[data-mass="2"]').click();
  await page.waitForTimeout(100);
  check("the error of mass 2 can be chosen", await page.evaluate(() => embedded.history.signal("mass")) === 2);

  // The player.
  const stage = page.locator('[data-player="motion"]');
  const player = (label) => stage.locator("xpath=following-sibling::div[1]").locator("button", { hasText: label });
  const clock = () => stage.locator('svg > text[text-anchor="end"]').innerHTML();
  const place = (mass) => page.evaluate((i) =>
    Number(document.querySelector(`[data-player] [data-block="${i}"]`).getAttribute("transform").match(/\(([-\d.]+)/)[1]), mass);
  const spark = () => stage.locator("[data-contact]").getAttribute("opacity").then(Number);
  check("the motion starts at its beginning with a block a mass",
    await stage.locator("[data-block]").count() === 2 && await clock() === "0.000 s", await clock());
  const apart = await place(1) - await place(2);
  await player("impact ▸").focus();
  await page.keyboard.press("Enter");
  check("the next impact is where the masses meet and flash", await clock() === "1.571 s" && await spark() > 0.99,
    `${await clock()}, ${await spark()}`);
  check("masses move apart by their displacements", await place(1) - await place(2) < apart - 100);
  const line = page.locator('[data-plot="response"] .cursor');
  check("a line in the response shows the time", await line.isVisible() && await page.evaluate(() =>
    Math.abs(parseFloat(document.querySelector(".cursor").style.left) - embedded.response.scale("x")(Math.PI / 2)
      - embedded.response.origin()[0]) < 0.01));
  await stage.focus();
  await page.keyboard.press("Home");
  check("a key goes back to the beginning", await clock() === "0.000 s" && await spark() === 0);
  await page.keyboard.press("Space");
  for (let tries = 0; tries < 100 && !(parseFloat(await clock()) > 0.2); ++tries) await page.waitForTimeout(50);
  await page.keyboard.press("Space");
  const held = await clock();
  await page.waitForTimeout(100);
  check("a key plays and pauses", await clock() === held && await player("Play").count() === 1, `${held}, ${await clock()}`);
  await stage.locator("xpath=following-sibling::div[1]").locator("input").fill("20");
  check("the slider goes to any time", await clock() === "20.000 s");
  await stage.locator("xpath=following-sibling::div[1]").locator("select").nth(1).selectOption({ index: 1 });
  const outline = await page.locator('[data-outline="1"]').evaluate((rect) => Number(rect.getAttribute("x")) + Number(rect.getAttribute("width")) / 2);
  check("a run stands beside the exact motion as outlines", Math.abs(outline - await place(1)) < 1
    && await page.locator('[data-outline="1"]').getAttribute("visibility") === "visible", `${outline}, ${await place(1)}`);
  const frame = async (label) => {
    const [saved] = await Promise.all([page.waitForEvent("download"), player(label).click()]);
    return readFileSync(await saved.path());
  };
  const still = (await frame("SVG")).toString();
  check("a moment is saved as SVG with colours of its own", still.startsWith("<svg ") && !still.includes("var(--"));
  await stage.locator("xpath=following-sibling::div[1]").locator("select").nth(0).selectOption("16");
  check("the motion is saved as a film", (await frame("Film")).subarray(0, 4).toString("hex") === "1a45dfa3");
  check("a moment is saved as PNG", (await frame("PNG")).subarray(1, 4).toString() === "PNG");

  // What is counted, chosen on the keyboard.
  const axisTitle = (name) => page.locator(`[data-plot="${name}"] svg .role-axis-title text`).first().innerHTML();
  check("work is shown by force evaluations first", await axisTitle("work") === "force evaluations", await axisTitle("work"));
  const spread = () => page.evaluate(() => embedded.work.scale("x").domain().map(Math.log10));
  const forces = await spread();
  await page.locator('[data-counter="seconds"][data-of="work"]').focus();
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => embedded.work.signal("counter") === "seconds");
  await page.waitForTimeout(100);
  check("a counter pressed on the keyboard is the axis of work", await axisTitle("work") === "processor time [s]"
    && (await spread())[1] < 1 && forces[1] > 3, `${await axisTitle("work")} ${await spread()}`);
  check("the pressed counter is marked as such, and no other", JSON.stringify(await page.locator('[data-of="work"][aria-pressed="true"]').allInnerTexts()) === '["processor time [s]"]');
  const timed = JSON.parse((await download(page, "work", "Vega-Lite")).toString());
  check("work is saved by the counter on the screen", timed.params.find((parameter) => parameter.name === "counter").value === "seconds"
    && timed.layer[0].encoding.x.axis.title === "processor time [s]" && timed.usermeta === undefined);
  await page.locator('[data-counter="steps"][data-of="profile"]').press("Space");
  await page.waitForTimeout(100);
  check("the profile follows its own counter", await axisTitle("profile") === "times the least steps"
    && await axisTitle("work") === "processor time [s]", await axisTitle("profile"));
  check("the lines of a profile end at one ratio", await page.evaluate(() => new Set(
    data.profile.filter((row) => row.counter === "steps").map((row) => row.ratio.at(-1))).size) === 1);
  await page.locator('[data-counter="force_evaluations"][data-of="work"]').click();

  // All metrics of a method, on the keyboard.
  const summary = page.locator("details.metrics summary").first();
  check("metrics are folded away", !(await page.locator("details.metrics table").first().isVisible()));
  await summary.focus();
  await page.keyboard.press("Enter");
  check("Enter unfolds the metrics of a method", await page.locator("details.metrics table").first().isVisible()
    && await page.locator("details.metrics table").first().locator("tbody tr").count() > 0);
  await page.keyboard.press("Enter");

  await page.locator('[data-plot="convergence"]').scrollIntoViewIfNeeded();
  await page.locator('[data-plot="convergence"] g.mark-symbol path[opacity="1"]').nth(3).hover({ force: true });
  await page.waitForSelector("#vg-tooltip-element.visible");
  const told = await page.locator("#vg-tooltip-element").innerText();
  check("a point tells its method and numbers", /method\s+\S+[\s\S]*step h \[s\]\s+\d[\s\S]*error in u\s+\d/.test(told), told);

  // What is pointed at stands out everywhere.
  const linked = figures.filter((name) => name !== "response");
  const standing = (name) => page.evaluate((figure) => {
    // Opacity of the curves of a figure, one an svg path.
    const paths = document.querySelectorAll(`[data-plot="${figure}"] svg g.mark-line path`);
    return [...paths].map((path) => Number(path.getAttribute("opacity") ?? 1)).filter((value) => value < 1).length;
  }, name);
  const fadedEverywhere = async () => (await Promise.all(linked.map(standing)));
  await page.mouse.move(2, 2);
  await page.waitForFunction(() => pointed === null);
  check("no curve is faded while nothing is pointed at", (await fadedEverywhere()).every((count) => count === 0), await fadedEverywhere());
  await page.locator('[data-plot="convergence"] g.mark-symbol path[opacity="1"]').nth(3).hover({ force: true });
  await page.waitForFunction(() => pointed !== null);
  await page.waitForTimeout(100);
  check("a method pointed at in one figure stands out in all",
    JSON.stringify(await fadedEverywhere()) === JSON.stringify(linked.map(() => methods - 1)), await fadedEverywhere());
  check("its name is marked in the legend", await page.evaluate(() =>
    [...document.querySelectorAll("button.pointed")].map((toggle) => toggle.dataset.series).join() === pointed));
  await page.mouse.move(2, 2);
  await page.waitForFunction(() => pointed === null);
  await first.focus();
  await page.waitForTimeout(100);
  check("a legend entry with the keyboard's focus picks its method out", await standing("history") === methods - 1
    && await page.evaluate(() => pointed) === await first.getAttribute("data-series"));
  await first.press("Enter");
  await page.waitForTimeout(100);
  check("a method that is hidden fades no other", await page.evaluate(() => pointed) === null && await standing("history") === 0);
  await first.press("Enter");
  await page.evaluate(() => document.activeElement.blur());
  await page.waitForTimeout(100);
  // By colour alone some readers cannot tell methods apart.
  const curves = (name) => page.evaluate((figure) => [...document.querySelectorAll(`[data-plot="${figure}"] svg g.mark-line path`)]
    .filter((path) => path.getAttribute("stroke") !== "var(--faint)")  // the slope triangles
    .map((path) => `${path.getAttribute("stroke")} ${path.getAttribute("stroke-dasharray")}`), name);
  const markers = (name) => page.evaluate((figure) => [...document.querySelectorAll(`[data-plot="${figure}"] svg g.mark-symbol path[opacity="1"]`)]
    .map((path) => `${path.getAttribute("fill")} ${path.getAttribute("d")}`), name);
  for (const name of linked) {
    const lines = await curves(name), points = new Set(await markers(name));
    check(`figure ${name} draws every method with its own colour and dash`, lines.length === methods && new Set(lines).size === methods, lines);
    check(`figure ${name} draws every method with its own marker`, points.size === methods, [...points]);
  }

  // What can be saved.
  for (const name of figures) {
    const svg = (await download(page, name, "SVG")).toString();
    check(`figure ${name} is saved as SVG with fixed colours`, svg.startsWith("<svg") && !svg.includes("var(") && svg.includes("mark-line"));
  }
  const png = await download(page, "convergence", "PNG");
  check("a figure is saved as PNG", png.subarray(1, 4).toString() === "PNG" && png.length > 20000, `${png.length} bytes`);
  const csv = (await download(page, "convergence", "CSV")).toString().trim().split("\n");
  check("the data of all runs is saved as CSV", csv[0].startsWith("case,method,") &&
    csv.length === 1 + await page.evaluate(() => data.runs.length), `${csv.length} lines`);
  for (const name of figures) {
    const rows = (await download(page, name, "CSV")).toString().trim().split("\n");
    check(`the data behind figure ${name} is saved as CSV`, rows.length > 10 &&
      rows.every((row) => row.split(",").length >= rows[0].split(",").length), rows[0]);
  }
  const specification = JSON.parse((await download(page, "history", "Vega-Lite")).toString());
  check("a specification is saved with its data", specification.$schema.includes("vega-lite/v5") &&
    specification.datasets.history.length > 0 && !JSON.stringify(specification).includes("var(--"));

  // With the keyboard alone: Tab reaches all that can be pressed, in the order of the page.
  await page.evaluate(() => { document.activeElement.blur(); scrollTo(0, 0); });
  const pressable = await page.evaluate(() => {
    const all = [...document.querySelectorAll("a[href], button, input, select, summary, [tabindex='0']")]
      .filter((element) => element.checkVisibility());
    all.forEach((element, i) => { element.dataset.order = i; });
    all[0].focus();
    return all.length;
  });
  const reached = [0];
  for (let i = 1; i < pressable + 5; ++i) {
    await page.keyboard.press("Tab");
    const order = await page.evaluate(() => document.activeElement.dataset.order ?? null);
    if (order === null) break;
    reached.push(Number(order));
  }
  check("Tab reaches every link, button and table in the order of the page",
    reached.length === pressable && reached.every((order, i) => order === i), `${reached.length} of ${pressable}: ${reached}`);
  await page.evaluate(() => { document.activeElement.blur(); scrollTo(0, 0); });
  await page.waitForTimeout(50);

  // For everybody, with everything unfolded.
  const unfold = (on) => on.evaluate(() => { for (const one of document.querySelectorAll("details.metrics")) one.open = true; });
  await unfold(page);
  for (const theme of ["light", "dark"]) {
    await page.evaluate((name) => { document.documentElement.dataset.theme = name; }, theme);
    const found = await violations(page);
    check(`axe finds nothing serious in the ${theme} theme`, found.length === 0, found.join("\n     "));
  }
  const ink = () => page.evaluate(() => getComputedStyle(document.querySelector('[data-plot="convergence"] svg .role-axis-title text')).fill);
  await page.evaluate(() => { document.documentElement.dataset.theme = "light"; });
  const light = await ink();
  await page.evaluate(() => { document.documentElement.dataset.theme = "dark"; });
  check("figures follow the theme", light !== await ink(), light);
  await page.emulateMedia({ media: "print" });
  check("paper is light even from the dark theme", light === await ink());
  check("the page says nothing on the console", page.said.length === 0, page.said.join("; "));
  check("the page asks the network for nothing", page.requests.length === 0, page.requests.join(" "));
  await page.close();

  const narrow = await open({ width: 400, dark: true });
  await unfold(narrow);
  const overflow = await narrow.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
  check("at 400 pixels nothing is wider than the screen", overflow <= 0, `${overflow} pixels too wide`);
  const found = await violations(narrow);
  check("axe finds nothing serious at 400 pixels", found.length === 0, found.join("\n     "));
  check("the narrow page says nothing on the console", narrow.said.length === 0, narrow.said.join("; "));
  await narrow.close();
});
