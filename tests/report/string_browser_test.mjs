// A string that is drawn where it is: node string_browser_test.mjs FILE.html CASE, the page of `respond CASE`.
import { check, open, run } from "./browser.mjs";

const isHalf = process.argv[3] === "string-over-point";
const near = (a, b, tolerance = 0.02) => Math.abs(a - b) < tolerance;

await run(async () => {
  const page = await open(() => ["drawn", "failed"].includes(document.documentElement.dataset.figures));
  const motion = await page.evaluate(() => data.motion), { string } = motion;
  const slider = page.locator("[data-player] + .tools input");
  const drawn = () => page.evaluate(() => {
    const svg = document.querySelector("[data-player] svg"), number = (element, key) => Number(element.getAttribute(key));
    const line = svg.querySelector("[data-string]").getAttribute("d"), obstacle = svg.querySelector("[data-obstacle]").getBBox();
    return {
      points: [...svg.querySelectorAll("circle[data-block]")].map((point) => ({ x: number(point, "cx"), y: number(point, "cy") })),
      line: line.slice(1).split("L").map((at) => at.split(",").map(Number)),
      obstacle: { x: obstacle.x, y: obstacle.y, width: obstacle.width },
      flashes: [...svg.querySelectorAll("[data-contact]")].filter((mark) => number(mark, "opacity") > 0.9).map((mark) => ({ x: number(mark, "cx"), y: number(mark, "cy") }))
    };
  });
  const at = async (k) => {
    await slider.fill(String(motion.t[k]));
    return { ...(await drawn()), u: motion.u.map((of) => of[k]) };
  };
  const all = [await at(0), await at(333), await at(1000)], [first] = all;
  check("all nodes are drawn, ends fixed at one level", all.every(({ points }) => points.length === string.length
    && points[0].y === points.at(-1).y && points[0].y === first.points[0].y));
  const across = (first.points.at(-1).x - first.points[0].x) / (string.at(-1).x - string[0].x);
  check("from end to end over the stage", near(first.points[0].x, 60) && near(first.points.at(-1).x, 940)
    && first.points.every(({ x }, i) => near(x, 60 + across * (string[i].x - string[0].x))));
  const highest = string.findIndex(({ mass }) => mass >= 0 && first.u[mass] === Math.max(...first.u));
  const scale = (first.points[0].y - first.points[highest].y) / Math.max(...first.u);
  check("nodes move up by their displacements", scale > 50 && all.every(({ points, u }) => points.every(({ y }, i) =>
    near(y, points[0].y - (string[i].mass < 0 ? 0 : scale * u[string[i].mass])))), scale);
  const half = string.length / 2;
  check("a line joins them", all.every(({ points, line }) => points.every(({ x, y }, i) => {
    const at = line[isHalf && i >= half ? i + 1 : i];
    return at[0] === x && at[1] === y;
  })));
  check("all is on the stage", all.every(({ points }) => points.every(({ y }) => y >= 27.9 && y <= 272.1)));
  const level = isHalf ? -motion.contacts[0].gap : 0;
  check("what it touches is where it is", near(first.obstacle.y, first.points[0].y - scale * level)
    && (isHalf ? near(first.obstacle.x, 500) && first.obstacle.width === 0 : near(first.obstacle.x, 60) && near(first.obstacle.width, 880)), JSON.stringify(first.obstacle));
  if (isHalf)
    check("its middle is level or on the point", all.every(({ points, line }) => near(line[half][0], 500)
      && near(line[half][1], Math.min(points[half].y, first.obstacle.y))) && all.some(({ line }) => near(line[half][1], first.obstacle.y)));
  else {
    const { t, contact } = motion.impacts[0], own = string.findIndex(({ mass }) => mass === Math.max(motion.contacts[contact].left, motion.contacts[contact].right));
    await slider.fill(String(t));
    const { flashes, points } = await drawn();
    check("a node flashes at its impact", flashes.some(({ x, y }) => near(x, points[own].x) && near(y, points[0].y)), JSON.stringify(flashes));
  }
  check("its figure is explained", (await page.locator("figure:has([data-player]) .reading").innerText()).includes("nodes of the mesh"));
  check("a run is drawn as another line, and can be hidden", await page.evaluate(() => {
    const svg = svgElement(document.body, "svg", {}), scene = data.motion, show = drawMotion(svg, scene, 1), line = (what) => svg.querySelector(what);
    const isHidden = line("[data-outline]").getAttribute("visibility") === "hidden";
    show(scene.t[333], [scene]);
    const isOver = line("[data-outline]").getAttribute("visibility") === "visible" && line("[data-outline]").getAttribute("d") === line("[data-string]").getAttribute("d");
    show(scene.t[333], []);
    const isGone = line("[data-outline]").getAttribute("visibility") === "hidden";
    svg.remove();
    return isHidden && isOver && isGone;
  }));
  check("the page has no errors", page.said.length === 0, page.said.join("; "));
});
