"use strict";
// The numbers of an atlas and what is chosen of them: cells, filters, order of rows.

const atlas = data.atlas;
const place = Object.fromEntries(atlas.fields.map((field, i) => [field, i]));
const wordFields = new Set(["behaviour", "verdict", "reason", "diagnosis", "refusal_code", "refusal"]);

// A value of a cell by the name of its field.
function value(cell, field) {
  const found = cell[place[field]];
  if (wordFields.has(field)) return atlas.words[found];
  return field === "claim" ? atlas.claims[found] : found;
}

const byPlace = atlas.methods.map(() => []);  // method -> system -> cell
for (const cell of atlas.cells) byPlace[cell[0]][cell[1]] = cell;

const behaviours = ["exact", "proper", "reduced", "irregular", "stagnating", "divergent", "undecided", "refused"];
const verdicts = ["agrees", "not claimed", "undecided", "disagrees", "interrupted", "refused"];
// Files of others may hold any word.
const among = (list, word) => (list.includes(word) ? word : "undecided");
const verdictOf = (cell) => among(verdicts, value(cell, "verdict"));
// A refused method has no behaviour.
const behaviourOf = (cell) => (verdictOf(cell) === "refused" ? "refused" : among(behaviours, value(cell, "behaviour")));
const slug = (word) => word.replaceAll(" ", "-");

const treatmentName = (treatment) => treatment || "standalone methods";
const methodName = (method) => {
  const { name, part } = atlas.methods[method];
  return atlas.parts[part].origin ? `${name} (${atlas.parts[part].origin})` : name;
};
// Without the treatment that heads its group.
function shortName(method) {
  const { name, treatment } = atlas.methods[method], end = `+${treatment}`;
  return treatment && name.endsWith(end) ? name.slice(0, -end.length) : name;
}

// Parameters of a case of which two systems have different values.
function varying(name) {
  const systems = atlas.systems.filter((system) => system.case === name);
  const keys = [...new Set(systems.flatMap((system) => Object.keys(system.set)))];
  return keys.filter((key) => new Set(systems.map((system) => system.set[key])).size > 1);
}
const cases = [...new Set(atlas.systems.map((system) => system.case))];
const varyingOf = Object.fromEntries(cases.map((name) => [name, varying(name)]));
const settingText = (system, keys, texts = {}) => keys.map((key) => `${key}=${(texts[key] || String)(system.set[key])}`).join(" ");
// Numbers with at most four digits, unless two of the values would look the same.
function shortTexts(values) {
  const short = (value) => String(typeof value === "number" ? Number(value.toPrecision(4)) : value);
  return new Set(values.map(short)).size === new Set(values).size ? short : String;
}
// For a case: its varying parameters, each with the text of its values.
const shortOf = Object.fromEntries(cases.map((name) => [name, Object.fromEntries(varyingOf[name].map((key) =>
  [key, shortTexts(atlas.systems.filter((system) => system.case === name).map((system) => system.set[key]))]))]));
const systemName = (place) => {
  const system = atlas.systems[place], rest = settingText(system, Object.keys(system.set));
  return rest ? `${system.case} ${rest}` : system.case;
};

function commandOf(cell) {
  const method = atlas.methods[cell[0]], part = atlas.parts[method.part];
  return ["clackers verify", method.call, atlas.systems[cell[1]].command, part.options].filter(Boolean).join(" ");
}

const control = (id) => document.getElementById(id);

// ---- Text for people.

