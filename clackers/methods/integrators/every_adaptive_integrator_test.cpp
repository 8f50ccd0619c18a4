// The facts of every integrator of the registry that chooses its steps, measured.

#include <algorithm>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/methods/testing/stepper_checks.hpp"

namespace clackers::methods {
namespace {

constexpr double start = 1.0, end = 41.0;

// A whole run, in blocks.
template <int Dof>
struct AdaptiveRun {
  std::unique_ptr<AnyStepper<Dof>> stepper;
  std::vector<model::State<Dof>> states;

  AdaptiveRun(const std::string& name, const auto& problem, double tolerance)
      : stepper(
            integrator(name)->stepper(problem.system, plan_adaptive(name, start, end, tolerance))),
        states{problem.exact(start)} {
    std::vector<model::State<Dof>> block(9, states[0]);
    stepper->restart(states[0]);
    while (states.back().t != end && !stepper->failed()) {
      block[0] = states.back();
      const auto made = stepper->advance(0, block);
      states.insert(states.end(), block.begin() + 1, block.begin() + 1 + std::ptrdiff_t(made));
    }
    EXPECT_FALSE(stepper->failed());
  }
  double steps() const { return double(states.size() - 1); }
};

// Root mean square error of u and v over equal steps of time is what orders are of; the ends of steps
// lie nearly so.
template <int Dof, class Problem>
double error_of(const AdaptiveRun<Dof>& run, const Problem& problem) {
  double sum = 0.0;
  for (const auto& x : run.states) {
    const auto exact = problem.exact(x.t);
    sum += (x.u - exact.u).squaredNorm() + (x.v - exact.v).squaredNorm();
  }
  return std::sqrt(sum / run.steps());
}

class EveryAdaptiveIntegrator : public testing::TestWithParam<std::string> {
 protected:
  std::string name = GetParam();
  Facts facts = integrator(name)->facts();

