#include "clackers/methods/stepping/step_powers.hpp"

#include <cmath>

#include "clackers/methods/testing/runs.hpp"
#include "clackers/methods/testing/stepper_checks.hpp"
#include "clackers/numerics/testing/forced_target.hpp"

namespace clackers::methods {
namespace {

using numerics::simd::ForcedTarget;

struct Table {
  StepPowers powers;
  std::vector<double> x;
};

// Powers of rotations by h, one a mass, that are coupled a little; `a` follows from u.
Table rotations(std::size_t dof, std::size_t size, double h) {
  Table table;
  table.powers.resize(dof, size);
  for (std::size_t k = 1; k <= StepPowers::steps; ++k)
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) {
        const double turn = double(k) * h;
        double x = 1e-3 * std::sin(double(i + 3 * j)) * turn;
        if (i < 2 * dof && i % dof == j % dof && j < 2 * dof)
          x = i == j ? std::cos(turn) : (i < j ? 1.0 : -1.0) * std::sin(turn);
        if (i >= 2 * dof && j == i - 2 * dof) x = -std::cos(turn);
        table.powers.entry(k, i, j) = x;
      }
  for (std::size_t i = 0; i < size; ++i) table.x.push_back(std::cos(double(i)));
  return table;
}

Gaps stop_at(std::size_t dof, double gap) {
  std::vector<model::Contact<>> contacts{{Eigen::VectorXd::Zero(Eigen::Index(dof)), gap, 1.0}};
  contacts[0].direction[0] = 1.0;
  if (dof > 1) contacts[0].direction[1] = -0.25;
  return Gaps(contacts);
}

struct Path {
  std::vector<double> x, u, v;
  std::size_t made;
  bool operator==(const Path&) const = default;
};

Path path_of(std::size_t dof, std::size_t size, std::size_t most = 400) {
  auto [powers, x] = rotations(dof, size, 0.01);
  Path path{x, std::vector<double>(dof * most), std::vector<double>(dof * most), 0};
  path.made = powers.advance(path.x, stop_at(dof, -0.5), 0.01, most, path.u.data(), path.v.data());
  path.u.resize(dof * path.made);
  path.v.resize(dof * path.made);
  return path;
}

constexpr std::pair<std::size_t, std::size_t> sizes[] = {{1, 2}, {1, 3}, {2, 4},
                                                         {2, 6}, {3, 6}, {3, 9}};

TEST(StepPowers, HaveTheSameBitsInVectorsOfAllLengths) {
  for (const auto& [dof, size] : sizes) {
    const auto known = path_of(dof, size);
    EXPECT_GT(known.made, 2 * StepPowers::steps);
    for (const auto& target : numerics::simd::available_targets()) {
      const ForcedTarget forced(target);
      EXPECT_EQ(path_of(dof, size), known) << target.name() << ' ' << dof << ' ' << size;
    }
  }
}

TEST(StepPowers, EndBeforeTheFirstStepWhoseGapMayClose) {
  for (const auto& [dof, size] : sizes) {
    SCOPED_TRACE(testing::Message() << dof << ' ' << size);
    const auto path = path_of(dof, size);
    ASSERT_LT(path.made, 392u);
    EXPECT_NE(path.made % StepPowers::steps, 0u);
    for (std::size_t k = 0; k < path.made; ++k) {
      const double *u = &path.u[k * dof], *v = &path.v[k * dof];
      const double gap = u[0] - (dof > 1 ? 0.25 * u[1] : 0.0) + 0.5;
      const double rate = v[0] - (dof > 1 ? 0.25 * v[1] : 0.0);
      EXPECT_GE(gap, 0.01 / 3.0 * std::abs(rate)) << k;
    }
    // From the state reached there no step is made.
    auto next = rotations(dof, size, 0.01);
    next.x = path.x;
    std::vector<double> u(8 * dof), v(u);
    EXPECT_EQ(next.powers.advance(next.x, stop_at(dof, -0.5), 0.01, 8, u.data(), v.data()), 0u);
    EXPECT_TRUE(std::equal(path.x.begin(), path.x.begin() + long(dof), path.u.end() - long(dof)));
  }
}

TEST(StepPowers, AreNotUsedForStatesThatAreNoNumbers) {
  auto [powers, x] = rotations(1, 2, 0.01);
  x[1] = std::nan("");
  std::vector<double> u(8), v(8);
  EXPECT_EQ(powers.advance(x, stop_at(1, -9.0), 0.01, 8, u.data(), v.data()), 0u);
}

// Two masses between walls and each other: contacts that are coupled.
model::ImpactProblem<> pair_between_walls() {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::Vector2d(1.0, 1.7).asDiagonal();
  p.system.stiffness = (Eigen::Matrix2d() << 3.0, -1.0, -1.0, 2.0).finished();
  p.system.damping = 0.01 * p.system.stiffness;
  p.contacts = {{Eigen::Vector2d(1.0, -1.0), 0.0, 0.9},
                {Eigen::Vector2d(-1.0, 0.0), -1.5, 1.0},
                {Eigen::Vector2d(0.0, 1.0), -0.9, 0.8}};
  p.start = {0.0, Eigen::Vector2d(1.0, -0.2), Eigen::Vector2d(0.3, -1.0)};
  p.end = 30.0;
  return p;
}

model::ImpactProblem<> unit_chain(Eigen::Index n) {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::MatrixXd::Identity(n, n);
  p.system.stiffness = 2.0 * Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i + 1 < n; ++i)
    p.system.stiffness(i, i + 1) = p.system.stiffness(i + 1, i) = -1.0;
  p.system.damping = 0.01 * p.system.stiffness;
  for (Eigen::Index i = 0; i + 1 < n; i += 2)
    p.contacts.push_back(model::contact_between(n, i, i + 1, 0.9));
  p.start = {0.0, Eigen::VectorXd::LinSpaced(n, 1.0, 0.0),
             Eigen::VectorXd::LinSpaced(n, 0.0, -1.0)};
  p.end = 30.0;
  return p;
}