const minus = (text) => String(text).replace("-", "−");
function scientific(number, digits = 1) {
  if (number === null || number === undefined) return "–";
  if (number === 0) return "0";
  const [head, exponent] = number.toExponential(digits).split("e");
  return `${minus(head)} × 10${[...String(Number(exponent))].map((digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[digit] || "⁻").join("")}`;
}
const whole = (number) => (number === null ? "–" : number.toLocaleString("en").replaceAll(",", " "));
function orderText(cell) {
  const order = value(cell, "order"), spread = value(cell, "order_spread");
  if (order === null) return "–";
  return minus(order.toFixed(2)) + (spread === null ? "" : ` ±${Math.max(spread, 0.01).toFixed(2)}`);
}
const escaped = (text) => String(text).replace(/[&<>"']/g, (sign) => `&#${sign.charCodeAt(0)};`);

// Where a name of a method may break.
const breakable = (text) => escaped(text).replace(/[+:,]/g, "$&<wbr>");

// ---- Scales of order and error: a band has a colour and a name.

const scales = {
  order: [[0.5, "below 0.5"], [1.5, "about 1"], [2.5, "about 2"], [3.5, "about 3"], [Infinity, "above 3.5"]],
  u_error: [[1e-8, "below 10⁻⁸"], [1e-6, "to 10⁻⁶"], [1e-4, "to 10⁻⁴"], [1e-2, "to 10⁻²"], [Infinity, "above 10⁻²"]]
};
function band(field, number) {
  if (number === null || number === undefined) return "none";
  const at = scales[field].findIndex(([end]) => number < end);
  return String(field === "order" ? at + 1 : scales.u_error.length - at);  // 5 is best
}
const bandLabel = (field, number) => {
  if (number === null || number === undefined) return "";
  return field === "order" ? minus(number.toFixed(1)) : number > 0 ? minus(Math.floor(Math.log10(number))) : "0";
};

// ---- What is chosen.

const choice = { find: "", treatment: "*", case: "*", sort: "listed", show: "behaviour", grouped: true,
  behaviours: new Set(), verdicts: new Set(), closed: new Set(), system: null };

const isPicked = (cell) =>
  (choice.behaviours.size === 0 || choice.behaviours.has(behaviourOf(cell))) &&
  (choice.verdicts.size === 0 || choice.verdicts.has(verdictOf(cell)));
const isNarrowed = () => choice.behaviours.size + choice.verdicts.size > 0;

// Systems of a case stand together, by the values of their parameters.
function byValues(a, b) {
  const [first, second] = [atlas.systems[a], atlas.systems[b]];
  if (first.case !== second.case) return cases.indexOf(first.case) - cases.indexOf(second.case);
  for (const key of varyingOf[first.case]) {
    const [x, y] = [first.set[key], second.set[key]];
    if (x !== y) return typeof x === "number" && typeof y === "number" ? x - y : String(x).localeCompare(String(y));
  }
  return 0;
}
const columns = atlas.systems.map((_, i) => i).sort(byValues);
const shownSystems = () => columns
  .filter((i) => choice.case === "*" || atlas.systems[i].case === choice.case);

// The smallest number comes first; what is not known comes last.
function rank(method, systems) {
  const cells = systems.map((system) => byPlace[method][system]).filter(Boolean);
  const middle = (field) => {
    const numbers = cells.map((cell) => value(cell, field)).filter((number) => number !== null).sort((a, b) => a - b);
    return numbers.length ? numbers[Math.floor(numbers.length / 2)] : null;
  };
  const count = (word) => cells.filter((cell) => verdictOf(cell) === word).length;
  if (choice.sort === "system") return byPlace[method][choice.system] ? value(byPlace[method][choice.system], "u_error") : null;
  if (choice.sort === "agrees" || choice.sort === "disagrees") return -count(choice.sort);
  if (choice.sort === "u_error") return middle("u_error");
  const order = middle("order");
  return order === null ? null : -order;
}

function sorted(methods, systems) {
  if (choice.sort === "listed") return methods;
  if (choice.sort === "name") return [...methods].sort((a, b) => methodName(a).localeCompare(methodName(b)));
  const ranks = new Map(methods.map((method) => [method, rank(method, systems) ?? Infinity]));
  return [...methods].sort((a, b) => (ranks.get(a) === ranks.get(b) ? 0 : ranks.get(a) - ranks.get(b)));
}

// The methods that pass the filters, in their order.
function shownMethods(systems = shownSystems()) {
  const words = choice.find.toLowerCase().split(/\s+/).filter(Boolean);
  const methods = atlas.methods.map((_, i) => i).filter((method) => {
    if (choice.treatment !== "*" && atlas.methods[method].treatment !== choice.treatment) return false;
    const name = `${methodName(method)} ${treatmentName(atlas.methods[method].treatment)}`.toLowerCase();
    if (!words.every((word) => name.includes(word))) return false;
    const cells = systems.map((system) => byPlace[method][system]).filter(Boolean);
    return cells.length > 0 && (!isNarrowed() || cells.some(isPicked));
  });
  return sorted(methods, systems);
}

// [[treatment, methods], ...] in the order in which the treatments are listed.
function groups(methods) {
  if (!choice.grouped) return [[null, methods]];
  const treatments = [...new Set(atlas.methods.map((method) => method.treatment))];
  return treatments.map((treatment) => [treatment, methods.filter((method) => atlas.methods[method].treatment === treatment)])
    .filter(([, some]) => some.length > 0);
}
