"use strict";
// What the reader of a record can press: legends, and what a figure shows.

// Legends: a pressed button is shown. One legend may steer several figures.
for (const legend of document.querySelectorAll("[data-legend]")) {
  const names = legend.dataset.legend.split(" ");
  const toggles = [...legend.querySelectorAll("button[data-series]")];
  const apply = () => {
    const hidden = toggles.filter((toggle) => toggle.getAttribute("aria-pressed") === "false")
      .map((toggle) => toggle.dataset.series);
    for (const name of names)
      if (embedded[name]) embedded[name].signal("hidden", hidden).runAsync();
  };
  for (const toggle of toggles)
    toggle.addEventListener("click", () => {
      const shown = toggle.getAttribute("aria-pressed") !== "true";
      toggle.setAttribute("aria-pressed", String(shown));
      apply();
      point(shown && toggle.closest(".all") ? toggle.dataset.series : null);
    });
  const every = legend.querySelector(".every");
  if (every)
    every.addEventListener("click", () => {
      const pressed = toggles.every((toggle) => toggle.getAttribute("aria-pressed") === "true") ? "false" : "true";
      for (const toggle of toggles) toggle.setAttribute("aria-pressed", pressed);
      apply();
    });
}

// A method that is pointed at, in a figure or in the legend, stands out in all figures.
let pointed = null;
function point(method) {
  const hidden = document.querySelector(`[data-series="${CSS.escape(method || "")}"][aria-pressed="false"]`);
  const next = hidden ? null : method;
  if (next === pointed) return;
  pointed = next;
  for (const name of Object.keys(embedded))
    if (specifications[name].params.some((parameter) => parameter.name === "hovered"))
      embedded[name].signal("hovered", pointed).runAsync();
  for (const toggle of document.querySelectorAll("[data-legend] button[data-series]"))
    toggle.classList.toggle("pointed", toggle.dataset.series === pointed);
}
function followPointer(name) {
  embedded[name].addEventListener("mouseover", (event, item) => point((item && item.datum && item.datum.method) || null));
  embedded[name].addEventListener("mouseout", () => point(null));
}
for (const toggle of document.querySelectorAll(".legend.all button[data-series]")) {
  for (const event of ["mouseenter", "focus"]) toggle.addEventListener(event, () => point(toggle.dataset.series));
  for (const event of ["mouseleave", "blur"]) toggle.addEventListener(event, () => point(null));
}

// Which mass a figure shows.
for (const choice of document.querySelectorAll("[data-mass]"))
  choice.addEventListener("click", () => {
    for (const other of choice.parentElement.querySelectorAll("[data-mass]"))
      other.setAttribute("aria-pressed", String(other === choice));
    embedded[choice.dataset.of].signal("mass", Number(choice.dataset.mass)).runAsync();
  });

// What a figure counts. Another counter is another axis, so that the old stretch of it means nothing.
for (const choice of document.querySelectorAll("[data-counter]"))
  choice.addEventListener("click", () => {
    for (const other of choice.parentElement.querySelectorAll("[data-counter]"))
      other.setAttribute("aria-pressed", String(other === choice));
    embedded[choice.dataset.of].signal("counter", choice.dataset.counter);
    resetZoom(choice.dataset.of);
  });

document.documentElement.dataset.figures = "drawing";
Promise.all(Object.keys(specifications).map(draw)).then(
  () => {
    Object.keys(embedded).forEach(followPointer);
    document.documentElement.dataset.figures = "drawn";
  },
  (error) => {
    document.documentElement.dataset.figures = "failed";
    console.error(error);
  });