// A load of 0 keeps the powers away. Measured over 3000 steps: at most 1.5e-13 of the amplitudes. The penalty of
// the pair is too stiff for the step.
TEST(StepPowers, MakeTheStepsOfEveryIntegratorAndTreatment) {
  auto soft = runs::RattlingMass{.eta = 0.9}.problem(31.0);
  soft.system.stiffness *= 1.21;
  for (const auto& problem : {soft, pair_between_walls(), unit_chain(3)})
    for (const auto& name : pairs()) {
      const auto chosen = method(name);
      const bool is_penalty = name.find("penalty") != std::string::npos;
      if (name.find('+') == std::string::npos || chosen->objection(problem) ||
          (is_penalty && problem.dof() > 1))
        continue;
      const bool is_multistep =
          name.starts_with("bdf") || name.starts_with("houbolt") || name.starts_with("park");
      SCOPED_TRACE(testing::Message() << name << " dof " << problem.dof());
      auto loaded = problem;
      loaded.system.add_load = [](double, std::span<double>) {};
      const auto [fast, outcome] = runs::run(name, problem, 0.01);
      const auto [slow, other] = runs::run(name, loaded, 0.01);
      ASSERT_TRUE(outcome.finished && other.finished) << outcome.detail;
      ASSERT_EQ(fast.t, slow.t);
      EXPECT_EQ(fast.impacts->size(), slow.impacts->size());
      if (!is_multistep && !chosen->facts().is_adaptive) {
        EXPECT_NE(fast.u, slow.u);
      }
      EXPECT_EQ(outcome.work.steps, other.work.steps);
      double worst = 0.0;
      for (std::size_t i = 0; i < fast.u.size(); ++i)
        worst = std::max(worst, std::abs(fast.u[i] - slow.u[i]));
      EXPECT_LT(worst, 1e-12);
    }
}

}  // namespace
}  // namespace clackers::methods
