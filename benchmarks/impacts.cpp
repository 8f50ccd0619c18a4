// What an impact of a pair costs: piecewise-exact beside solvers of ordinary differential equations
// that find it as a root, in the same run. Asserts nothing.
#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <array>
#include <boost/numeric/odeint/util/unwrap_reference.hpp>  // needed by the next

#include <boost/numeric/odeint/stepper/dense_output_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/util/copy.hpp>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "benchmarks/measure.hpp"
#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/methods/registry.hpp"

namespace clackers::benchmarks {
namespace {

constexpr double tolerance = 1e-10, absolute = 1e-12;

// (u1, u2, v1, v2)
using Array = std::array<double, 4>;

struct Pair {
  double m1, m2, k1, k2, c1, c2, end;
  Array start;

  void rate(const double* y, double* d) const {
    d[0] = y[2];
    d[1] = y[3];
    d[2] = -(c1 * y[2] + k1 * y[0]) / m1;
    d[3] = -(c2 * y[3] + k2 * y[1]) / m2;
  }
  // An elastic impact.
  void collide(double* y) const {
    const double impulse = 2.0 * (y[3] - y[2]) / (1.0 / m1 + 1.0 / m2);
    y[2] += impulse / m1;
    y[3] -= impulse / m2;
  }
};

Pair pair_of(const model::ImpactProblem<>& p) {
  const auto& s = p.system;
  return {s.mass(0, 0),
          s.mass(1, 1),
          s.stiffness(0, 0),
          s.stiffness(1, 1),
          s.damping(0, 0),
          s.damping(1, 1),
          p.end,
          {p.start.u[0], p.start.u[1], p.start.v[0], p.start.v[1]}};
}

using Times = std::vector<double>;  // of impacts [s]

// SUNDIALS CVODE: Adams' methods of variable order, fixed-point iteration, the gap as a root function
// with a direction, restarted after each impact.
class Cvode {
 public:
  explicit Cvode(const Pair& pair) : pair_(pair) {
    SUNContext_Create(nullptr, &context_);
    y_ = N_VNew_Serial(4, context_);
    cvode_ = CVodeCreate(CV_ADAMS, context_);
    solver_ = SUNNonlinSol_FixedPoint(y_, 0, context_);
    int closing = -1;
    std::copy(pair.start.begin(), pair.start.end(), NV_DATA_S(y_));
    is_good_ = CVodeInit(cvode_, rate, 0.0, y_) == 0 &&
               CVodeSStolerances(cvode_, tolerance, absolute) == 0 &&
               CVodeSetUserData(cvode_, &pair_) == 0 &&
               CVodeSetMaxNumSteps(cvode_, 100000000) == 0 &&
               CVodeSetNonlinearSolver(cvode_, solver_) == 0 &&
               CVodeRootInit(cvode_, 1, gap) == 0 && CVodeSetRootDirection(cvode_, &closing) == 0;
  }
  Cvode(const Cvode&) = delete;
  Cvode& operator=(const Cvode&) = delete;
  ~Cvode() {
    CVodeFree(&cvode_);
    SUNNonlinSolFree(solver_);
    N_VDestroy(y_);
    SUNContext_Free(&context_);
  }

  void run(Times& times) {
    times.clear();
    std::copy(pair_.start.begin(), pair_.start.end(), NV_DATA_S(y_));
    double t = 0.0;
    if (CVodeReInit(cvode_, t, y_) != 0 || CVodeSetStopTime(cvode_, pair_.end) != 0)
      is_good_ = false;
    while (is_good_) {
      const int flag = CVode(cvode_, pair_.end, y_, &t, CV_NORMAL);
      if (flag != CV_ROOT_RETURN) {
        is_good_ = flag >= 0;
        return;
      }
      times.push_back(t);
      pair_.collide(NV_DATA_S(y_));
      is_good_ = CVodeReInit(cvode_, t, y_) == 0;
    }
    fmt::print("CVODE failed\n");
  }

 private:
  static int rate(realtype, N_Vector y, N_Vector d, void* data) {
    static_cast<const Pair*>(data)->rate(NV_DATA_S(y), NV_DATA_S(d));
    return 0;
  }
  static int gap(realtype, N_Vector y, realtype* g, void*) {
    g[0] = NV_Ith_S(y, 0) - NV_Ith_S(y, 1);
    return 0;
  }

