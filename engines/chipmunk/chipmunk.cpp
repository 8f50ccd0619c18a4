// Chipmunk: positions before velocities, doubles. springs=own: cpDampedSpring.
#include <chipmunk/chipmunk.h>

#include "../door.hpp"

struct World {
  cpSpace* space = cpSpaceNew();
  std::vector<cpBody*> masses;
  double h;

  World(Door& door) : h(door.step()) {
    // The coefficients of both bodies are multiplied.
    const double restitution = door.has("tuned") ? std::sqrt(door.restitution) : door.restitution;
    if (door.has("tuned")) cpSpaceSetCollisionSlop(space, 0.0);
    for (const auto& wall : door.walls)
      shape(cpCircleShapeNew(cpSpaceGetStaticBody(space), 0.5, cpv(wall.x, wall.y)), restitution);
    for (std::size_t i = 0; i < door.masses; ++i) {
      const auto& ball = door.balls[i];
      auto* body = cpSpaceAddBody(space, cpBodyNew(ball.mass, INFINITY));
      cpBodySetPosition(body, cpv(ball.x, ball.y));
      cpBodySetVelocity(body, cpv(ball.v, 0.0));
      shape(cpCircleShapeNew(body, 0.5, cpvzero), restitution);
      masses.push_back(body);
      if (door.settings["springs"] != "own") continue;
      const double far = 100.0;
      cpSpaceAddConstraint(space, cpDampedSpringNew(cpSpaceGetStaticBody(space), body,
                                                    cpv(door.place[i] - far, ball.y), cpvzero, far,
                                                    door.stiffness(i), door.damping(i)));
    }
  }
  void shape(cpShape* circle, double restitution) {
    cpShapeSetElasticity(circle, restitution);
    cpShapeSetFriction(circle, 0.0);
    cpSpaceAddShape(space, circle);
  }
  double position(std::size_t i) { return cpBodyGetPosition(masses[i]).x; }
  double velocity(std::size_t i) { return cpBodyGetVelocity(masses[i]).x; }
  void step(const Row& forces) {
    for (std::size_t i = 0; i < forces.size(); ++i) cpBodySetForce(masses[i], cpv(forces[i], 0.0));
    cpSpaceStep(space, h);
  }
};

int main(int count, char** words) {
  Door door(count, words);
  return door.run(World(door), door.step(), door.steps());
}
