"use strict";
// The motion as an animation: the drawn system, contacts that flash at impacts, and a cursor in the response.

function startPlayer(stage) {
  const scene = data[stage.dataset.player], tools = stage.nextElementSibling;
  const what = stage.closest("figure").querySelector("h3").textContent;
  const masses = scene.blocks.length, end = scene.t.at(-1);
  const svg = svgElement(stage, "svg", {
    viewBox: `0 0 ${stageWidth} ${stageHeight}`, "aria-hidden": "true", xmlns: "http://www.w3.org/2000/svg",
    "font-family": "sans-serif", "font-size": textSize
  });
  // In a narrow frame letters are larger, up to what a block has room for.
  new ResizeObserver(() => svg.setAttribute("font-size",
    Math.min(28, Math.max(textSize, (11 * stageWidth) / (stage.clientWidth || stageWidth))))).observe(stage);
  const draw = drawMotion(svg, scene, 1);

  const frame = document.querySelector(`[data-plot="${CSS.escape(stage.dataset.response)}"]`);
  const cursor = document.createElement("div");
  cursor.className = "cursor";
  cursor.hidden = true;
  function moveCursor() {
    const view = embedded[stage.dataset.response];
    if (!view || !frame) return;
    if (cursor.parentElement !== frame) frame.append(cursor);
    const axis = view.scale("x"), [lo, hi] = axis.domain();
    cursor.hidden = now < lo || now > hi;
    const [left, top] = view.origin(), above = view.padding().top;
    Object.assign(cursor.style, { left: `${left + axis(now)}px`, top: `${top + above}px`, height: `${view.height()}px` });
  }

  let now = 0, playing = false, last = 0, speed = 1;
  let beside = null;  // a run
  function show() {
    draw(now, beside ? [beside] : []);
    const text = `${now.toFixed(3)} s`;
    slider.value = String(now);
    slider.setAttribute("aria-valuetext", text);
    moveCursor();
  }
  function seek(time) {
    now = Math.min(Math.max(time, 0), end);
    show();
  }
  function play(on) {
    playing = on;
    toggle.textContent = on ? "Pause" : "Play";
    toggle.setAttribute("aria-label", `${toggle.textContent}: ${what}`);
    if (!on) return;
    if (now >= end) now = 0;
    last = performance.now();
    requestAnimationFrame(tick);
  }
  function tick(time) {
    if (!playing) return;
    seek(now + (speed * Math.max(0, time - last)) / 1000);
    last = time;
    if (now >= end) play(false);
    else requestAnimationFrame(tick);
  }
  const allTimes = [...new Set(scene.impacts.map((impact) => impact.t))];
  const jump = (time) => { play(false); seek(time); };

  const toggle = button("Play", `Play: ${what}`, () => play(!playing));
  const slider = document.createElement("input");
  Object.assign(slider, { type: "range", min: "0", max: String(end), step: "any" });
  slider.setAttribute("aria-label", `Time: ${what}`);
  slider.addEventListener("input", () => jump(Number(slider.value)));
  const rate = document.createElement("select");
  rate.setAttribute("aria-label", `Speed: ${what}`);
  for (const [name, value] of [["1/16", 1 / 16], ["1/4", 1 / 4], ["1", 1], ["4", 4], ["16", 16]])
    rate.append(new Option(`${name} x`, String(value), value === 1, value === 1));
  rate.addEventListener("change", () => { speed = Number(rate.value); });
  const choice = document.createElement("select");
  choice.setAttribute("aria-label", `Beside the exact motion: ${what}`);
  choice.append(new Option("only the exact motion", "-1"));
  scene.runs.forEach((run, k) => choice.append(new Option(`compared with ${run.name}, ${run.step}`, String(k))));
  choice.addEventListener("change", () => { beside = scene.runs[Number(choice.value)] || null; show(); });
  const frameSvg = () => withLightColors(new XMLSerializer().serializeToString(svg)
    .replace(/font-size="[^"]*"/, `font-size="${textSize}"`).replace("<svg ", `<svg width="${stageWidth}" height="${stageHeight}" style="background:var(--paper)" `));
  const file = () => `clackers-${stage.dataset.player}-${now.toFixed(3)}s`;
  // Records the motion from its beginning to its end at the chosen speed; a second press ends it there.
  let filming = false;
  async function film(pressed) {
    if (filming) { filming = false; return; }
    filming = true;
    jump(0);
    pressed.textContent = "Stop";
    const canvas = document.createElement("canvas"), parts = [];
    Object.assign(canvas, { width: stageWidth, height: stageHeight });
    const recorder = new MediaRecorder(canvas.captureStream(30), { mimeType: "video/webm", videoBitsPerSecond: 4e6 });
    recorder.addEventListener("dataavailable", (event) => parts.push(event.data));
    const ended = new Promise((done) => recorder.addEventListener("stop", done));
    const frame = async () => canvas.getContext("2d").drawImage(await imageOf(frameSvg()), 0, 0);
    await frame();
    recorder.start();
    for (const begin = performance.now(); filming && now < end;) {
      seek((speed * (performance.now() - begin)) / 1000);
      await frame();
      await new Promise(requestAnimationFrame);
    }
    recorder.stop();
    await ended;
    filming = false;
    pressed.textContent = "Film";
    save(new Blob(parts, { type: "video/webm" }), "video/webm", `clackers-${stage.dataset.player}.webm`);
  }
  const filmButton = button("Film", `Record a film: ${what}`, () => film(filmButton));
  tools.append(
    toggle,
    button("◂ impact", `Impact before: ${what}`, () => jump(allTimes.findLast((t) => t < now - 1e-9 * end) ?? 0)),
    button("impact ▸", `Impact after: ${what}`, () => jump(allTimes.find((t) => t > now + 1e-9 * end) ?? end)),
    slider, rate, ...(scene.runs.length ? [choice] : []),
    button("SVG", `Save this moment as SVG: ${what}`, () => save(frameSvg(), "image/svg+xml", `${file()}.svg`)),
    button("PNG", `Save this moment as PNG: ${what}`, async () => save(await rasterized(frameSvg(), 2), "image/png", `${file()}.png`)),
    ...(window.MediaRecorder ? [filmButton] : []));
  stage.addEventListener("keydown", (event) => {
    const step = end / 500;
    const moves = { ArrowLeft: -step, ArrowRight: step, PageUp: -10 * step, PageDown: 10 * step };
    if (event.key === " ") play(!playing);
    else if (event.key === "Home") jump(0);
    else if (event.key === "End") jump(end);
    else if (event.key in moves) jump(now + moves[event.key]);
    else return;
    event.preventDefault();
  });
  if (masses > 0) show();
}

for (const stage of document.querySelectorAll("[data-player]")) startPlayer(stage);
