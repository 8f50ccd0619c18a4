// Contacts that stay closed: node force_browser_test.mjs FILE.html, the page of `respond CASE`.
import { check, open, run } from "./browser.mjs";

await run(async () => {
  const page = await open(() => ["drawn", "failed"].includes(document.documentElement.dataset.figures));
  const motion = await page.evaluate(() => data.motion);
  const [force] = motion.forces.u, { left, right } = motion.contacts[0];
  const strongest = force.indexOf(Math.max(...force)), open_at = motion.forces.t[force.findIndex((value) => value === 0)];
  // Of a constant force the same.
  const half = Math.max(force.findIndex((value, k) => k > strongest && value > 0 && value < 0.8 * force[strongest]), strongest);
  const drawn = async (t) => {
    await page.locator("[data-player] + .tools input").fill(String(t));
    return page.evaluate(() => {
      const path = document.querySelector("[data-force]"), { x, y, width } = path.getBBox();
      return { isVisible: path.getAttribute("visibility") === "visible", x, y, width, blocks: [...document.querySelectorAll("[data-block] rect")]
        .map((rect) => Number(rect.parentNode.getAttribute("transform").match(/translate\(([^,]+),/)[1]) + Number(rect.getAttribute("x"))) };
    });
  };
  check("an open contact has no force", !(await drawn(open_at)).isVisible, open_at);
  const most = await drawn(motion.forces.t[strongest]), less = await drawn(motion.forces.t[half]);
  check("a closed one has an arrow", most.isVisible && less.isVisible && most.width > 20);
  const arrows = (left >= 0) + (right >= 0), ring = arrows === 2 ? 0 : 5;
  check("as long as the force", Math.abs((less.width - ring) / (most.width - ring) - force[half] / force[strongest]) < 0.03, JSON.stringify([less, most]));
  const face = most.blocks[Math.max(left, right)];
  check("from where the masses touch, to each of them", Math.abs(most.x + (arrows === 2 ? most.width / 2 : 5) - face) < 1, JSON.stringify([most, face]));
  check("its figure says so", (await page.locator("figure:has([data-player]) .reading").innerText()).includes("arrow"));
  check("the page has no errors", page.said.length === 0, page.said.join("; "));
});
