// PhysX: symplectic Euler in single precision; solver=pgs or solver=tgs.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { run } from '../door.mjs';

await run(async ({ bodies, walls, restitution, h, settings }) => {
  // The package refuses Node.js unless this process looks like a browser's.
  const file = createRequire(import.meta.url).resolve('physx-js-webidl');
  const wasmBinary = readFileSync(file.replace(/mjs$/, 'wasm')), node = process;
  Object.assign(globalThis, { window: globalThis, process: undefined });
  const { default: PhysX } = await import('physx-js-webidl');
  const px = await PhysX({ wasmBinary });
  globalThis.process = node;
  const top = px.PxTopLevelFunctions.prototype;
  const foundation = top.CreateFoundation(px.PHYSICS_VERSION, new px.PxDefaultAllocator(), new px.PxDefaultErrorCallback());
  const scale = new px.PxTolerancesScale(), physics = top.CreatePhysics(px.PHYSICS_VERSION, foundation, scale);
  const description = new px.PxSceneDesc(scale);
  description.gravity = new px.PxVec3(0, 0, 0);
  description.cpuDispatcher = top.DefaultCpuDispatcherCreate(0);
  description.filterShader = top.DefaultFilterShader();
  description.solverType = settings.solver === 'tgs' ? px.PxSolverTypeEnum.eTGS : px.PxSolverTypeEnum.ePGS;
  if (settings.tuned) description.bounceThresholdVelocity = 1e-6;
  const scene = physics.createScene(description), material = physics.createMaterial(0, 0, restitution);
  const flags = new px.PxShapeFlags(px.PxShapeFlagEnum.eSIMULATION_SHAPE), filter = new px.PxFilterData(1, 1, 0, 0);
  const add = (make, x, y) => {
    const body = physics[make](new px.PxTransform(new px.PxVec3(x, y, 0), new px.PxQuat(px.PxIDENTITYEnum.PxIdentity)));
    const shape = physics.createShape(new px.PxSphereGeometry(0.5), material, true, flags);
    shape.setSimulationFilterData(filter);
    body.attachShape(shape);
    scene.addActor(body);
    return body;
  };
  for (const { x, y } of walls) add('createRigidStatic', x, y);
  const masses = bodies.map(({ mass, x, y, v }) => {
    const body = add('createRigidDynamic', x, y);
    body.setMass(mass);
    body.setMassSpaceInertiaTensor(new px.PxVec3(0, 0, 0));
    if (settings.tuned) body.setSleepThreshold(0);
    body.setLinearDamping(0);
    body.setLinearVelocity(new px.PxVec3(v, 0, 0));
    return body;
  });
  return {
    position: (i) => masses[i].getGlobalPose().p.x,
    velocity: (i) => masses[i].getLinearVelocity().x,
    step(forces) {
      masses.forEach((body, i) => body.addForce(new px.PxVec3(forces[i], 0, 0)));
      scene.simulate(h);
      scene.fetchResults(true);
    },
  };
});
