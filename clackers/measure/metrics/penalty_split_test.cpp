#include "clackers/measure/metrics/causes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/measure/testing/toy_motion.hpp"
#include "clackers/methods/registry.hpp"

namespace clackers::measure {
namespace {

// Stands for a penalized motion: ToyMotion with u greater by 0.1 and v by 0.2 t, in mass 1; mass 2
// is as it was.
class Shifted : public ToyMotion {
 public:
  using ToyMotion::ToyMotion;
  void sample(std::span<const double> times, model::Side side,
              model::SampleBuffers out) const override {
    ToyMotion::sample(times, side, out);
    for (std::size_t i = 0; i < times.size(); ++i) {
      out.u[2 * i] += 0.1;
      out.v[2 * i] += 0.2 * times[i];
    }
  }
};

TEST(PenaltySplit, MeasuresBothPartsOverTheHistorysRows) {
  const ToyMotion rigid;
  const Shifted penalized;
  const auto problem = toy_problem();
  auto history = toy_history({.end = 1.5, .h = 0.1});  // the rigid one, before its first impact
  for (std::size_t i = 0; i < history.t.size(); ++i) history.u[2 * i + 1] += 0.05;
  const Comparison comparison(history, rigid, problem);
  const auto split = penalty_split(comparison, penalized);
  EXPECT_NEAR(split.model_u.masses[0], 0.1, 1e-15);
  EXPECT_EQ(split.model_u.masses[1], 0.0);
  EXPECT_NEAR(split.integration_u.masses[0], 0.1, 1e-15);
  EXPECT_NEAR(split.integration_u.masses[1], 0.1, 1e-15);  // 0.05 of an envelope of 0.5
  EXPECT_NEAR(split.model_v.masses[0], 0.15, 1e-14);       // the mean of 0.2 t up to 1.5
  EXPECT_EQ(split.model_v.masses[1], 0.0);
  EXPECT_NEAR(split.integration_v.masses[0], 0.15, 1e-14);
  EXPECT_EQ(split.integration_v.value, split.integration_v.masses[0]);
}

TEST(PenaltySplit, SeparatesStiffnessFromStep) {
  const exact::SynchronizedPair rigid({.X = 5.0, .r = 0.5, .t_end = 8.0});
  const auto problem = rigid.problem();
  struct Parts {
    double model, integration;
  };
  const auto measure = [&](const char* method, double stiffness, double h) {
    const exact::PiecewiseMotion penalized(exact::with_springs(problem, stiffness));
    model::TrajectorySink sink(true);
    methods::method(method)->prepare(problem, h)->advance(sink);
    const Comparison comparison(sink.trajectory(), rigid, problem);
    const auto split = penalty_split(comparison, penalized);
    return Parts{split.model_u.value, split.integration_u.value};
  };
  const auto coarse = measure("rk4+penalty:stiffness=1e4", 1e4, 8.0 / 8000);
  const auto fine = measure("rk4+penalty:stiffness=1e4", 1e4, 8.0 / 32000);
  const auto stiff = measure("rk4+penalty:stiffness=1e6", 1e6, 8.0 / 32000);
  // The step does not touch the model's error, and the spring decides over it: k^(-1/2).
  EXPECT_NEAR(fine.model, coarse.model, 1e-3 * fine.model);
  EXPECT_NEAR(fine.model / stiff.model, 10.0, 1.0);
  // The integration converges against the penalized motion, though not against the rigid one; a
  // force with a kink leaves at least order 2.
  EXPECT_LT(fine.integration, coarse.integration / 14.0);
  EXPECT_LT(fine.integration, 1e-4 * fine.model);
  // The default stiffness of the method is 1e4 k1.
  EXPECT_LT(measure("rk4+penalty", 1e4, 8.0 / 32000).integration, 1e-4 * fine.model);
}

TEST(PenaltySplit, RefusesAMotionOfAnotherSizeOrLength) {
  const ToyMotion rigid, shorter(2.0);
  const auto problem = toy_problem();
  const auto history = toy_history({.end = 4.0});
  const Comparison comparison(history, rigid, problem);
  EXPECT_THROW(penalty_split(comparison, shorter), InputError);
  model::ImpactProblem<> one;
  one.system.mass = one.system.stiffness = Eigen::MatrixXd::Identity(1, 1);
  one.system.damping = Eigen::MatrixXd::Zero(1, 1);
  one.contacts.push_back({Eigen::VectorXd::Ones(1), 0.0, 1.0});
  one.start = {0.0, Eigen::VectorXd::Ones(1), Eigen::VectorXd::Zero(1)};
  one.end = 10.0;
  EXPECT_THROW(penalty_split(comparison, exact::PiecewiseMotion(exact::with_springs(one, 1e3))),
               InputError);
}

TEST(PenaltySplit, WithoutVelocitiesMeasuresDisplacements) {
  const ToyMotion rigid;
  const Shifted penalized;
  const auto problem = toy_problem();
  auto history = toy_history({.end = 1.5, .h = 0.1});
  history.v.clear();
  const auto split = penalty_split(Comparison(history, rigid, problem), penalized);
  EXPECT_NEAR(split.integration_u.masses[0], 0.1, 1e-15);
  EXPECT_EQ(split.integration_v.reason, "The history has no velocities.");
}

}  // namespace
}  // namespace clackers::measure
