// Collision times and states of piecewise-exact beside those of the closed forms.

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/cases/case.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers {
namespace {

struct ExactTask {
  std::string name;
  cases::Settings settings;
};

class PiecewiseExactBeside : public testing::TestWithParam<ExactTask> {};

TEST_P(PiecewiseExactBeside, TheClosedFormCollidesAtTheSameTimes) {
  const auto which = cases::make(GetParam().name, GetParam().settings);
  model::TrajectorySink sink(true);
  const double h = which.problem.end / 97.0;
  const auto outcome = methods::method("piecewise-exact")->prepare(which.problem, h)->advance(sink);
  ASSERT_TRUE(outcome.finished) << outcome.detail;
  const auto& path = sink.trajectory();
  const auto& impacts = *path.impacts;
  const auto count = which.motion->impact_count(which.problem.end);
  ASSERT_EQ(std::ssize(impacts), count);
  ASSERT_GE(count, 1);
  for (long long k = 1; k <= count; ++k) {
    const double t = which.motion->impact(k).t;
    EXPECT_NEAR(impacts[std::size_t(k - 1)].t, t, 1e-13 * t) << "collision " << k;
  }
  const auto scale = which.motion->envelope(0.0);
  // The fastest phase is rounded once or twice, and so is its frequency.
  const auto& system = which.problem.system;
  const double fastest =
      std::sqrt((system.stiffness.diagonal().array() / system.mass.diagonal().array()).maxCoeff());
  const double allowed = 1e-14 + 4.0 * 0x1p-52 * fastest * which.problem.end;
  for (std::size_t i = 0; i < path.t.size(); ++i) {
    const auto known =
        which.motion->at(std::min(path.t[i], which.motion->end()), model::Side::right);
    for (int j = 0; j < path.dof; ++j) {
      const auto row = i * std::size_t(path.dof) + std::size_t(j);
      EXPECT_NEAR(path.u[row], known.u[j], allowed * scale.u[j]) << path.t[i];
      EXPECT_NEAR(path.v[row], known.v[j], allowed * scale.v[j]) << path.t[i];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, PiecewiseExactBeside,
    testing::Values(ExactTask{"three-parameter", {{"N", 2.0}}},
                    ExactTask{"three-parameter", {{"N", 5.0}}},
                    ExactTask{"three-parameter", {{"N", 100.0}, {"xi1", 0.0}, {"a_t", 1.0}}},
                    ExactTask{"synchronized-pair", {{"eta", 0.7}}},
                    ExactTask{"synchronized-pair", {{"X", 81.0}, {"r", 4.5}, {"eta", 0.97}}},
                    ExactTask{"synchronized-pair", {{"X", 3.0}, {"r", 0.5}, {"eta", 0.0}}},
                    ExactTask{"stop", {{"eta", 0.7}}}, ExactTask{"symmetric-pair", {{"eta", 0.9}}}),
    [](const auto& which) {
      std::string name = which.param.name + std::to_string(which.index);
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

}  // namespace
}  // namespace clackers
