// What the browser tests of html pages share: headless Chromium, checks, and what a page says and asks for.
import { createRequire } from "node:module";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const require = createRequire(new URL("../../tools/web/package.json", import.meta.url));
const { chromium } = require("playwright-core");
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

export const file = resolve(process.argv[2]);
const address = pathToFileURL(file).href;
const failures = [];
export function check(sentence, holds, found = "") {
  console.log(`${holds ? "ok  " : "FAIL"} ${sentence}${holds || found === "" ? "" : `: ${found}`}`);
  if (!holds) failures.push(sentence);
}

const profile = mkdtempSync(join(tmpdir(), "clackers-browser-"));
const context = await chromium.launchPersistentContext(profile, {
  executablePath: process.env.CHROMIUM || "/usr/bin/chromium",
  headless: true,
  acceptDownloads: true,
  viewport: { width: 1280, height: 900 },
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync"]
});

// Opens the page as a reader would; `ready` is evaluated in it until it is true.
export async function open(ready, options = {}) {
  const page = await context.newPage();
  page.said = [];
  page.requests = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) page.said.push(message.text());
  });
  page.on("pageerror", (error) => page.said.push(String(error)));
  page.on("request", (request) => {
    if (request.url() !== address && !/^(data|blob):/.test(request.url())) page.requests.push(request.url());
  });
  await page.emulateMedia({ colorScheme: options.dark ? "dark" : "light" });
  if (options.width) await page.setViewportSize({ width: options.width, height: 800 });
  await page.goto(address);
  await page.waitForFunction(ready, null, { timeout: 60000 });
  return page;
}

export async function violations(page) {
  await page.evaluate(axe);
  // The drawings are hidden from readers of the page by their frames; thousands of marks take axe minutes.
  const result = await page.evaluate(() => window.axe.run({ exclude: [[".plot svg"]] }, { resultTypes: ["violations"] }));
  return result.violations.filter((found) => ["serious", "critical"].includes(found.impact))
    .map((found) => `${found.id} (${found.nodes.length}): ${found.nodes[0].html.slice(0, 160)} ${found.nodes[0].failureSummary}`);
}

// Runs the checks of a page and ends the program: with 1 if one of them is false.
export async function run(checks) {
  try {
    await checks();
  } catch (error) {
    check("the test reached its end", false, error.stack || String(error));
  } finally {
    await context.close();
    rmSync(profile, { recursive: true, force: true });
  }
  if (failures.length > 0) {
    console.error(`${failures.length} of the checks failed`);
    process.exit(1);
  }
}
