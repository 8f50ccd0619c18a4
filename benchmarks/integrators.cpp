// Scalar step loops against Boost.odeint's runge_kutta4 on std::array<double, 4>, on the default
// pair of masses with located impacts. Both sides see the same dense 2 x 2 right-hand side and run
// through the same event code and the same recorder: the peer is dressed as one more integrator, so
// the only difference is who computes a step. Prints the median of alternated runs; asserts
// nothing.
#include <fmt/format.h>

#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/util/copy.hpp>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "benchmarks/measure.hpp"
#include "clackers/methods/integrators/newmark.hpp"
#include "clackers/methods/integrators/rk4.hpp"
#include "clackers/methods/rows.hpp"

namespace {

using namespace clackers;

// The peer: (u1, u2, v1, v2)' = (v, -M^-1 C v - M^-1 K u).
struct OdeintRk4 {
  static constexpr std::string_view name = "odeint-rk4";
  template <int Dof>
  class Stepper;
};

template <>
class OdeintRk4::Stepper<2> {
 public:
  using State = model::State<2>;
  using Array = std::array<double, 4>;

  Stepper(const OdeintRk4&, const model::SmoothSystem<2>& system, double h)
      : system_(system), h_(h) {
    rebuild();
  }
  void rebuild() {
    numerics::SpdSolver<2> mass;
    mass.compute(system_.mass);
    model::Matrix<2> c = system_.damping, k = system_.stiffness;
    mass.solve_in_place(c);
    mass.solve_in_place(k);
    equation_ = {{k(0, 0), k(0, 1), k(1, 0), k(1, 1)}, {c(0, 0), c(0, 1), c(1, 0), c(1, 1)}};
  }
  void restart(const State&) {}
  void step(State& now) { advance(now, h_); }
  void undo() {}
  const State& partial(const State& from, double s) {
    to_ = from;
    advance(to_, s);
    return to_;
  }
  static constexpr bool failed() { return false; }
  static constexpr Code failure() { return "run-failed"; }
  void reset() {}
  void add_work(model::Work&) const {}

 private:
  struct Equation {
    Array k, c;
    void operator()(const Array& x, Array& d, double) const {
      d[0] = x[2];
      d[1] = x[3];
      d[2] = -(c[0] * x[2] + c[1] * x[3]) - (k[0] * x[0] + k[1] * x[1]);
      d[3] = -(c[2] * x[2] + c[3] * x[3]) - (k[2] * x[0] + k[3] * x[1]);
    }
  };

  void advance(State& now, double h) {
    Array x{now.u[0], now.u[1], now.v[0], now.v[1]};
    odeint_.do_step(std::cref(equation_), x, now.t, h);
    now = {now.t + h, {x[0], x[1]}, {x[2], x[3]}};
  }

  const model::SmoothSystem<2>& system_;
  double h_;
  Equation equation_;
  boost::numeric::odeint::runge_kutta4<Array> odeint_;
  State to_;
};

// m = 1, 1/3; k = 1, (0.9975 81 + 0.0025)/3; sigma = 0.05. Over 200 s the motion decays to e^-10:
// far from denormal numbers, which would be ten times slower.
model::ImpactProblem<> default_pair() {
  const double sigma = 0.05, r = 3.0, x = 9.0;
  model::ImpactProblem<> problem;
  problem.system.mass = Eigen::Vector2d(1.0, 1.0 / r).asDiagonal();
  problem.system.damping = 2.0 * sigma * problem.system.mass;
  problem.system.stiffness =
      Eigen::Vector2d(1.0, ((1.0 - sigma * sigma) * x * x + sigma * sigma) / r).asDiagonal();
  problem.contacts.push_back({Eigen::Vector2d(1.0, -1.0), 0.0, 1.0});
  const Eigen::Vector2d u(1.0, -r / x);
  problem.start = {0.0, u, -sigma * u};
  problem.end = 200.0;
  return problem;
}

// Reads each block once, so that no side can leave its results uncomputed.
struct ReadingSink : model::Sink {
  double sum = 0.0;
  long long impacts = 0;
  bool take(const model::SampleBlock& block) override {
    sum += block.u.back() + block.v.back();
    return true;
  }
  bool take(const model::ReportedImpact&) override { return ++impacts, true; }
};

struct Side {
  std::string name;
  std::unique_ptr<model::Run> run;
  std::vector<double> nanoseconds;  // a step
  ReadingSink sink;
};

template <class Integrator>
Side side(const model::ImpactProblem<>& problem, double h) {
  using Loop = methods::EventDriven::TimeLoop<Integrator, 2>;
  const std::string name(Integrator::name);
  return {name,
          std::make_unique<methods::MethodRun<Loop, 2>>(
              name, problem, methods::plan_steps(name, 0.0, problem.end, h), Integrator{},
              methods::EventDriven{}),
          {},
          {}};
}

double time_once(Side& side, long long steps) {
  side.sink = {};
  const double begin = benchmarks::processor_time();
  side.run->advance(side.sink);
  return (benchmarks::processor_time() - begin) / double(steps);
}

}  // namespace

int main() {
  const auto problem = default_pair();
  const long long steps = 1'000'000;
  const double h = problem.end / double(steps);
  constexpr int runs = benchmarks::runs;

  std::vector<Side> sides;
  sides.push_back(side<OdeintRk4>(problem, h));
  sides.push_back(side<methods::Rk4>(problem, h));
  sides.push_back(side<methods::Newmark>(problem, h));
  for (auto& each : sides) time_once(each, steps);  // warm up
  for (int i = 0; i < runs; ++i)
    for (auto& each : sides) each.nanoseconds.push_back(time_once(each, steps));

  fmt::print("{}, {}\n", benchmarks::processor(), benchmarks::compiler());
  fmt::print("default pair, located impacts, {} steps, median of {} alternated runs\n", steps,
             runs);
  fmt::print("peer: boost::numeric::odeint::runge_kutta4<std::array<double, 4>>\n\n");
  fmt::print("{:<12} {:>10} {:>10} {:>7}  {:<18} {:>9}\n", "", "ns a step", "peer, ns", "ratio",
             "wanted", "impacts");
  const double peer = benchmarks::median(sides[0].nanoseconds);
  const double most[] = {0.0, 1.05, 0.8};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const double own = benchmarks::median(sides[i].nanoseconds), ratio = own / peer;
    fmt::print(
        "{:<12} {:>10.2f} {:>10.2f} {:>7.3f}  {:<18} {:>9}\n", sides[i].name, own, peer, ratio,
        i == 0 ? "" : fmt::format("<= {:<5} {}", most[i], ratio <= most[i] ? "reached" : "MISSED"),
        sides[i].sink.impacts);
  }
}
