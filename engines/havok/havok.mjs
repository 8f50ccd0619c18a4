// Havok as Babylon.js ships it: a closed library, in single precision.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import HavokPhysics from '@babylonjs/havok';
import { run } from '../door.mjs';

await run(async ({ bodies, walls, restitution, h, settings }) => {
  const require = createRequire(import.meta.url);
  const wasmBinary = readFileSync(require.resolve('@babylonjs/havok').replace(/[^/]*$/, 'HavokPhysics.wasm'));
  const hk = await HavokPhysics({ wasmBinary });
  const world = hk.HP_World_Create()[1];
  hk.HP_World_SetGravity(world, [0, 0, 0]);
  if (settings.tuned) hk.HP_World_SetIdealStepTime(world, h);
  const add = (kind, x, y, mass, v) => {
    const shape = hk.HP_Shape_CreateSphere([0, 0, 0], 0.5)[1];
    hk.HP_Shape_SetMaterial(shape, [0, 0, restitution, hk.MaterialCombine.MINIMUM, hk.MaterialCombine.MAXIMUM]);
    const body = hk.HP_Body_Create()[1];
    hk.HP_Body_SetShape(body, shape);
    hk.HP_Body_SetMotionType(body, kind);
    if (mass) hk.HP_Body_SetMassProperties(body, [[0, 0, 0], mass, [1e9, 1e9, 1e9], [0, 0, 0, 1]]);
    hk.HP_Body_SetLinearDamping(body, 0);
    if (settings.tuned) hk.HP_Body_SetActivationControl(body, hk.ActivationControl.ALWAYS_ACTIVE);
    hk.HP_Body_SetPosition(body, [x, y, 0]);
    hk.HP_World_AddBody(world, body, false);
    hk.HP_Body_SetLinearVelocity(body, [v, 0, 0]);
    return body;
  };
  for (const { x, y } of walls) add(hk.MotionType.STATIC, x, y, 0, 0);
  const masses = bodies.map(({ mass, x, y, v }) => add(hk.MotionType.DYNAMIC, x, y, mass, v));
  return {
    position: (i) => hk.HP_Body_GetPosition(masses[i])[1][0],
    velocity: (i) => hk.HP_Body_GetLinearVelocity(masses[i])[1][0],
    step(forces) {
      masses.forEach((body, i) => hk.HP_Body_ApplyImpulse(body, hk.HP_Body_GetPosition(body)[1], [forces[i] * h, 0, 0]));
      hk.HP_World_Step(world, h);
    },
  };
});
