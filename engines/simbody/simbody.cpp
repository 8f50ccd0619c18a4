// Simbody: Runge-Kutta-Merson with triggered events and springs of its own.
#include <Simbody.h>

#include "../flights.hpp"

using SimTK::Real, SimTK::State, SimTK::Vec3;

class Impact : public SimTK::TriggeredEventHandler {
 public:
  Impact(Flights& door, std::size_t k)
      : TriggeredEventHandler(SimTK::Stage::Position), door_(door), k_(k) {
    getTriggerInfo().setTriggerOnRisingSignTransition(false);
    if (door.has("window")) getTriggerInfo().setRequiredLocalizationTimeWindow(door.tolerance());
  }
  static Row values(const Flights& door, const State& state) {
    Row y;
    for (int i = 0; i < int(door.masses); ++i) y.push_back(state.getQ()[i]);
    for (int i = 0; i < int(door.masses); ++i) y.push_back(state.getU()[i]);
    return y;
  }
  Real getValue(const State& state) const override {
    return door_.gap(k_, values(door_, state).data());
  }
  void handleEvent(State& state, Real, bool&) const override {
    auto y = values(door_, state);
    door_.impact(k_, state.getTime(), y.data());
    for (int i = 0; i < int(door_.masses); ++i) state.updU()[i] = y[door_.masses + std::size_t(i)];
  }

 private:
  Flights& door_;
  std::size_t k_;
};

int main(int count, char** words) {
  Flights door(count, words);
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter(system);
  SimTK::GeneralForceSubsystem forces(system);
  for (std::size_t i = 0; i < door.masses; ++i) {
    SimTK::Body::Rigid body(SimTK::MassProperties(door.balls[i].mass, Vec3(0), SimTK::Inertia(1)));
    SimTK::MobilizedBody::Slider slider(matter.Ground(), body);
    SimTK::Force::MobilityLinearSpring(forces, slider, SimTK::MobilizerQIndex(0), door.stiffness(i),
                                       0.0);
    SimTK::Force::MobilityLinearDamper(forces, slider, SimTK::MobilizerUIndex(0), door.damping(i));
  }
  for (std::size_t k = 1; k <= door.contacts; ++k) system.addEventHandler(new Impact(door, k));
  State state = system.realizeTopology();
  const auto y = door.first();
  for (int i = 0; i < int(door.masses); ++i)
    state.updQ()[i] = y[std::size_t(i)], state.updU()[i] = y[door.masses + std::size_t(i)];
  SimTK::RungeKuttaMersonIntegrator integrator(system);
  integrator.setAccuracy(door.tolerance());
  SimTK::TimeStepper stepper(system, integrator);
  stepper.initialize(state);
  door.write(door.start, y.data());
  for (long k = 1; k <= door.rows; ++k) {
    stepper.stepTo(door.at(k));
    door.write(door.at(k), Impact::values(door, integrator.getState()).data());
  }
  return door.close();
}
