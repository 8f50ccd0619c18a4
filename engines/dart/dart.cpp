// DART: symplectic Euler in doubles, contacts as a complementarity problem. springs=own: of the joints, implicit.
#include <memory>

#include <dart/dart.hpp>

#include "../door.hpp"

using namespace dart::dynamics;

struct World {
  dart::simulation::WorldPtr world = dart::simulation::World::create();
  std::vector<Joint*> joints;
  Row place;

  World(Door& door) : place(door.place) {
    world->setGravity(Eigen::Vector3d::Zero());
    world->setTimeStep(door.step());
    // The coefficients of both bodies are multiplied.
    const double restitution = door.has("tuned") ? std::sqrt(door.restitution) : door.restitution;
    for (const auto& wall : door.walls) {
      auto skeleton = Skeleton::create("wall");
      auto [joint, body] = skeleton->createJointAndBodyNodePair<WeldJoint>();
      joint->setTransformFromParentBodyNode(
          Eigen::Isometry3d(Eigen::Translation3d(wall.x, wall.y, 0.0)));
      add(skeleton, body, restitution);
    }
    for (std::size_t i = 0; i < door.masses; ++i) {
      const auto& ball = door.balls[i];
      auto skeleton = Skeleton::create("mass" + std::to_string(i));
      auto [joint, body] = skeleton->createJointAndBodyNodePair<PrismaticJoint>();
      joint->setAxis(Eigen::Vector3d::UnitX());
      joint->setTransformFromParentBodyNode(
          Eigen::Isometry3d(Eigen::Translation3d(door.place[i], ball.y, 0.0)));
      joint->setPosition(0, ball.x - door.place[i]);
      joint->setVelocity(0, ball.v);
      if (door.settings["springs"] == "own") {
        joint->setSpringStiffness(0, door.stiffness(i));
        joint->setDampingCoefficient(0, door.damping(i));
      }
      body->setMass(ball.mass);
      add(skeleton, body, restitution);
      joints.push_back(joint);
    }
  }
  void add(const SkeletonPtr& skeleton, BodyNode* body, double restitution) {
    auto* shape = body->createShapeNodeWith<CollisionAspect, DynamicsAspect>(
        std::make_shared<SphereShape>(0.5));
    shape->getDynamicsAspect()->setRestitutionCoeff(restitution);
    shape->getDynamicsAspect()->setFrictionCoeff(0.0);
    world->addSkeleton(skeleton);
  }
  double position(std::size_t i) { return place[i] + joints[i]->getPosition(0); }
  double velocity(std::size_t i) { return joints[i]->getVelocity(0); }
  void step(const Row& forces) {
    for (std::size_t i = 0; i < forces.size(); ++i) joints[i]->setForce(0, forces[i]);
    world->step();
  }
};

int main(int count, char** words) {
  Door door(count, words);
  return door.run(World(door), door.step(), door.steps());
}
