"use strict";
// What the reader of any page can press: the tools below figures, themes, copying.

function button(text, label, action) {
  const element = document.createElement("button");
  element.type = "button";
  element.textContent = text;
  element.setAttribute("aria-label", label);
  element.title = label;
  element.addEventListener("click", action);
  return element;
}

function save(content, type, file) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
  link.download = file;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

// Tools of one figure. A figure whose axes are not numbers has no zoom.
function addTools(tools) {
  const name = tools.dataset.tools, rows = tools.dataset.rows, what = title(name);
  const gap = document.createElement("span");
  gap.className = "gap";
  const zooms = zoomSignal(name, "x") === null ? [] : [
    button("+", `Zoom in: ${what}`, () => zoom(name, 1.5)),
    button("−", `Zoom out: ${what}`, () => zoom(name, 1 / 1.5)),
    button("Reset", `Show all of: ${what}`, () => resetZoom(name))];
  tools.append(
    ...zooms,
    gap,
    button("SVG", `Save as SVG: ${what}`, async () => save(await asSvg(name), "image/svg+xml", `clackers-${name}.svg`)),
    button("PNG", `Save as PNG: ${what}`, async () => save(await asPng(name), "image/png", `clackers-${name}.png`)),
    button("CSV", `Save the data as CSV: ${what}`, () => save(asCsv(data[rows]), "text/csv", `clackers-${rows}.csv`)),
    button("Vega-Lite", `Save the Vega-Lite specification with its data: ${what}`,
      () => save(JSON.stringify(standalone(name)), "application/json", `clackers-${name}.vl.json`)));
}
document.querySelectorAll("[data-tools]").forEach(addTools);

// Theme: as the system has it, light, dark.
const themes = ["auto", "light", "dark"];
const themeButton = document.getElementById("theme");
function showTheme() {
  const theme = document.documentElement.dataset.theme || "auto";
  themeButton.textContent = `Theme: ${theme}`;
}
themeButton.addEventListener("click", () => {
  const root = document.documentElement;
  root.dataset.theme = themes[(themes.indexOf(root.dataset.theme || "auto") + 1) % themes.length];
  try { localStorage.setItem("clackers-theme", root.dataset.theme); } catch (e) { /* not allowed: forgotten on reload */ }
  showTheme();
});
showTheme();

// A button that copies the text of the element it names.
function addCopy(copy) {
  copy.addEventListener("click", async () => {
    const text = document.getElementById(copy.dataset.copy).textContent;
    try {
      await navigator.clipboard.writeText(text);
      copy.textContent = "Copied";
    } catch (e) {
      getSelection().selectAllChildren(document.getElementById(copy.dataset.copy));
      copy.textContent = "Selected";
    }
    setTimeout(() => { copy.textContent = "Copy"; }, 1500);
  });
}
document.querySelectorAll("[data-copy]").forEach(addCopy);
