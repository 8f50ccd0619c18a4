// Opens the page of an atlas in headless Chromium as a reader would: node atlas_browser_test.mjs FILE.html
// Every sentence below is a check; the program fails if one of them is false.
import { readFileSync } from "node:fs";
import { check, open as openPage, run, violations } from "./browser.mjs";

const open = (options) => openPage(() => document.documentElement.dataset.atlas === "shown", options);
const rows = (page) => page.locator("#grid tbody tr:not(.group)").count();
const names = (page) => page.locator("#grid tbody th[scope='row'] .name").allInnerTexts();
const drawn = (page, name) => page.waitForFunction((figure) => document.getElementById("panel").dataset.drawn === figure, name);
const marks = (page, name, selector) => page.locator(`[data-plot="${name}"] svg ${selector}`).count();
const cell = (page, method, system) => page.locator(`td[data-m="${method}"][data-s="${system}"]`);

async function save(page, name, label) {
  const [saved] = await Promise.all([
    page.waitForEvent("download"), page.locator(`[data-tools="${name}"] button`, { hasText: label }).click()]);
  return readFileSync(await saved.path()).toString();
}

async function matrix(page) {
  check("the matrix has a row for each method, of others too", await rows(page) === 9, await rows(page));
  check("and a column for each system", await page.locator("th.system").count() === 7);
  check("columns of a case stand by its parameters, with four digits", JSON.stringify((await page.locator("th.system").allInnerTexts()).slice(0, 3)) ===
    '["N=1 xi1=0.05","N=1 xi1=0.1167","N=2 xi1=0.05"]', await page.locator("th.system").allInnerTexts());
  check("their tips have all digits", /^three-parameter N=1 xi1=0\.1166666666666666\d$/.test(await page.locator("th.system").nth(1).getAttribute("title")));
  check("a cell shows its behaviour by colour and by symbol", await cell(page, 0, 0).getAttribute("class") === "cell b-proper" &&
    await cell(page, 0, 0).locator("use").getAttribute("href") === "#sign-proper");
  check("what does not agree with its claim has a corner", (await cell(page, 3, 0).getAttribute("class")).includes("wrong-claim"));
  check("a cell says in words what it shows", /^newmark on three-parameter .*: proper, agrees, order 2\.01/.test(
    await cell(page, 0, 0).getAttribute("aria-label")), await cell(page, 0, 0).getAttribute("aria-label"));
  check("no figure of a cell, a method or a system is drawn unasked", await page.evaluate(() =>
    Object.keys(embedded).every((name) => name === "profile")));
}

async function filters(page) {
  await page.fill("#find", "newmark penalty:");
  check("text finds methods by all its words", JSON.stringify(await names(page)) === '["newmark"]', await names(page));
  await page.fill("#find", "");
  await page.selectOption("#treatment", "reversal");
  check("a treatment can be chosen", await rows(page) === 1);
  await page.click("#reset");
  await page.selectOption("#case", "stop");
  check("a case can be chosen", await page.locator("th.system").count() === 1 && await rows(page) === 8);
  await page.click("#reset");
  await page.locator('#behaviours [data-word="reduced"]').click();
  check("a behaviour leaves the methods that show it", JSON.stringify(await names(page)) === '["generalized-alpha:rho=0.8"]', await names(page));
  await page.locator('#verdicts [data-word="agrees"]').click();
  check("behaviour and verdict must both fit", await page.locator(".nothing").isVisible());
  await page.click("#reset");
  check("everything can be shown again", await rows(page) === 9);
  await page.locator('#verdicts [data-word="refused"]').press("Enter");
  check("a verdict is chosen on the keyboard, other cells fade", await rows(page) === 1, await rows(page));
  await page.click("#reset");
}

