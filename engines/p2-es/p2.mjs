// p2-es: two-dimensional, SPOOK stepper; positions and velocities are kept in single precision.
import { Body, Circle, ContactMaterial, Material, World } from 'p2-es';
import { run } from '../door.mjs';

await run(({ bodies, walls, restitution, h, settings }) => {
  const world = new World({ gravity: [0, 0] });
  if (settings.tuned) world.islandSplit = false;
  const material = new Material();
  const contact = { restitution, friction: 0 };
  if (settings.tuned) Object.assign(contact, { stiffness: 1e12, relaxation: 3 });
  world.addContactMaterial(new ContactMaterial(material, material, contact));
  const add = (mass, x, y, v) => {
    const body = new Body({ mass, position: [x, y], velocity: [v, 0], fixedRotation: true });
    if (settings.tuned) body.damping = 0;
    body.addShape(new Circle({ radius: 0.5, material }));
    world.addBody(body);
    return body;
  };
  for (const { x, y } of walls) add(0, x, y, 0);
  const masses = bodies.map(({ mass, x, y, v }) => add(mass, x, y, v));
  return {
    position: (i) => masses[i].position[0],
    velocity: (i) => masses[i].velocity[0],
    step(forces) {
      masses.forEach((body, i) => { body.force[0] = forces[i]; });
      world.step(h);
    },
  };
});
