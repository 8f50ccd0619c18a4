// Jolt: symplectic Euler in single precision, speculative contacts.
import initJolt from 'jolt-physics';
import { run } from '../door.mjs';

await run(async ({ bodies, walls, restitution, h, settings }) => {
  const Jolt = await initJolt();
  const layers = new Jolt.ObjectLayerPairFilterTable(1);
  layers.EnableCollision(0, 0);
  const broad = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
  broad.MapObjectToBroadPhaseLayer(0, new Jolt.BroadPhaseLayer(0));
  const options = new Jolt.JoltSettings();
  options.mObjectLayerPairFilter = layers;
  options.mBroadPhaseLayerInterface = broad;
  options.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(broad, 1, layers, 1);
  const jolt = new Jolt.JoltInterface(options), system = jolt.GetPhysicsSystem();
  system.SetGravity(new Jolt.Vec3(0, 0, 0));
  if (settings.tuned) {
    const physics = system.GetPhysicsSettings();
    Object.assign(physics, { mMinVelocityForRestitution: 0, mPenetrationSlop: 0, mAllowSleeping: false });
    system.SetPhysicsSettings(physics);
  }
  const add = (motion, x, y, mass, v) => {
    const body = new Jolt.BodyCreationSettings(new Jolt.SphereShape(0.5), new Jolt.RVec3(x, y, 0), new Jolt.Quat(0, 0, 0, 1), motion, 0);
    Object.assign(body, { mRestitution: restitution, mFriction: 0, mLinearVelocity: new Jolt.Vec3(v, 0, 0) });
    if (settings.tuned) Object.assign(body, { mLinearDamping: 0, mAllowSleeping: false });
    if (mass) {
      body.mOverrideMassProperties = Jolt.EOverrideMassProperties_CalculateInertia;
      body.mMassPropertiesOverride.mMass = mass;
      body.mAllowedDOFs = Jolt.EAllowedDOFs_TranslationX;
    }
    const made = system.GetBodyInterface().CreateBody(body);
    system.GetBodyInterface().AddBody(made.GetID(), Jolt.EActivation_Activate);
    return made;
  };
  for (const { x, y } of walls) add(Jolt.EMotionType_Static, x, y, 0, 0);
  const masses = bodies.map(({ mass, x, y, v }) => add(Jolt.EMotionType_Dynamic, x, y, mass, v));
  return {
    position: (i) => masses[i].GetPosition().GetX(),
    velocity: (i) => masses[i].GetLinearVelocity().GetX(),
    step(forces) {
      masses.forEach((body, i) => system.GetBodyInterface().AddForce(body.GetID(), new Jolt.Vec3(forces[i], 0, 0), Jolt.EActivation_Activate));
      jolt.Step(h, 1);
    },
  };
});
