// What a flight and a sample of the reference solution cost against the number of masses: chains with a
// stop, impacts with restitution and one load. Asserts nothing.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "benchmarks/measure.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::benchmarks {
namespace {

// Unit masses joined by springs; those of the ends move at the lowest frequencies of any length.
model::ImpactProblem<> chain(int n, double end) {
  model::ImpactProblem<> problem;
  auto& s = problem.system;
  s.mass = Eigen::MatrixXd::Identity(n, n);
  s.stiffness = Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i + 1 < n; ++i) {
    s.stiffness(i, i) += 1.0;
    s.stiffness(i + 1, i + 1) += 1.0;
    s.stiffness(i, i + 1) = s.stiffness(i + 1, i) = -1.0;
  }
  s.damping = 0.1 * s.stiffness;
  s.add_load = model::HarmonicLoad({{0, 1.5, 1.1, 0.0}});
  problem.contacts = {{Eigen::VectorXd::Unit(n, 0), -0.2, 0.8}};
  problem.start = {0.0, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  problem.end = end;
  return problem;
}

struct Costs {
  double build = 0.0, flight = 0.0, sample = 0.0;  // [s]
  long long flights = 0;
};

Costs costs(int n) {
  const auto seconds = [&](double end, long long& flights) {
    const double begin = processor_time();
    const exact::PiecewiseMotion motion(chain(n, end));
    flights = motion.impact_count(end);
    return 1e-9 * (processor_time() - begin);
  };
  Costs costs;
  long long none = 0;
  costs.build = seconds(1e-3, none);
  const double end = n < 500 ? 200.0 : 1000.0;
  costs.flight = (seconds(end, costs.flights) - costs.build) / double(costs.flights);
  const exact::PiecewiseMotion motion(chain(n, 1.0));
  const int times = n < 500 ? 1000 : 20;
  std::vector<double> t(std::size_t(times), 0.7), u(t.size() * std::size_t(n)), v(u.size());
  const double begin = processor_time();
  motion.sample(t, model::Side::right, {u, v, {}});
  costs.sample = 1e-9 * (processor_time() - begin) / times;
  return costs;
}

}  // namespace
}  // namespace clackers::benchmarks

int main() {
  using namespace clackers::benchmarks;
  fmt::print("{}, {}\n\n masses  modes [s]  flights  us/flight  exponent  us/sample  exponent\n",
             processor(), compiler());
  Costs before;
  int n_before = 0;
  for (const int n : {10, 100, 1000}) {
    const auto now = costs(n);
    const auto exponent = [&](double a, double b) {
      return n_before > 0 ? fmt::format("{:.2f}", std::log(b / a) / std::log(double(n) / n_before))
                          : std::string();
    };
    fmt::print("{:7} {:10.4f} {:8} {:10.1f} {:>9} {:10.2f} {:>9}\n", n, now.build, now.flights,
               1e6 * now.flight, exponent(before.flight, now.flight), 1e6 * now.sample,
               exponent(before.sample, now.sample));
    before = now;
    n_before = n;
  }
}
