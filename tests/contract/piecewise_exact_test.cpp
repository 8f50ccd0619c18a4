// Impact times and states of piecewise-exact beside those of the closed forms.

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
  const auto test_case = cases::make(GetParam().name, GetParam().settings);
  model::TrajectorySink sink(true);
  const double h = test_case.problem.end / 97.0;
  const auto outcome =
      methods::method("piecewise-exact")->prepare(test_case.problem, h)->advance(sink);
  ASSERT_TRUE(outcome.finished) << outcome.detail;
  const auto& path = sink.trajectory();
  const auto& impacts = *path.impacts;
  const auto count = test_case.motion->impact_count(test_case.problem.end);
  ASSERT_EQ(std::ssize(impacts), count);
  ASSERT_GE(count, 1);
  for (long long k = 1; k <= count; ++k) {
    const double t = test_case.motion->impact(k).t;
    EXPECT_NEAR(impacts[std::size_t(k - 1)].t, t, 1e-13 * t) << "impact " << k;
  }
  const auto scale = test_case.motion->envelope(0.0);
  // The fastest phase is rounded once or twice, and so is its frequency.
  const auto& system = test_case.problem.system;
  const double fastest =
      std::sqrt((system.stiffness.diagonal().array() / system.mass.diagonal().array()).maxCoeff());
  const double allowed = 1e-14 + 4.0 * 0x1p-52 * fastest * test_case.problem.end;
  for (std::size_t i = 0; i < path.t.size(); ++i) {
    const auto known =
        test_case.motion->at(std::min(path.t[i], test_case.motion->end()), model::Side::right);
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
    [](const auto& parameter) {
      std::string name = parameter.param.name + std::to_string(parameter.index);
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

}  // namespace
}  // namespace clackers
