// Bodies that are drawn where they are: node bodies_browser_test.mjs FILE.html CASE, the page of `respond CASE`.
import { check, open, run } from "./browser.mjs";

const name = process.argv[3];
const near = (a, b, tolerance = 0.5) => Math.abs(a - b) < tolerance;

await run(async () => {
  const page = await open(() => ["drawn", "failed"].includes(document.documentElement.dataset.figures));
  const slider = page.locator("[data-player] + .tools input");
  const seek = (t) => slider.fill(String(t));
  // The circles of the bodies, the flash and the walls, in units of the drawing.
  const drawn = () => page.evaluate(() => {
    const svg = document.querySelector("[data-player] svg"), all = (what) => [...svg.querySelectorAll(what)];
    const number = (element, key) => Number(element.getAttribute(key));
    return {
      bodies: all("[data-block] circle").map((circle) => {
        const at = svg.getScreenCTM().inverse().multiply(circle.getScreenCTM()), { x, y } = new DOMPoint(0, number(circle, "cy")).matrixTransform(at);
        return { x, y, arm: number(circle, "cy"), r: number(circle, "r"), turn: -Math.atan2(at.b, at.a) };  // to the left
      }),
      flashes: all("[data-contact]").filter((mark) => number(mark, "opacity") > 0.9).map((mark) => ({ x: number(mark, "cx"), y: number(mark, "cy") })),
      round: all("circle[fill=none]").map((wall) => ({ x: number(wall, "cx"), y: number(wall, "cy"), r: number(wall, "r") - 2 })),
      straight: all(":scope > path[stroke-width='4']").map((wall) => wall.getBBox()).map(({ x, y, width, height }) => ({ x, y, width, height })),
      paths: all("[data-path]").map((path) => {
        const { x, y } = path.getPointAtLength(0);
        return { x, y, length: path.getTotalLength() };
      })
    };
  });
  const motion = await page.evaluate(() => data.motion);
  // The drawing and the displacements at a time of the motion.
  const at = async (k) => {
    await seek(motion.t[k]);
    return { ...(await drawn()), u: motion.u.map((of) => of[k]) };
  };
  const first = await at(0), middle = await at(700), last = await at(1500), all = [first, middle, last];
  await seek(motion.impacts[0].t);
  const impact = await drawn(), [body] = impact.bodies;
  check("the first impact flashes", impact.flashes.length === 1, JSON.stringify(impact.flashes));
  const [flash] = impact.flashes;

  if (motion.plane !== null) {
    check("one body is drawn", all.every(({ bodies }) => bodies.length === 1));
    const scale = (middle.bodies[0].x - first.bodies[0].x) / (middle.u[0] - first.u[0]);
    check("it moves by u1 to the right and by u2 upwards, in one scale", scale > 20 && all.every(({ bodies, u }) =>
      near(bodies[0].x - first.bodies[0].x, scale * (u[0] - first.u[0])) && near(bodies[0].y - first.bodies[0].y, -scale * (u[1] - first.u[1]))), scale);
    let way = 0;
    for (let k = 1; k < motion.t.length; ++k) way += Math.hypot(motion.u[0][k] - motion.u[0][k - 1], motion.u[1][k] - motion.u[1][k - 1]);
    check("the line is its path", near(impact.paths[0].length / (scale * way), 1, 0.02), impact.paths[0].length / (scale * way));
    if (name === "circle-billiard") {
      const [wall] = impact.round, toWall = ({ x, y, r }) => wall.r - r - Math.hypot(x - wall.x, y - wall.y);
      check("it touches the round wall at an impact, and only there", near(toWall(body), 0, 1) && all.every(({ bodies }) => toWall(bodies[0]) > 5), toWall(body));
      check("the wall has its radius, and the stage is about it", near(wall.r - body.r, scale) && near(wall.x, 500) && near(wall.y, 150) && wall.r + 4 < 122.5, wall.r);
      check("the flash is at the body", near(flash.x, body.x, 1) && near(flash.y, body.y, 1));
    } else if (name === "billiard") {
      check("it touches the upper wall", near(Math.min(...impact.straight.filter(({ width }) => width > 0).map(({ y }) => y)) + 2 + body.r, body.y, 1), JSON.stringify(impact));
      check("four walls make the box", impact.straight.length === 4 && near(Math.max(...impact.straight.map(({ width }) => width)), scale + 2 * body.r + 8, 1)
        && near(Math.max(...impact.straight.map(({ height }) => height)), 0.75 * scale + 2 * body.r + 8, 1), JSON.stringify(impact.straight));
      await seek(motion.impacts[1].t);
      const { bodies: [next], flashes, straight } = await drawn();
      check("it touches the right wall, and flashes there", near(Math.max(...straight.map(({ x }) => x)) - 2 - next.r, next.x, 1)
        && flashes.some(({ x, y }) => near(x, next.x + next.r, 1) && near(y, next.y, 1)), JSON.stringify(flashes));
      check("walls stand at their gaps", await page.evaluate(() => {
        const svg = svgElement(document.body, "svg", {}), contacts = data.motion.contacts.map((contact) => ({ ...contact, gap: contact.gap + 1 }));
        drawScene(svg, { ...data.motion, contacts });
        const boxes = [...svg.querySelectorAll("path[stroke-width='4']")].map((wall) => wall.getBBox());
        svg.remove();
        const [wide, tall] = ["width", "height"].map((side) => Math.max(...boxes.map((box) => box[side])) - 22);
        return Math.abs(wide / tall - 3 / 2.75) < 1e-3;
      }));
    } else {
      const [floor] = impact.straight;
      check("it touches the floor at an impact, and flashes below", near(floor.y - 2 - body.r, body.y, 1) && near(flash.y, body.y + body.r, 1)
        && near(flash.x, body.x, 1), JSON.stringify([floor, body, flash]));
      check("a spoke turns by u3 over the radius", all.every(({ bodies: [{ turn, r }], u }) =>
        near(Math.cos(turn - (u[2] * scale) / r), 1, 1e-3)) && (await page.locator("[data-block] path").count()) === 1);
      const before = await at(1490), [{ x, turn, r }] = last.bodies;
      check("it rolls at the end", near(x - before.bodies[0].x, r * (((before.bodies[0].turn - turn) + 2 * Math.PI) % (2 * Math.PI)), 0.1)
        && x > before.bodies[0].x + 1);
    }
  } else {
    check("a pendulum a mass is drawn with its length", all.every(({ bodies }) => bodies.length === motion.lengths.length && bodies.every(({ arm }, i) =>
      near(arm / bodies[0].arm, motion.lengths[i] / motion.lengths[0], 1e-9) && arm > 50)));
    const sign = motion.leftward ? -1 : 1;
    check("each is turned by its arc over its length", all.every(({ bodies, u }) => bodies.every(({ turn }, i) => near(turn, (sign * u[i]) / motion.lengths[i], 1e-3))));
    if (name === "pendulum") {
      const [wall] = impact.straight;
      check("it touches the stop at its lowest point, and flashes there", near(wall.x + 2 + body.r, body.x, 1) && near(flash.x, body.x - body.r, 1)
        && near(flash.y, body.y, 1) && wall.y + wall.height > body.y, JSON.stringify([wall, body, flash]));
    } else {
      const [, other] = impact.bodies;  // between two rows of the motion, which cut the corner
      check("they touch at their lowest points, and flash between", near(other.x - body.x, 2 * body.r, 4) && near(other.y, body.y, 0.5)
        && near(flash.x, (body.x + other.x) / 2, 1) && near(flash.y, body.y, 1), JSON.stringify([body, other, flash]));
      check("mass 1 swings at the left", first.bodies[0].x < body.x - 50 && first.bodies[1].x > other.x + 50);
    }
  }
  check("its figure is explained", (await page.locator("figure:has([data-player]) .reading").innerText()).includes(
    motion.plane !== null ? "plane of u1 and u2" : "Masses hang at their lengths"));
  check("all bodies are on the stage", all.every(({ bodies }) => bodies.every(({ x, y, r }) => x - r >= 0 && x + r <= 1000 && y - r >= 28 && y + r <= 272)));
  check("their lines begin where they do", first.bodies.every(({ x, y }, i) => near(first.paths[i].x, x) && near(first.paths[i].y, y)));
  check("a run is drawn as outlines over its bodies, and can be hidden", await page.evaluate(() => {
    const svg = svgElement(document.body, "svg", {}), scene = data.motion, show = drawMotion(svg, scene, 1);
    const pairs = () => scene.blocks.map((_, i) => [svg.querySelector(`[data-block="${i + 1}"]`), svg.querySelector(`[data-outline="${i + 1}"]`)]).filter(([of]) => of);
    const isHidden = pairs().every(([, outline]) => outline.getAttribute("visibility") === "hidden");
    show(scene.t[700], [scene]);
    const isBeside = pairs().every(([of, outline]) => outline.getAttribute("visibility") === "visible" && outline.getAttribute("transform") === of.getAttribute("transform"));
    show(scene.t[700], []);
    const isGone = pairs().every(([, outline]) => outline.getAttribute("visibility") === "hidden");
    svg.remove();
    return isHidden && isBeside && isGone && pairs().length > 0;
  }));
  check("the page has no errors", page.said.length === 0, page.said.join("; "));
});
