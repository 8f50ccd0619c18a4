#include <gtest/gtest.h>

#include "clackers/diagnose/causes.hpp"
#include "clackers/diagnose/testing/histories.hpp"
#include "clackers/diagnose/testing/method_rows.hpp"

// Files of solvers that are right, or right solvers of another system, show no cause: methods of
// different order and contact treatment, cases, steps, digits, rows at each or each fifth step, with
// and without velocities.
namespace clackers::diagnose {
namespace {

using testing::Files;

model::Trajectory every(const model::Trajectory& rows, std::size_t stride) {
  model::Trajectory kept;
  kept.dof = rows.dof;
  const auto dof = std::ptrdiff_t(rows.dof);
  for (std::size_t row = 0; row < rows.t.size(); row += stride) {
    const auto at = std::ptrdiff_t(row) * dof;
    kept.t.push_back(rows.t[row]);
    kept.u.insert(kept.u.end(), rows.u.begin() + at, rows.u.begin() + at + dof);
    kept.v.insert(kept.v.end(), rows.v.begin() + at, rows.v.begin() + at + dof);
  }
  return kept;
}

class RightSolvers : public ::testing::TestWithParam<std::tuple<const char*, int>> {};

TEST_P(RightSolvers, ShowNoCause) {
  const std::string method = std::get<0>(GetParam());
  const auto problem = testing::assorted_cases()[std::size_t(std::get<1>(GetParam()))];
  if (problem.problem.contacts.empty() && method.starts_with("moreau")) return;
  std::vector<model::Trajectory> runs;
  std::vector<double> steps;
  for (const double n : {400.0, 640.0, 1600.0}) {
    steps.push_back(problem.problem.end / n);
    runs.push_back(testing::run(method, problem.problem, steps.back()));
  }
  for (const int digits : {17, 9, 4})
    for (const std::size_t stride : {1u, 5u}) {
      Files files{problem};
      for (std::size_t i = 0; i < runs.size(); ++i) {
        auto rows = every(runs[i], stride);
        testing::print(rows, digits);
        if (digits == 9) rows.v.clear();
        files.add(rows, testing::facts_of(problem, rows, steps[i], digits));
      }
      for (const auto& cause : file_causes(files.question())) {
        const bool limits =
            files.ladder.back().runs[0].u_error < 3.0 * files.histories.back().facts.floor;
        EXPECT_TRUE(cause.code == "printed-digits" && limits)
            << method << ' ' << digits << ' ' << stride << ' ' << cause.code << ' ' << cause.value
            << ' ' << cause.text;
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, RightSolvers,
                         ::testing::Combine(::testing::Values("newmark", "rk4", "newmark+reversal",
                                                              "moreau-jean", "moreau-jean:theta=1",
                                                              "generalized-alpha:rho=0.5",
                                                              "newmark:gamma=0.6,beta=0.31"),
                                            ::testing::Range(0, 10)));

// Another restitution, stiffness, mass or damping is no matter of the file.
TEST(RightSolversOfAnotherSystem, ShowNoCause) {
  const auto changes = std::vector<void (*)(model::ImpactProblem<>&)>{
      [](model::ImpactProblem<>& p) {
        for (auto& contact : p.contacts) contact.restitution *= 0.9;
      },
      [](model::ImpactProblem<>& p) { p.system.stiffness *= 1.01; },
      [](model::ImpactProblem<>& p) { p.system.mass(0, 0) *= 0.97; },
      [](model::ImpactProblem<>& p) { p.system.damping.setZero(); },
  };
  for (const auto& problem : testing::assorted_cases())
    for (const auto change : changes) {
      auto other = problem.problem;
      change(other);
      Files files{problem};
      for (const double n : {400.0, 1000.0})
        files.add(testing::run("rk4", other, other.end / n), other.end / n);
      for (const auto& cause : file_causes(files.question()))
        ADD_FAILURE() << problem.entry->name << ' ' << cause.code << ' ' << cause.text;
    }
}

}  // namespace
}  // namespace clackers::diagnose
