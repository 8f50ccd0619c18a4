#include "clackers/methods/stepping/step_powers.hpp"

#include <cmath>
#include <complex>

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

// Rotations by h, one a mass, that are coupled a little; `a` follows from u.
Table rotations(std::size_t dof, std::size_t size, double h) {
  Table table;
  const auto n = Eigen::Index(dof), all = Eigen::Index(size);
  Eigen::MatrixXd first(all, all);
  for (Eigen::Index i = 0; i < all; ++i)
    for (Eigen::Index j = 0; j < all; ++j) {
      double x = 1e-3 * std::sin(double(i + 3 * j)) * h;
      if (i < 2 * n && i % n == j % n && j < 2 * n)
        x = i == j ? std::cos(h) - 1.0 : (i < j ? 1.0 : -1.0) * std::sin(h);
      if (i >= 2 * n && j == i - 2 * n) x = -std::cos(h);
      first(i, j) = x;
    }
  table.powers.assign(dof, size, first);
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

// What the powers multiply is what a matrix with 1 added would, T_2 = T_1 J + J T_1 + T_1 T_1.
TEST(StepPowers, ActAsThePowersOfTheStep) {
  for (const auto& [dof, size] : sizes) {
    const auto n = Eigen::Index(dof), all = Eigen::Index(size);
    Eigen::MatrixXd step = 0.1 * Eigen::MatrixXd::Random(all, all);
    StepPowers powers;
    powers.assign(dof, size, step);
    step.diagonal().head(2 * n).array() += 1.0;
    const Eigen::VectorXd start = Eigen::VectorXd::LinSpaced(all, 1.0, 2.0);
    std::vector<double> x(start.data(), start.data() + all), u(8 * dof), v(u);
    ASSERT_EQ(powers.advance(x, stop_at(dof, -99.0), 0.01, 8, u.data(), v.data()), 8u);
    Eigen::VectorXd known = start;
    for (std::size_t k = 0; k < 8; ++k) {
      known = step * known;
      for (Eigen::Index i = 0; i < n; ++i) {
        EXPECT_NEAR(u[k * dof + std::size_t(i)], known[i], 1e-13);
        EXPECT_NEAR(v[k * dof + std::size_t(i)], known[n + i], 1e-13);
      }
    }
    EXPECT_NEAR(x.back(), known[all - 1], 1e-13);
  }
}

// u'' + u = 0 from u = 1, by h = 2^-11 over 40,000 steps: no displacement errs by more than the method does.
TEST(StepPowers, RoundingsOfTheStepDoNotAddUp) {
  auto problem = runs::mass_on_stop(1.0, 0.0, 1.0, 1.0, 0.0, 1.0, 40000 * 0x1p-11);
  problem.contacts[0].gap = -9.0;
  const auto worst = [&](const std::string& name, auto&& known) {
    const auto path = runs::run(name, problem, 0x1p-11).trajectory;
    double error = 0.0;
    for (std::size_t i = 0; i < path.t.size(); ++i)
      error = std::max(error, double(std::abs((long double)(path.u[i]) - known(i))));
    return error;
  };
  const long double h = 0x1p-11L;
  const auto exact = [&](std::size_t i) { return std::cos((long double)(i)*h); };
  for (const auto* name : {"exponential", "precise-integration", "radau-iia-5"})
    EXPECT_LT(worst(name, exact), 1e-14) << name;
  // Its growth a step is 1 - h²/2 + h⁴/24 + i (h - h³/6), that of newmark (1 + i h/2) / (1 - i h/2).
  const std::complex<long double> of_rk4(1 - h * h / 2 + h * h * h * h / 24, h - h * h * h / 6),
      up(1, h / 2), of_newmark = up / std::conj(up);
  for (const auto& [name, growth] : {std::pair("rk4", of_rk4), std::pair("newmark", of_newmark),
                                     std::pair("generalized-alpha:rho=1", of_newmark)}) {
    const auto log_growth = std::log(growth);
    EXPECT_LT(
        worst(name, [&](std::size_t i) { return std::exp((long double)(i)*log_growth).real(); }),
        3e-14)
        << name;
  }
}

// Backward differences of y = u - i v, y' = i y, from the first states of the run.
TEST(StepPowers, RoundingsOfMultistepMethodsDoNotAddUp) {
  using Complex = std::complex<long double>;
  auto problem = runs::mass_on_stop(1.0, 0.0, 1.0, 1.0, 0.0, 1.0, 40000 * 0x1p-11);
  problem.contacts[0].gap = -9.0;
  auto loaded = problem;
  loaded.system.add_load = [](double, std::span<double>) {};
  const std::vector<std::vector<long double>> formulas{
      {3.0L / 2, -2, 1.0L / 2},
      {25.0L / 12, -4, 3, -4.0L / 3, 1.0L / 4},
      {147.0L / 60, -6, 15.0L / 2, -20.0L / 3, 15.0L / 4, -6.0L / 5, 1.0L / 6}};
  for (const auto& d : formulas) {
    const auto name = "bdf" + std::to_string(d.size() - 1);
    const auto [path, outcome] = runs::run(name, problem, 0x1p-11);
    EXPECT_EQ(outcome.work.force_evaluations,
              runs::run(name, loaded, 0x1p-11).outcome.work.force_evaluations);
    std::vector<Complex> y;
    long double error = 0.0L;
    for (std::size_t i = 0; i < path.t.size(); ++i) {
      Complex sum;
      for (std::size_t m = 1; m < d.size() && i >= d.size(); ++m) sum -= d[m] * y[i - m];
      y.push_back(i < d.size() ? Complex(path.u[i], -path.v[i])
                               : sum / (d[0] - Complex(0, 0x1p-11L)));
      error = std::max(error, std::abs(y.back().real() - (long double)(path.u[i])));
    }
    EXPECT_LT(double(error), 1e-13) << name;  // single steps: 1.3e-12, 7.6e-12, 3.7e-13
  }
}

// A load of 0 keeps the powers away. Measured over 3000 steps: at most 1.2e-13 of the amplitudes, of multistep methods
// 3.8e-12, the roundings of their single steps. The penalty of the pair is too stiff for the step.
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
      SCOPED_TRACE(testing::Message() << name << " dof " << problem.dof());
      auto loaded = problem;
      loaded.system.add_load = [](double, std::span<double>) {};
      const auto [fast, outcome] = runs::run(name, problem, 0.01);
      const auto [slow, other] = runs::run(name, loaded, 0.01);
      ASSERT_TRUE(outcome.finished && other.finished) << outcome.detail;
      ASSERT_EQ(fast.t, slow.t);
      EXPECT_EQ(fast.impacts->size(), slow.impacts->size());
      if (!chosen->facts().is_adaptive) {
        EXPECT_NE(fast.u, slow.u);
      }
      EXPECT_EQ(outcome.work.steps, other.work.steps);
      double worst = 0.0;
      for (std::size_t i = 0; i < fast.u.size(); ++i)
        worst = std::max(worst, std::abs(fast.u[i] - slow.u[i]));
      const bool is_multistep = name.starts_with("bdf") || name.starts_with("houbolt");
      EXPECT_LT(worst, is_multistep ? 5e-12 : 5e-13);
    }
}

}  // namespace
}  // namespace clackers::methods
