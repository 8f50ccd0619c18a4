// Open Dynamics Engine: symplectic Euler in doubles; contact joints are made by the caller. springs=own:
// springs and dampers of slider joints as ERP and CFM of a stop at the rest position.
#include <ode/ode.h>

#include "../door.hpp"

struct World {
  dWorldID world;
  dSpaceID space;
  dJointGroupID contacts;
  std::vector<dBodyID> masses;
  double h, restitution;

  World(Door& door) : h(door.step()), restitution(door.restitution) {
    dInitODE();
    world = dWorldCreate(), space = dSimpleSpaceCreate(nullptr), contacts = dJointGroupCreate(0);
    if (door.has("tuned")) dWorldSetERP(world, 0.0), dWorldSetCFM(world, 0.0);
    for (const auto& wall : door.walls)
      dGeomSetPosition(dCreateSphere(space, 0.5), wall.x, wall.y, 0.0);
    for (std::size_t i = 0; i < door.masses; ++i) {
      const auto& ball = door.balls[i];
      const auto body = dBodyCreate(world);
      dMass mass;
      dMassSetSphereTotal(&mass, ball.mass, 0.5);
      dBodySetMass(body, &mass);
      dBodySetPosition(body, ball.x, ball.y, 0.0);
      dBodySetLinearVel(body, ball.v, 0.0, 0.0);
      dGeomSetBody(dCreateSphere(space, 0.5), body);
      if (door.settings["springs"] == "own") {
        const double k = door.stiffness(i), c = door.damping(i);
        const auto slider = dJointCreateSlider(world, nullptr);
        dBodySetPosition(body, door.place[i], ball.y, 0.0);
        dJointAttach(slider, body, nullptr);
        dJointSetSliderAxis(slider, 1, 0, 0);
        dBodySetPosition(body, ball.x, ball.y, 0.0);
        dJointSetSliderParam(slider, dParamLoStop, 0.0),
            dJointSetSliderParam(slider, dParamHiStop, 0.0);
        dJointSetSliderParam(slider, dParamStopERP, h * k / (h * k + c));
        dJointSetSliderParam(slider, dParamStopCFM, 1.0 / (h * k + c));
      }
      masses.push_back(body);
    }
  }
  static void touch(void* data, dGeomID a, dGeomID b) {
    auto& self = *static_cast<World*>(data);
    dContact contact{};
    if (dCollide(a, b, 1, &contact.geom, sizeof contact) == 0) return;
    contact.surface.mode = dContactBounce;
    contact.surface.bounce = self.restitution;
    const auto joint = dJointCreateContact(self.world, self.contacts, &contact);
    dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
  }
  double position(std::size_t i) { return dBodyGetPosition(masses[i])[0]; }
  double velocity(std::size_t i) { return dBodyGetLinearVel(masses[i])[0]; }
  void step(const Row& forces) {
    for (std::size_t i = 0; i < forces.size(); ++i) dBodyAddForce(masses[i], forces[i], 0.0, 0.0);
    dSpaceCollide(space, this, touch);
    dWorldStep(world, h);
    dJointGroupEmpty(contacts);
  }
};

int main(int count, char** words) {
  Door door(count, words);
  return door.run(World(door), door.step(), door.steps());
}