  // Slopes of log error over those of log mean step and of log tolerance.
  template <int Dof, class Problem>
  void expect_order(const Problem& problem) const {
    std::vector<double> errors, steps;
    for (int i = 0; i <= 6; ++i) {
      const AdaptiveRun<Dof> run(name, problem, std::pow(10.0, -6.5 - 0.75 * i));
      errors.push_back(error_of(run, problem));
      steps.push_back(run.steps());
    }
    const double fall = std::log(errors[0] / errors[6]);
    EXPECT_NEAR(fall / std::log(steps[6] / steps[0]), facts.smooth_order, 0.1 * facts.smooth_order);
    EXPECT_NEAR(fall / std::log(10.0) / 4.5, 1.0, 0.15);
    EXPECT_LT(errors[6], 300 * std::pow(10.0, -11.0));
  }
};

TEST_P(EveryAdaptiveIntegrator, ConvergesAtItsOrderInTheMeanStepAndWithTheTolerance) {
  expect_order<1>(checks::Waves<1>(1, 0.3));
  expect_order<2>(checks::Waves<2>(2, 0.0));
  expect_order<model::any_dof>(checks::Waves<model::any_dof>(3, 0.3));
}

TEST_P(EveryAdaptiveIntegrator, ConvergesLikewiseWithANonlinearForce) {
  expect_order<1>(checks::Cubic<1>(1));
  expect_order<model::any_dof>(checks::Cubic<model::any_dof>(3));
}

// Of the first step, whose beginning is exact, in the middle.
TEST_P(EveryAdaptiveIntegrator, HasDenseOutputOfItsOrder) {
  const checks::Waves<2> problem(2, 0.3);
  const auto error = [&](double h) {
    const auto stepper =
        integrator(name)->stepper(problem.system, plan_adaptive(name, start, start + h, 0.999));
    std::vector<model::State<2>> block(2, problem.exact(start));
    double largest = 0.0;
    stepper->restart(block[0]);
    while (block[0].t != start + h) {
      EXPECT_EQ(stepper->advance(0, block), 1u);
      block[0] = block[1];
    }
    block[0] = problem.exact(start);
    stepper->reset();
    stepper->restart(block[0]);
    EXPECT_EQ(stepper->advance(0, block), 1u);
    const double length = block[1].t - start;
    stepper->rewind(0, block, 0);
    for (const double part : {0.2, 0.5, 0.8}) {
      const auto exact = problem.exact(start + part * length);
      const auto& x = stepper->partial(block[0], part * length);
      EXPECT_EQ(x.t, start + part * length);
      largest = std::max(largest, (x.u - exact.u).norm() + (x.v - exact.v).norm());
    }
    return std::pair(length, largest);
  };
  const auto [coarse, first] = error(0.2);
  const auto [fine, second] = error(0.1);
  ASSERT_NEAR(coarse, 2.0 * fine, 1e-12);  // the whole run in one step
  EXPECT_NEAR(std::log2(first / second), facts.dense_order + 1.0, 0.3);
}

TEST_P(EveryAdaptiveIntegrator, GoesBackIntoABlock) {
  const checks::Ramps<2> problem(2, 0.3);
  const auto stepper =
      integrator(name)->stepper(problem.system, plan_adaptive(name, start, 1000.0, 1e-6));
  std::vector<model::State<2>> block(20, problem.exact(start)), again = block;
  for (const std::size_t back : {0u, 1u, 12u}) {
    stepper->reset();
    stepper->restart(block[0]);
    ASSERT_EQ(stepper->advance(0, block), 19u);
    model::Work whole;
    stepper->add_work(whole);
    stepper->rewind(0, block, back);
    const double length = block[back + 1].t - block[back].t;
    // The dense output meets the ends of the step, and looking changes nothing.
    const auto whole_step = stepper->partial(block[back], length);
    EXPECT_LT((whole_step.u - block[back + 1].u).norm(), 1e-13);
    EXPECT_LT((whole_step.v - block[back + 1].v).norm(), 1e-13);
    const auto none = stepper->partial(block[back], 0.0);
    EXPECT_EQ(none.u, block[back].u);
    again[0] = block[back];
    ASSERT_EQ(stepper->advance(0, {again.data(), 20 - back}), 19 - back);
    for (std::size_t i = 0; i + back < 20; ++i) {
      EXPECT_EQ(again[i].t, block[back + i].t);
      EXPECT_EQ(again[i].u, block[back + i].u);
      EXPECT_EQ(again[i].v, block[back + i].v);
    }
  }
}

TEST_P(EveryAdaptiveIntegrator, KeepsItsStepWhenRestarted) {
  const checks::Waves<1> problem(1, 0.3);
  const AdaptiveRun<1> run(name, problem, 1e-8);
  std::vector<model::State<1>> block(2, run.states.back());
  block[0] = problem.exact(start);
  run.stepper->restart(block[0]);
  ASSERT_EQ(run.stepper->advance(0, block), 1u);
  const double typical = (end - start) / run.steps(), step = block[1].t - start;
  EXPECT_GT(step, 0.2 * typical);
  EXPECT_LT(step, 5.0 * typical);
}

TEST_P(EveryAdaptiveIntegrator, EndsAtTheEndToTheBit) {
  for (const double tolerance : {1e-3, 1e-6, 1e-12})
    EXPECT_EQ(AdaptiveRun<1>(name, checks::Ramps<1>(1, 0.3), tolerance).states.back().t, end);
}

// From a start at rest, and from an equilibrium that is never left.
TEST_P(EveryAdaptiveIntegrator, StartsFromRest) {
  auto system = checks::oscillator();
  const auto plan = plan_adaptive(name, 0.0, 10.0, 1e-6);
  std::vector<model::State<1>> block(65, {0.0, model::Vector<1>(0.0), model::Vector<1>(0.0)});
  const auto resting = integrator(name)->stepper(system, plan);
  resting->restart(block[0]);
  ASSERT_LT(resting->advance(0, block), 20u);
  EXPECT_EQ(block[1].u[0], 0.0);
  system.add_load = [](double t, std::span<double> f) { f[0] += t; };
  const auto loaded = integrator(name)->stepper(system, plan);
  block.assign(2001, block[0]);
  loaded->restart(block[0]);
  std::size_t made = 0;
  while (block[made].t != 10.0 && made < 1900)
    made += loaded->advance(0, {block.data() + made, 65});
  EXPECT_LT(made, 150u);
  EXPECT_NEAR(block[made].u[0], 10.0 - std::sin(10.0), 1e-4);
}

TEST_P(EveryAdaptiveIntegrator, FailsWhereTheToleranceCannotBeMet) {
  auto system = checks::oscillator();
  system.add_load = [](double t, std::span<double> f) { f[0] += t < 0.7 ? 0.0 : NAN; };
  const auto stepper = integrator(name)->stepper(system, plan_adaptive(name, 0.0, 10.0, 1e-6));
  std::vector<model::State<1>> block(65, checks::displaced());
  stepper->restart(block[0]);
  const auto made = stepper->advance(0, block);
  EXPECT_TRUE(stepper->failed());
  EXPECT_EQ(stepper->failure(), Code("step-too-small"));
  EXPECT_NEAR(block[made].t, 0.7, 1e-12);
  stepper->reset();
  EXPECT_FALSE(stepper->failed());
}

TEST_P(EveryAdaptiveIntegrator, RefusesAStep) {
  const auto system = checks::oscillator();
  EXPECT_THROW(integrator(name)->stepper(system, checks::endless(0.0, 0.1)), InputError);
}

std::vector<std::string> registered() {
  std::vector<std::string> all;
  for (const auto& entry : entries())
    if (entry.kind == "integrator" && integrator(entry.name)->facts().is_adaptive)
      all.push_back(entry.name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryAdaptiveIntegrator, testing::ValuesIn(registered()));

}  // namespace
}  // namespace clackers::methods
