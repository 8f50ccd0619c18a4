// Rapier in 3 dimensions: single precision, substeps that share one external force.
import RAPIER from '@dimforge/rapier3d-compat';
import { run } from '../door.mjs';

await run(async ({ bodies, walls, restitution, h, settings }) => {
  await RAPIER.init();
  const world = new RAPIER.World({ x: 0, y: 0, z: 0 });
  world.timestep = h;
  if (settings.iterations) world.numSolverIterations = Number(settings.iterations);
  const ball = () => RAPIER.ColliderDesc.ball(0.5).setRestitution(restitution).setFriction(0);
  for (const { x, y } of walls)
    world.createCollider(ball(), world.createRigidBody(RAPIER.RigidBodyDesc.fixed().setTranslation(x, y, 0)));
  const masses = bodies.map(({ mass, x, y, v }) => {
    const description = RAPIER.RigidBodyDesc.dynamic().setTranslation(x, y, 0).setLinvel(v, 0, 0).lockRotations().setCanSleep(!settings.tuned);
    const body = world.createRigidBody(description);
    world.createCollider(ball().setMass(mass), body);
    return body;
  });
  return {
    position: (i) => masses[i].translation().x,
    velocity: (i) => masses[i].linvel().x,
    step(forces) {
      masses.forEach((body, i) => {
        body.resetForces(false);
        body.addForce({ x: forces[i], y: 0, z: 0 }, true);
      });
      world.step();
    },
  };
});
