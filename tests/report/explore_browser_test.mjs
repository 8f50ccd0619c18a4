// Opens a page with dials in headless Chromium: node explore_browser_test.mjs FILE.html [MEMBERS.json]
import { readFileSync } from "node:fs";
import { check, file, open as openPage, run, violations } from "./browser.mjs";

const open = (options) => openPage(() => ["drawn", "failed"].includes(document.documentElement.dataset.figures), options);
const turn = (page, name, value) => page.locator(`#${name}`).fill(String(value));
const settled = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
const orders = (page) => page.evaluate(() => Object.fromEntries([...document.querySelectorAll("#facts dt")].map((term) =>
  [term.textContent, Number((term.nextElementSibling.textContent.match(/order ([-\d.]+)/) || [])[1])])));

await run(async () => {
  const page = await open();
  check("all figures are drawn", await page.evaluate(() => document.documentElement.dataset.figures) === "drawn");

  const members = JSON.parse(readFileSync(process.argv[3] ?? `${file}.json`, "utf8"));
  const worst = await page.evaluate((rows) => Math.max(...rows.flatMap(([X, r, xi1, eta, t, ...known]) => {
    const { u, v } = synchronizedPair({ X, r, xi1, eta }).at(t);
    return [...u, ...v].map((value, i) => Math.abs(value - known[i]) / known[i + 4]);
  })), members);
  check("the motion is that of the library in 10,000 random members", members.length === 10000 && worst < 1e-12, worst);
  console.log(`     largest difference ${worst.toExponential(1)} of the envelope`);

  check("the paper's motion has six impacts", await page.evaluate(() => data.impacts.length) === 6);
  await turn(page, "a_t", 2);
  await settled(page);
  check("a dial moves the motion", await page.evaluate(() => data.impacts.length) === 13);
  check("the figures follow", await page.locator('[data-plot="response"] svg g.mark-rule.role-mark line').count() === 13);
  check("the player follows", await page.locator("[data-player] + .tools input").getAttribute("max") === "40");
  check("the address keeps the dials", new URL(page.url()).hash.includes("a_t=2"));
  await page.locator("#reset").click();
  for (let i = 2; i < 5; ++i) await page.locator(`#run${i}`).check();
  await settled(page);
  const found = await orders(page);
  check("located impacts keep order 4", Math.abs(found["RK4, impacts located"] - 4) < 0.2, JSON.stringify(found));
  for (const name of ["RK4, impacts at the step's end", "Newmark, impacts at the step's end", "Moreau-Jean"])
    check(`order 1: ${name}`, found[name] > 0.6 && found[name] < 1.6, JSON.stringify(found));
  check("a spring as contact does not converge to the rigid motion", await page.evaluate(() =>
    Math.min(...data.ladder.filter((row) => row.of === "Newmark, penalty spring").map((row) => row.error))) > 0.03);
  await turn(page, "X", 3);
  await settled(page);
  check("a mass ratio beyond the limit is shown at the limit, with the reason",
    (await page.locator("#note").textContent()).includes("shown is r = 2.95"), await page.locator("#note").textContent());
  await page.locator("#xi1").focus();
  await page.keyboard.press("ArrowRight");
  check("the keyboard turns dials", await page.locator("#xi1").inputValue() === "0.055");
  check("the command has the same motion", (await page.locator("#again-command").textContent()).startsWith("clackers respond synchronized-pair --set X=3,r=2.95,xi1=0.05"));

  await page.evaluate(() => { dial("xi1").max = 0.9; });
  await turn(page, "xi1", 0.6);
  await turn(page, "a_t", 0.25);
  await settled(page);
  check("one impact is enough to know the time between impacts", await page.evaluate(() => data.impacts.length === 1
    && document.querySelectorAll("#facts dd")[1].textContent) === "3.927 s", await page.locator("#facts dd").nth(1).textContent());

  for (const options of [{}, { dark: true }, { width: 390 }]) {
    const other = await open(options);
    const found = await violations(other);
    check(`no barrier for assistive technology, ${JSON.stringify(options)}`, found.length === 0, found.join("\n"));
    check(`nothing is wider than the page, ${JSON.stringify(options)}`,
      await other.evaluate(() => document.documentElement.scrollWidth <= document.documentElement.clientWidth));
    check("the page says nothing on the console and asks for nothing", other.said.length + other.requests.length === 0, other.said.join("\n"));
  }
});