async function orders(page) {
  await page.uncheck("#grouped");
  await page.selectOption("#sort", "u_error");
  const listed = await names(page);
  check("the smallest errors come first", listed[0] === "rk4" && listed.at(-1) === "newmark+penalty:stiffness=1e6", listed);
  await page.selectOption("#sort", "order");
  check("the highest orders come first", (await names(page))[0] === "rk4");
  await page.selectOption("#sort", "name");
  const sorted = await names(page);
  check("methods are sorted by name", JSON.stringify(sorted) === JSON.stringify([...sorted].sort((a, b) => a.localeCompare(b))));
  await page.selectOption("#show", "order");
  check("cells can show the observed order", (await cell(page, 2, 0).innerText()) === "4.0", await cell(page, 2, 0).innerText());
  await page.selectOption("#show", "u_error");
  check("and the power of ten of the error", /^−\d+$/.test(await cell(page, 2, 0).innerText()), await cell(page, 2, 0).innerText());
  await page.selectOption("#show", "verdict");
  check("and the verdict", await cell(page, 3, 0).locator("use").getAttribute("href") === "#sign-disagrees");
  await page.selectOption("#show", "behaviour");
  await page.selectOption("#sort", "listed");
  await page.check("#grouped");
}

async function keys(page) {
  await page.locator("#reset").focus();
  for (const chip of await page.locator(".chips button").all()) { await page.keyboard.press("Tab"); void chip; }
  await page.keyboard.press("Tab");
  check("Tab reaches the matrix as one stop", await page.evaluate(() => document.activeElement.closest("#grid") !== null));
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("ArrowDown");
  const at = () => page.evaluate(() => [document.activeElement.dataset.m, document.activeElement.dataset.s]);
  check("the arrow keys move over a heading into the rows", JSON.stringify(await at()) === '["0","4"]', await at());
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Enter");
  await drawn(page, "ladder");
  check("Enter opens a cell and goes to its panel", await page.evaluate(() => document.activeElement.id) === "panel-title");
  await page.keyboard.press("Escape");
  check("Escape closes it and goes back", await page.locator("#panel").isHidden() && JSON.stringify(await at()) === '["0","5"]', await at());
  await page.keyboard.press("Control+End");
  check("Control and End go to the last cell", await page.evaluate(() => document.activeElement === document.querySelector("#grid").rows[document.querySelector("#grid").rows.length - 1].cells[7]));
  const head = page.locator("tr.group th").first();
  await head.press("Enter");
  check("a group is closed on the keyboard", await rows(page) < 9 && await head.getAttribute("aria-expanded") === "false");
  await head.press("Enter");
  check("and opened again", await rows(page) === 9);
}

async function panels(page) {
  await cell(page, 0, 4).click();
  await drawn(page, "ladder");
  const panel = page.locator("#panel");
  check("a cell opens its convergence plot", await marks(page, "ladder", "g.mark-symbol path") === 12 && await marks(page, "ladder", "g.mark-line path") >= 2,
    await marks(page, "ladder", "g.mark-symbol path"));
  check("with the slope that is claimed", (await panel.locator("svg").last().innerHTML()).includes("claimed order 2"));
  const command = await panel.locator("#panel-command").innerText();
  check("and the command that computes it again", command === "clackers verify newmark --case three-parameter --set N=1,xi1=0.05 --levels 4 --samples-per-level 2", command);
  await page.evaluate(() => { navigator.clipboard.writeText = async (text) => { window.copied = text; }; });
  await panel.locator("[data-copy]").click();
  check("which a button copies", await page.evaluate(() => window.copied) === command);
  check("the numbers stand beside", /Impacts\s+6 of 6 \(0 missed, 0 extra\)/.test(await panel.innerText()), await panel.innerText());
  check("the runs are saved as CSV", (await save(page, "ladder", "CSV")).split("\n").length === 10);
  check("the plot is saved as SVG with fixed colours", !(await save(page, "ladder", "SVG")).includes("var("));
  await cell(page, 5, 0).click();
  await page.waitForFunction(() => document.getElementById("panel-title").textContent === "newmark+penalty");
  await drawn(page, "ladder");
  check("without a claimed order there is no slope", !(await panel.locator("svg").last().innerHTML()).includes("claimed order"));
  await cell(page, 7, 0).click();
  check("a refused method says why", (await panel.innerText()).includes("[penalty-needs-elastic]"));
  await cell(page, 8, 4).click();
  await drawn(page, "ladder");
  check("results of others say whose they are", (await panel.innerText()).includes("Results of A. <b>Author</b>, 2025-11-21"));
  check("a command of others is not to be copied", await panel.locator("[data-copy]").count() === 0 &&
    (await panel.locator("#panel-command").innerText()).includes("--exec './theirs <i>{h}</i>'"));
  check("whatever their file holds is text", await page.locator("main b").count() === 0);

  await page.locator('tbody th[data-m="0"]').click();
  await drawn(page, "map");
  check("a method opens its map over two parameters", await marks(page, "map", "g.mark-rect path") === 6, await marks(page, "map", "g.mark-rect path"));
  await page.selectOption("#map-what", "u_error");
  await drawn(page, "map");
  check("of the error too", /10⁻/.test(await page.locator('[data-plot="map"] svg').innerHTML()));
  await page.selectOption("#map-x", "xi1");
  await page.waitForFunction(() => embedded.map.scale("x").domain().length === 2);
  check("with the parameters that are chosen", JSON.stringify(await page.evaluate(() => embedded.map.scale("y").domain())) === '["3","2","1"]');
  check("a map is saved as SVG", (await save(page, "map", "SVG")).startsWith("<svg"));

  await page.locator('th.system[data-s="0"]').click();
  await drawn(page, "work");
  const front = await page.evaluate(() => data.work_front.map((row) => [row.work, row.u_error]));
  check("a system opens its Pareto front, which only falls", front.length > 1 && front.every(([work, error], i) =>
    i === 0 || (work > front[i - 1][0] && error < front[i - 1][1])), front);
  await page.selectOption("#work-counter", "steps");
  await page.waitForFunction(() => specifications.work.layer[0].encoding.x.axis.title === "steps");
  await page.click("#sort-here");
  check("the methods can be sorted by a system", await page.locator("#sort").inputValue() === "system");
  await page.selectOption("#sort", "listed");
  await page.locator("[data-front]").first().click();
  await drawn(page, "ladder");
  check("a method of the front opens its cell", (await page.locator("#panel-title").innerText()).length > 0);
  await page.click("#panel-close");
}

