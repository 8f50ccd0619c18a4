#include <gtest/gtest.h>

#include "clackers/diagnose/testing/ladder_sets.hpp"
#include "clackers/diagnose/testing/method_rows.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::diagnose::testing {
namespace {

constexpr int plans = 10;

TEST(OutputCauses, NameWhatIsAddedToTheOutput) {
  for (int i = 0; i < plans; ++i)
    for (const double size : {2e-4, -5e-5}) {
      const auto number = std::to_string(size);
      const auto drifts =
          diagnose(files_of(ladder_plan(i), "method=rk4 drift=" + number).question());
      ASSERT_EQ(codes(drifts), "output-drifts") << i << ' ' << size;
      EXPECT_NEAR(drifts[0].value, size, 0.05 * std::abs(size));
      EXPECT_EQ(drifts[0].unit, "m/s");
      const auto offsets =
          diagnose(files_of(ladder_plan(i), "method=rk4 offset=" + number).question());
      ASSERT_EQ(codes(offsets), "output-offset") << i << ' ' << size;
      EXPECT_NEAR(offsets[0].value, size, 0.05 * std::abs(size));
      EXPECT_EQ(offsets[0].text, "u1");
      EXPECT_TRUE(is_other_system(offsets[0]));
    }
}

TEST(OutputCauses, AreNoneOfMethodsAndOfOtherSystems) {
  for (int i = 0; i < plans; ++i)
    for (const char* solver : {"method=rk4", "method=implicit-euler", "method=newmark c*=1.01",
                               "method=rk4 k1*=1.002", "method=rk4 late-seconds=0.001"}) {
      const auto causes = diagnose(files_of(ladder_plan(i), solver).question());
      EXPECT_FALSE(find(causes, "output-offset")) << i << ' ' << solver;
      EXPECT_FALSE(find(causes, "output-drifts")) << i << ' ' << solver;
    }
}

TEST(OutputCauses, UnderLoadsNeedRightVelocities) {
  const auto problem = cases::make("forced-pair");
  const auto found = [&](double offset, double force) {
    Files files{problem};
    auto solved = problem.problem;
    const auto* load = solved.system.add_load.target<model::HarmonicLoad>();
    auto forces = load->forces();
    forces.push_back({0, force, 0.0, 0.0});
    solved.system.add_load = model::HarmonicLoad(forces);
    for (const double h : {0.018, 0.009, 0.0045}) {
      auto rows = run("rk4", solved, h);
      for (std::size_t i = 1; i < rows.t.size(); ++i) rows.u[2 * i] += offset;
      files.add(rows, h);
    }
    return diagnose(files.question());
  };
  const auto offset = found(1e-3, 0.0), force = found(0.0, 1e-3);
  ASSERT_TRUE(find(offset, "output-offset")) << codes(offset);
  EXPECT_NEAR(find(offset, "output-offset")->value, 1e-3, 5e-5);
  EXPECT_FALSE(find(force, "output-offset")) << codes(force);
}

}  // namespace
}  // namespace clackers::diagnose::testing
