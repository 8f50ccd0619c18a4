// Boost.odeint: dense output of dopri5; it has no roots, so an impact is bisected on the dense output.
#include <boost/numeric/odeint.hpp>

#include "../flights.hpp"

namespace odeint = boost::numeric::odeint;

int main(int count, char** words) {
  Flights door(count, words);
  const auto system = [&](const Row& y, Row& out, double) {
    door.derivative(y.data(), out.data());
  };
  auto y = door.first();
  double t = door.start;
  long k = 0;
  Row now(y.size());
  while (k <= door.rows) {
    auto stepper = odeint::make_dense_output(door.tolerance(), door.tolerance(),
                                             odeint::runge_kutta_dopri5<Row>());
    stepper.initialize(y, t, 1e-3);
    for (bool hit = false; !hit && k <= door.rows;) {
      stepper.do_step(system);
      double low = stepper.previous_time(), high = stepper.current_time();
      hit = door.closed(stepper.current_state().data()) != 0;
      for (double middle; hit && low < (middle = low + (high - low) / 2) && middle < high;) {
        stepper.calc_state(middle, now);
        (door.closed(now.data()) ? high : low) = middle;
      }
      for (; k <= door.rows && door.at(k) <= high; ++k) {
        stepper.calc_state(door.at(k), now);
        door.write(door.at(k), now.data());
      }
      if (!hit) continue;
      t = high;
      stepper.calc_state(t, y);
      if (t < door.end) door.impact(door.closed(y.data()), t, y.data());
    }
  }
  return door.close();
}