async function profile(page) {
  await page.locator("#profile").scrollIntoViewIfNeeded();
  await page.waitForFunction(() => document.documentElement.dataset.profile);
  check("the profile is drawn when it comes into view", await marks(page, "profile", "g.mark-line path") === 8,
    await marks(page, "profile", "g.mark-line path"));
  const legend = page.locator("#profile-legend .entry");
  check("each of its lines has an entry in the legend", await legend.count() === 8);
  const before = await page.evaluate(() => document.documentElement.dataset.profile);
  await page.fill("#find", "newmark");
  await page.waitForFunction((was) => document.documentElement.dataset.profile !== was, before);
  check("it follows the filters of the matrix", await legend.count() === 4, await legend.count());
  await page.fill("#find", "");
  await page.locator("#profile-counters button", { hasText: "steps" }).click();
  check("and counts what is chosen", await page.locator('#profile-counters [aria-pressed="true"]').innerText() === "steps");
}

await run(async () => {
  const page = await open();
  for (const part of [matrix, filters, orders, keys, panels, profile]) await part(page);
  for (const theme of ["light", "dark"]) {
    await page.evaluate((name) => { document.documentElement.dataset.theme = name; }, theme);
    await cell(page, 3, 0).click();
    await drawn(page, "ladder");
    const found = await violations(page);
    check(`axe finds nothing serious in the ${theme} theme`, found.length === 0, found.join("\n     "));
  }
  check("the page says nothing on the console", page.said.length === 0, page.said.join("; "));
  check("the page asks the network for nothing", page.requests.length === 0, page.requests.join(" "));
  await page.close();

  const narrow = await open({ width: 400, dark: true });
  await cell(narrow, 0, 4).click();
  await drawn(narrow, "ladder");
  const overflow = await narrow.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
  check("at 400 pixels nothing is wider than the screen", overflow <= 0, `${overflow} pixels too wide`);
  check("and the panel is as wide as it", await narrow.evaluate(() => document.getElementById("panel").clientWidth) === 400);
  const found = await violations(narrow);
  check("axe finds nothing serious at 400 pixels", found.length === 0, found.join("\n     "));
  check("the narrow page says nothing on the console", narrow.said.length === 0, narrow.said.join("; "));
});