  Pair pair_;
  SUNContext context_ = nullptr;
  N_Vector y_ = nullptr;
  void* cvode_ = nullptr;
  SUNNonlinearSolver solver_ = nullptr;
  bool is_good_ = false;
};

// Boost.odeint: Dormand and Prince's method of fifth order with dense output, in which bisection finds
// the root.
void run_odeint(const Pair& pair, Times& times) {
  namespace odeint = boost::numeric::odeint;
  auto stepper =
      odeint::make_dense_output(absolute, tolerance, odeint::runge_kutta_dopri5<Array>());
  const auto rate = [&](const Array& y, Array& d, double) { pair.rate(y.data(), d.data()); };
  times.clear();
  stepper.initialize(pair.start, 0.0, 1e-3);
  Array y;
  while (stepper.current_time() < pair.end) {
    stepper.do_step(rate);
    const Array& now = stepper.current_state();
    if (!(now[0] - now[1] < 0.0)) continue;
    double open = stepper.previous_time(), closed = stepper.current_time();
    while (closed - open > 1e-13 * closed) {
      const double middle = 0.5 * (open + closed);
      stepper.calc_state(middle, y);
      (y[0] - y[1] < 0.0 ? closed : open) = middle;
    }
    if (open >= pair.end) break;
    times.push_back(open);
    stepper.calc_state(open, y);
    pair.collide(y.data());
    stepper.initialize(y, open, stepper.current_time_step());
  }
}

struct ImpactSink : model::Sink {
  Times* times;
  explicit ImpactSink(Times& to) : times(&to) { to.clear(); }
  bool take(const model::SampleBlock&) override { return true; }
  bool take(const model::ReportedImpact& impact) override {
    times->push_back(impact.t);
    return true;
  }
};

struct Row {
  std::string name;
  double wanted;  ///< how many times as long as ours
  std::function<void(Times&)> work;
  Times times{};
  std::vector<double> costs{};
};

double worst(const Times& times, const exact::SynchronizedPair& motion) {
  const auto count = motion.impact_count(motion.end());
  if (std::ssize(times) != count) return INFINITY;
  double error = 0.0;
  for (long long k = 1; k <= count; ++k) {
    const double t = motion.impact(k).t;
    error = std::max(error, std::abs(times[std::size_t(k - 1)] - t) / t);
  }
  return error;
}

void race(double X, double than_cvode, double than_odeint) {
  const exact::SynchronizedPair motion({.X = X});
  const auto problem = motion.problem();
  const auto pair = pair_of(problem);
  const auto run =
      std::shared_ptr(methods::method("piecewise-exact")->prepare(problem, problem.end));
  const auto cvode = std::make_shared<Cvode>(pair);
  std::vector<Row> rows{
      {"piecewise-exact", 0.0,
       [run](Times& times) {
         ImpactSink sink(times);
         run->advance(sink);
       }},
      {"SUNDIALS CVODE, Adams", than_cvode, [cvode](Times& times) { cvode->run(times); }},
      {"Boost.odeint, dopri5", than_odeint, [pair](Times& times) { run_odeint(pair, times); }}};
  std::vector<int> repeats;
  for (auto& row : rows) repeats.push_back(calibrate([&] { row.work(row.times); }));
  const auto impacts = double(motion.impact_count(motion.end()));
  for (int i = 0; i < runs; ++i)
    for (std::size_t j = 0; j < rows.size(); ++j)
      rows[j].costs.push_back(time_of([&] { rows[j].work(rows[j].times); }, repeats[j]) * 1e-3 /
                              impacts);
  fmt::print("\nX = {}, {} impacts\n{:<24} {:>12} {:>10}  {:>9} {:>8}\n", X, impacts, "",
             "us/impact", "time error", "ratio", "wanted");
  const double ours = median(rows[0].costs);
  for (const auto& row : rows) {
    const double cost = median(row.costs);
    fmt::print("{:<24} {:>12.3f} {:>10.1e}", row.name, cost, worst(row.times, motion));
    if (row.wanted > 0.0)
      fmt::print("  {:>9.0f} {:>8.0f}  {}", cost / ours, row.wanted,
                 cost / ours >= row.wanted ? "reached" : "not reached");
    fmt::print("\n");
  }
}

}  // namespace
}  // namespace clackers::benchmarks

int main() {
  using namespace clackers::benchmarks;
  fmt::print(
      "{}, {}\nmedian of {} alternated runs; processor time; relative error of the times of "
      "impacts\n",
      processor(), compiler(), runs);
  race(5.0, 800.0, 95.0);
  race(81.0, 8000.0, 950.0);
  race(401.0, 20000.0, 2500.0);
}
