// cannon-es: symplectic Euler, contacts by the SPOOK stepper of stabilized constraints.
import { Body, ContactMaterial, Material, Sphere, Vec3, World } from 'cannon-es';
import { run } from '../door.mjs';

await run(({ bodies, walls, restitution, h, settings }) => {
  const world = new World({ gravity: new Vec3(0, 0, 0), allowSleep: false });
  const material = new Material();
  const contact = { restitution, friction: 0 };
  if (settings.tuned) Object.assign(contact, { contactEquationStiffness: 1e12, contactEquationRelaxation: 3 });
  world.addContactMaterial(new ContactMaterial(material, material, contact));
  world.solver.iterations = 50;
  const damping = settings.tuned ? { linearDamping: 0 } : {};
  const add = (mass, x, y, v) => {
    const body = new Body({ mass, material, shape: new Sphere(0.5), position: new Vec3(x, y, 0), velocity: new Vec3(v, 0, 0), fixedRotation: true, ...damping });
    world.addBody(body);
    return body;
  };
  for (const { x, y } of walls) add(0, x, y, 0);
  const masses = bodies.map(({ mass, x, y, v }) => add(mass, x, y, v));
  return {
    position: (i) => masses[i].position.x,
    velocity: (i) => masses[i].velocity.x,
    step(forces) {
      masses.forEach((body, i) => body.force.set(forces[i], 0, 0));
      world.step(h);
    },
  };
});
