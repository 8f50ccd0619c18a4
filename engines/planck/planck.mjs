// Planck: Box2D in JavaScript, in doubles.
import planck from 'planck';
import { run } from '../door.mjs';

await run(({ bodies, walls, restitution, h, settings }) => {
  if (settings.tuned) planck.Settings.velocityThreshold = 0;
  const world = new planck.World({ gravity: planck.Vec2(0, 0), allowSleep: !settings.tuned });
  const ball = { shape: planck.Circle(0.5), restitution, friction: 0 };
  for (const { x, y } of walls) world.createBody({ position: planck.Vec2(x, y) }).createFixture(ball);
  const masses = bodies.map(({ mass, x, y, v }) => {
    const body = world.createDynamicBody({ position: planck.Vec2(x, y), linearVelocity: planck.Vec2(v, 0), fixedRotation: true });
    body.createFixture({ ...ball, density: mass / (Math.PI * 0.25) });
    return body;
  });
  return {
    position: (i) => masses[i].getPosition().x,
    velocity: (i) => masses[i].getLinearVelocity().x,
    step(forces) {
      masses.forEach((body, i) => body.applyForceToCenter(planck.Vec2(forces[i], 0), true));
      world.step(h);
    },
  };
});
