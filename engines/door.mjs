// What the JavaScript programs share: reads the problem, lays its masses out as balls of radius 0.5 m on
// lines along x, applies springs, dampers and loads as forces before each step, writes the history.
//     node PROGRAM.mjs PROBLEM.json RUNS [NAME=VALUE ...]
import { readFileSync, writeFileSync } from 'node:fs';

const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);

// Gaps between balls are those of the contacts: a mass pushes another one or a wall, at most one ball wide.
function layout(problem) {
  const place = problem.M.map(() => undefined), line = problem.M.map(() => undefined), walls = [];
  let lines = 0;
  const follow = (i) => {
    for (const { direction, gap } of problem.contacts) {
      const right = direction.indexOf(1), left = direction.indexOf(-1);
      for (const [from, to, way] of [[right, left, -1], [left, right, 1]]) {
        if (from !== i || to < 0 || place[to] !== undefined) continue;
        [place[to], line[to]] = [place[i] + way * (1 - gap), line[i]];
        follow(to);
      }
    }
  };
  problem.M.forEach((_, i) => {
    if (place[i] !== undefined) return;
    [place[i], line[i]] = [0, 10 * lines++];
    follow(i);
  });
  for (const { direction, gap } of problem.contacts) {
    const masses = direction.flatMap((x, i) => (x ? [i] : []));
    if (masses.some((i) => Math.abs(direction[i]) !== 1) || masses.length > 2)
      throw new Error('this program takes contacts between two masses or a mass and a wall');
    if (masses.length === 1) walls.push({ x: place[masses[0]] + direction[masses[0]] * (gap - 1), y: line[masses[0]] });
  }
  return { place, line, walls };
}

/// Runs the world that `make({ bodies, walls, restitution, h, settings, problem })` returns: position(i) and
/// velocity(i) [m, m/s] along x, step(forces) [N] for one step h. RUNS has a line for each run: h, steps, history.
export async function run(make) {
  const [file, runs, ...given] = process.argv.slice(2);
  const { problem } = JSON.parse(readFileSync(file, 'utf8'));
  const settings = Object.fromEntries(given.map((word) => word.split('=')));
  const { M, C, K, contacts, start, end, loads = [] } = problem;
  const { place, line, walls } = layout(problem);
  const bodies = M.map((row, i) => ({ mass: row[i], x: place[i] + start.u[i], y: line[i], v: start.v[i] }));
  const move = async (n, out) => {
    const h = (end - start.t) / n;
    const world = await make({ bodies, walls, restitution: contacts[0].restitution, h, settings, problem });
    const rows = [['t', ...M.map((_, i) => `u${i + 1}`), ...M.map((_, i) => `v${i + 1}`)].join(',')];
    const before = process.cpuUsage();
    for (let k = 0; ; k++) {
      const t = k === n ? end : start.t + k * h;
      const u = M.map((_, i) => world.position(i) - place[i]), v = M.map((_, i) => world.velocity(i));
      rows.push([t, ...u, ...v].join(','));
      if (k === n) break;
      const load = (i) => loads.reduce((sum, { amplitude, omega, phase = 0 }) => sum + amplitude[i] * Math.cos(omega * t + phase), 0);
      world.step(settings.springs === 'own' ? M.map(() => 0) : M.map((_, i) => load(i) - dot(K[i], u) - dot(C[i], v)));
    }
    rows.push(`# seconds ${process.cpuUsage(before).user / 1e6} steps ${n}`);
    writeFileSync(out, rows.join('\n') + '\n');
  };
  for (const line of readFileSync(runs, 'utf8').trim().split('\n')) {
    const [, n, ...out] = line.split(' ');
    await move(Number(n), out.join(' '));
  }
  process.exit(0);
}
