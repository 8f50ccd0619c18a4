"use strict";
// The exact motion of the synchronized pair: two damped masses that collide at their common equilibrium, mass 2
// X times as fast as mass 1 (m1 = 1 kg, k1 = 1 N/m, u1(0) = 1 m). The closed form of the manual's page on equations.

// a b as a sum of two doubles, by Dekker's splitting.
function twoProduct(a, b) {
  const split = (x) => { const c = 134217729 * x, high = c - (c - x); return [high, x - high]; };
  const [ah, al] = split(a), [bh, bl] = split(b), high = a * b;
  return [high, al * bl - (high - ah * bh - al * bh - ah * bl)];
}

// Omega / pi as a sum of two doubles, Omega^2 = 1 - xi1^2, so that long motions keep their phase.
function halfPeriodsPerSecond(xi1) {
  const [square, rest] = twoProduct(xi1, xi1), high = 1 - square, low = 1 - high - square - rest;
  const omega = Math.sqrt(high), [p, q] = twoProduct(omega, omega);
  const omegaLow = (high - p - q + low) / (2 * omega);
  const ratio = omega / Math.PI, [a, b] = twoProduct(ratio, Math.PI);
  return [ratio, (omega - a - b + omegaLow - ratio * 1.2246467991473532e-16) / Math.PI];
}

// The largest mass ratio r* of Eq. (18) in its sharp form: from it on the masses touch away from their equilibrium.
function largestRatio(X) {
  if (X === 1) return Infinity;
  if (X === 3) return 3;
  let low = Math.PI, high = 1.5 * Math.PI;
  const slope = (x) => X * Math.sin(x / X) * Math.cos(x) - Math.sin(x) * Math.cos(x / X);
  while (high - low > 4e-16 * high) {
    const middle = (low + high) / 2;
    if (middle === low || middle === high) break;
    if (slope(middle) * slope(low) > 0) low = middle; else high = middle;
  }
  return Math.sqrt(1 + (X * X - 1) * Math.sin(low / X) ** 2);
}

/// The motion for odd X >= 1, 0 < r < r*(X), 0 <= xi1 < 1, 0 < eta <= 1: its system, its impacts, and its states.
function synchronizedPair({ X, r, xi1, eta }) {
  const [ratio, ratioLow] = halfPeriodsPerSecond(xi1), omega = ratio * Math.PI;
  const second = -((X - 1) % 4 === 0 ? 1 : -1) * r / X;
  const m = [1, 1 / r], amplitudes = [1, second], rates = [omega, X * omega];
  const k = [1, (X * X * (1 - xi1 * xi1) + xi1 * xi1) / r], c = m.map((mass) => 2 * mass * xi1);
  function at(t) {
    const [high, low] = twoProduct(ratio, t), rest = low + ratioLow * t;
    const count = Math.floor(high + 0.5), y = high - count + rest;
    const envelope = eta ** count * Math.exp(-xi1 * t);
    const u = [], v = [];
    [1, X].forEach((factor, i) => {
      const [turns, part] = twoProduct(factor, y), whole = Math.round(turns), angle = Math.PI * (turns - whole + part);
      const size = (whole % 2 === 0 ? 1 : -1) * amplitudes[i] * envelope;
      u.push(size * Math.cos(angle));
      v.push(-size * (xi1 * Math.cos(angle) + rates[i] * Math.sin(angle)));
    });
    return { u, v };
  }
  const impactTime = (number) => (number - 0.5) / ratio;
  const energy = ({ u, v }) => m.map((mass, i) => (mass * v[i] ** 2 + k[i] * u[i] ** 2) / 2);
  return { m, c, k, eta, start: at(0), at, energy, impactTime, largest: Math.max(1, Math.abs(second)), fastPeriod: 2 * Math.PI / rates[1] };
}
