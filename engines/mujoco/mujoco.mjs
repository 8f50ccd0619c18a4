// MuJoCo: symplectic Euler with implicit damping, contacts as soft constraints; it has no restitution.
// springs=own: those of the joints. contact=SECONDS: solref of a contact that lasts so long and returns eta.
import loadMujoco from 'mujoco-js';
import { run } from '../door.mjs';

await run(async ({ bodies, walls, restitution, h, settings, problem: { K, C, start } }) => {
  const own = settings.springs === 'own';
  if (own && K.some((row, i) => row.some((k, j) => k && i !== j)))
    throw new Error('this setting takes springs between a mass and the ground only');
  const loss = (-2 * Math.log(Math.max(restitution, 1e-3))) / Number(settings.contact);
  const stiffness = (Math.PI / Number(settings.contact)) ** 2 + loss ** 2 / 4;
  const geom = `<geom type="sphere" size="0.5" condim="1" ${settings.contact ? `solref="${-stiffness} ${-loss}"` : ''}`;
  const joint = (i) => `<joint type="slide" axis="1 0 0" ${own ? `stiffness="${K[i][i]}" damping="${C[i][i]}"` : ''}/>`;
  const xml = `<mujoco><option timestep="${h}" gravity="0 0 0"/><worldbody>
    ${walls.map(({ x, y }) => `<body pos="${x} ${y} 0">${geom}/></body>`).join('\n')}
    ${bodies.map(({ mass, x, y }, i) => `<body pos="${x - start.u[i]} ${y} 0">${joint(i)}${geom} mass="${mass}"/></body>`).join('\n')}
  </worldbody></mujoco>`;
  const mujoco = await loadMujoco();
  mujoco.FS.writeFile('/pair.xml', xml);
  const model = mujoco.MjModel.loadFromXML('/pair.xml'), data = new mujoco.MjData(model);
  bodies.forEach(({ v }, i) => { [data.qpos[i], data.qvel[i]] = [start.u[i], v]; });
  return {
    position: (i) => bodies[i].x - start.u[i] + data.qpos[i],
    velocity: (i) => data.qvel[i],
    step(forces) {
      forces.forEach((force, i) => { data.qfrc_applied[i] = force; });
      mujoco.mj_step(model, data);
    },
  };
});
