// Matter.js: Verlet positions. Lengths are pixels, times milliseconds; a velocity is pixels in 1000/60 ms. Its circles
// are polygons, hence squares.
import Matter from 'matter-js';
import { run } from '../door.mjs';

const pixels = 1000;  // a metre
await run(({ bodies, walls, restitution, h, settings }) => {
  if (settings.tuned) Matter.Resolver._restingThresh = 0;
  const engine = Matter.Engine.create({ gravity: { x: 0, y: 0 } });
  const shape = { restitution, friction: 0, frictionStatic: 0, slop: settings.tuned ? 0 : 0.05, inertia: Infinity };
  if (settings.tuned) shape.frictionAir = 0;
  const add = ({ x, y }, more) => Matter.Bodies.rectangle(x * pixels, y * pixels, pixels, pixels, { ...shape, ...more });
  Matter.Composite.add(engine.world, walls.map((wall) => add(wall, { isStatic: true })));
  const unit = pixels / 60;  // of a velocity of 1 m/s
  const masses = bodies.map((body) => {
    const ball = add(body, {});
    Matter.Body.setMass(ball, body.mass);
    Matter.Body.setInertia(ball, Infinity);
    Matter.Body.setVelocity(ball, { x: body.v * unit, y: 0 });
    return ball;
  });
  Matter.Composite.add(engine.world, masses);
  return {
    position: (i) => masses[i].position.x / pixels,
    velocity: (i) => Matter.Body.getVelocity(masses[i]).x / unit,
    step(forces) {
      masses.forEach((ball, i) => { ball.force.x = forces[i] * pixels / 1e6; });
      Matter.Engine.update(engine, h * 1000);
    },
  };
});
