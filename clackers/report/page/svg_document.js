"use strict";
// As much of a document as a drawing needs where there is no browser.
class Element {
  constructor(tag) { Object.assign(this, { tag, attributes: {}, children: [], textContent: "" }); }
  setAttribute(key, value) { this.attributes[key] = value; }
  append(child) { this.children.push(child); }
  toString() {
    const attributes = Object.entries(this.attributes).map(([key, value]) => ` ${key}="${value}"`).join("");
    return `<${this.tag}${attributes}>${this.textContent}${this.children.join("")}</${this.tag}>`;
  }
}
const document = { createElementNS: (_, tag) => new Element(tag) };

// The drawing of the colours of a light page, from its style sheet.
function lightColors(style) {
  const colors = Object.fromEntries([...style.matchAll(/(--[\w-]+): light-dark\((#\w+),/g)].map((found) => found.slice(1)));
  return (text) => text.replace(/var\((--[\w-]+)\)/g, (all, variable) => colors[variable]);
}
