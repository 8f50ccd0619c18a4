// ammo.js: Bullet compiled for JavaScript, in single precision.
import Ammo from 'ammojs3';
import { run } from '../door.mjs';

await run(async ({ bodies, walls, restitution, h, settings }) => {
  const ammo = await Ammo();
  const configuration = new ammo.btDefaultCollisionConfiguration();
  const world = new ammo.btDiscreteDynamicsWorld(new ammo.btCollisionDispatcher(configuration), new ammo.btDbvtBroadphase(),
    new ammo.btSequentialImpulseConstraintSolver(), configuration);
  world.setGravity(new ammo.btVector3(0, 0, 0));
  if (settings.tuned) {
    world.getSolverInfo().set_m_erp(0);
    world.getSolverInfo().set_m_erp2(0);
  }
  const add = (mass, x, y, v, e) => {
    const place = new ammo.btTransform();
    place.setIdentity();
    place.setOrigin(new ammo.btVector3(x, y, 0));
    const body = new ammo.btRigidBody(new ammo.btRigidBodyConstructionInfo(mass, new ammo.btDefaultMotionState(place),
      new ammo.btSphereShape(0.5), new ammo.btVector3(0, 0, 0)));
    body.setRestitution(e);
    body.setFriction(0);
    body.setAngularFactor(new ammo.btVector3(0, 0, 0));
    body.setLinearVelocity(new ammo.btVector3(v, 0, 0));
    if (settings.tuned) body.setActivationState(4);
    world.addRigidBody(body);
    return body;
  };
  // The coefficients of both bodies are multiplied.
  const share = settings.tuned ? Math.sqrt(restitution) : restitution;
  for (const { x, y } of walls) add(0, x, y, 0, share);
  const masses = bodies.map(({ mass, x, y, v }) => add(mass, x, y, v, share));
  return {
    position: (i) => masses[i].getWorldTransform().getOrigin().x(),
    velocity: (i) => masses[i].getLinearVelocity().x(),
    step(forces) {
      masses.forEach((body, i) => body.applyCentralImpulse(new ammo.btVector3(forces[i] * h, 0, 0)));
      world.stepSimulation(h, 0);
    },
  };
});
