"use strict";
// Time integration of the pair in equal steps, with five treatments of its impacts. Nothing here knows the exact motion.

const gapOf = (u) => u[0] - u[1];

// Newton's impact law: momentum stays, the relative velocity is reversed and multiplied by eta.
function afterImpact(pair, { u, v }) {
  const mass = pair.m[0] + pair.m[1], change = (1 + pair.eta) * gapOf(v);
  return { u, v: [v[0] - change * pair.m[1] / mass, v[1] + change * pair.m[0] / mass] };
}
const closes = ({ u, v }) => gapOf(u) < 0 && gapOf(v) < 0;

function rk4(pair, { u, v }, h) {
  const force = (x, w) => x.map((_, i) => -(pair.k[i] * x[i] + pair.c[i] * w[i]) / pair.m[i]);
  const ahead = (x, rate, s) => x.map((value, i) => value + s * rate[i]);
  const a1 = force(u, v), v2 = ahead(v, a1, h / 2), a2 = force(ahead(u, v, h / 2), v2);
  const v3 = ahead(v, a2, h / 2), a3 = force(ahead(u, v2, h / 2), v3), v4 = ahead(v, a3, h), a4 = force(ahead(u, v3, h), v4);
  return {
    u: u.map((x, i) => x + h / 6 * (v[i] + 2 * v2[i] + 2 * v3[i] + v4[i])),
    v: v.map((x, i) => x + h / 6 * (a1[i] + 2 * a2[i] + 2 * a3[i] + a4[i]))
  };
}

// Newmark's average acceleration; `spring` joins the masses [N/m].
function newmark(pair, { u, v }, h, spring = 0) {
  const pull = spring * gapOf(u), side = [1, -1];
  const rhs = u.map((x, i) => {
    const a = -(pair.k[i] * x + pair.c[i] * v[i] + side[i] * pull) / pair.m[i];
    return pair.m[i] * (4 / h * v[i] + a) + pair.c[i] * v[i] - pair.k[i] * x - side[i] * pull;
  });
  const [p, q] = u.map((_, i) => 4 * pair.m[i] / (h * h) + 2 * pair.c[i] / h + pair.k[i] + spring);
  const det = p * q - spring * spring;
  const step = [(q * rhs[0] + spring * rhs[1]) / det, (spring * rhs[0] + p * rhs[1]) / det];
  return { u: u.map((x, i) => x + step[i]), v: v.map((x, i) => 2 / h * step[i] - x) };
}

// The step in which an impact falls is cut where the gap closes, by bisection.
function located(pair, state, h) {
  const end = rk4(pair, state, h);
  if (!closes(end)) return end;
  let low = 0, high = h;
  for (let i = 0; i < 60 && high - low > 1e-16 * h; ++i) {
    const middle = (low + high) / 2;
    if (gapOf(rk4(pair, state, middle).u) > 0) low = middle; else high = middle;
  }
  return rk4(pair, afterImpact(pair, rk4(pair, state, high)), h - high);
}
const atStepEnd = (step) => (pair, state, h) => {
  const end = step(pair, state, h);
  return closes(end) ? afterImpact(pair, end) : end;
};

// A spring that takes pressure only, 400 times as stiff as that of mass 2; the contact is open or closed in a step.
function penalty(pair, state, h) {
  const spring = 400 * pair.k[1];
  const [first, other] = gapOf(state.u) < 0 ? [spring, 0] : [0, spring];
  const end = newmark(pair, state, h, first);
  return gapOf(end.u) < 0 === first > 0 ? end : newmark(pair, state, h, gapOf(end.u) < 0 ? other : first);
}

// Moreau-Jean with theta = 1/2: an impulse of the whole step.
function moreauJean(pair, { u, v }, h) {
  const mass = pair.m.map((m, i) => m + h * pair.c[i] / 2 + h * h * pair.k[i] / 4);
  const next = v.map((x, i) => x - h * (pair.c[i] * x + pair.k[i] * (u[i] + h * x / 2)) / mass[i]);
  if (gapOf(u) + h * gapOf(v) / 2 <= 0) {
    const impulse = Math.max(0, -pair.eta * gapOf(v) - gapOf(next)) / (1 / mass[0] + 1 / mass[1]);
    next[0] += impulse / mass[0];
    next[1] -= impulse / mass[1];
  }
  return { u: u.map((x, i) => x + h * (v[i] + next[i]) / 2), v: next };
}

const treatments = [
  { name: "RK4, impacts located", step: located },
  { name: "RK4, impacts at the step's end", step: atStepEnd(rk4) },
  { name: "Newmark, impacts at the step's end", step: atStepEnd(newmark) },
  { name: "Newmark, penalty spring", step: penalty },
  { name: "Moreau-Jean", step: moreauJean }
];

/// States of a run at 0, h, ..., end; `visit(t, state)` sees each.
function integrate(pair, treatment, end, h, visit) {
  const steps = Math.max(1, Math.round(end / h));
  let state = pair.start;
  visit(0, state);
  for (let n = 1; n <= steps; ++n) {
    state = treatment.step(pair, state, end / steps);
    visit(n * end / steps, state);
  }
}
