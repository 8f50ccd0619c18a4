// Box2D: symplectic Euler in single precision, sequential impulses after overlap.
#include <box2d/box2d.h>

#include "../door.hpp"

struct World {
  b2World world{b2Vec2(0.0F, 0.0F)};
  std::vector<b2Body*> masses;
  float h;

  World(Door& door) : h(float(door.step())) {
    world.SetAllowSleeping(!door.has("tuned"));
    for (const auto& wall : door.walls) add(door, wall, b2_staticBody);
    for (const auto& ball : door.balls) masses.push_back(add(door, ball, b2_dynamicBody));
  }
  b2Body* add(Door& door, const Ball& ball, b2BodyType type) {
    b2BodyDef definition;
    definition.type = type;
    definition.position.Set(float(ball.x), float(ball.y));
    definition.linearVelocity.Set(float(ball.v), 0.0F);
    definition.fixedRotation = true;
    auto* body = world.CreateBody(&definition);
    b2CircleShape circle;
    circle.m_radius = 0.5F;
    b2FixtureDef fixture;
    fixture.shape = &circle;
    fixture.density = float(ball.mass / (M_PI * 0.25));
    fixture.friction = 0.0F;
    fixture.restitution = float(door.restitution);
    if (door.has("tuned")) fixture.restitutionThreshold = 0.0F;
    body->CreateFixture(&fixture);
    return body;
  }
  double position(std::size_t i) { return double(masses[i]->GetPosition().x); }
  double velocity(std::size_t i) { return double(masses[i]->GetLinearVelocity().x); }
  void step(const Row& forces) {
    for (std::size_t i = 0; i < forces.size(); ++i)
      masses[i]->ApplyForceToCenter(b2Vec2(float(forces[i]), 0.0F), true);
    world.Step(h, 8, 3);
  }
};

int main(int count, char** words) {
  Door door(count, words);
  return door.run(World(door), door.step(), door.steps());
}
