// Bullet: symplectic Euler, sequential impulses. tutorial=1: stepSimulation(h) as in most examples,
// which integrates with its own 1/60 s and interpolates.
#include <btBulletDynamicsCommon.h>

#include "../door.hpp"

struct World {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  btSphereShape sphere{0.5};
  std::vector<btRigidBody*> masses;
  std::vector<btDefaultMotionState*> states;
  btScalar h;
  bool tutorial;

  World(Door& door) : h(btScalar(door.step())), tutorial(door.has("tutorial")) {
    world.setGravity(btVector3(0, 0, 0));
    if (door.has("erp"))
      world.getSolverInfo().m_erp = world.getSolverInfo().m_erp2 =
          btScalar(door.number("erp", 0.0));
    // The coefficients of both bodies are multiplied.
    const auto restitution = door.has("tuned") ? std::sqrt(door.restitution) : door.restitution;
    for (const auto& wall : door.walls) add(door, wall, restitution);
    for (const auto& ball : door.balls) masses.push_back(add(door, ball, restitution));
  }
  btRigidBody* add(Door& door, const Ball& ball, double restitution) {
    states.push_back(new btDefaultMotionState(btTransform(
        btQuaternion::getIdentity(), btVector3(btScalar(ball.x), btScalar(ball.y), 0))));
    btRigidBody::btRigidBodyConstructionInfo info(btScalar(ball.mass), states.back(), &sphere);
    info.m_restitution = btScalar(restitution);
    info.m_friction = 0;
    auto* body = new btRigidBody(info);
    body->setAngularFactor(btVector3(0, 0, 0));
    body->setLinearVelocity(btVector3(btScalar(ball.v), 0, 0));
    if (door.has("tuned") || door.has("awake")) body->setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(body);
    return body;
  }
  double position(std::size_t i) {
    btTransform place;
    masses[i]->getMotionState()->getWorldTransform(place);
    return double((tutorial ? place : masses[i]->getWorldTransform()).getOrigin().x());
  }
  double velocity(std::size_t i) { return double(masses[i]->getLinearVelocity().x()); }
  void step(const Row& forces) {
    for (std::size_t i = 0; i < forces.size(); ++i)
      masses[i]->applyCentralForce(btVector3(btScalar(forces[i]), 0, 0));
    tutorial ? world.stepSimulation(h) : world.stepSimulation(h, 0);
  }
};

int main(int count, char** words) {
  Door door(count, words);
  return door.run(World(door), door.step(), door.steps());
}
