// What all time-stepping schemes do at impacts.

#include "clackers/methods/timestepping/stepping_scheme.hpp"

#include "clackers/base/testing/refusal.hpp"
#include "clackers/methods/testing/runs.hpp"
#include "clackers/methods/testing/stepper_checks.hpp"

namespace clackers::methods {
namespace {

using runs::mass_on_stop;
using runs::run;

// Impacts but for those of rounding, of masses that stay together.
std::vector<model::Impact> impacts(const model::Trajectory& path) {
  auto all = *path.impacts;
  std::erase_if(all, [](const auto& impact) { return impact.impulse < 1e-9; });
  return all;
}

class Scheme : public testing::TestWithParam<std::string> {
 protected:
  std::string name = GetParam();
  bool has_law(double eta) const {
    return !method(name)->objection(mass_on_stop(1.0, 0.0, 0.0, 1.0, -1.0, eta, 1.0)) &&
           converges(method(name)->facts().through_impacts.behaviour);
  }
};

TEST_P(Scheme, OneImpactObeysTheLawOfRestitution) {
  for (const double eta : {0.0, 0.5, 1.0}) {
    if (!has_law(eta)) continue;
    for (const double u : {1.01, 1.037, 1.05, 1.099}) {
      const double h = 0.1;
      const auto [path, outcome] = run(name, mass_on_stop(2.0, 0.0, 0.0, u, -1.0, eta, 2.0), h);
      EXPECT_NEAR(path.v.back(), eta, 1e-13);
      const auto found = impacts(path);
      ASSERT_EQ(found.size(), 1u);
      EXPECT_NEAR(found[0].impulse, 2.0 * (1.0 + eta), 1e-13);
      EXPECT_NEAR(found[0].v_before[0], -1.0, 1e-13);
      EXPECT_NEAR(found[0].v_after[0], eta, 1e-13);
      EXPECT_NEAR(found[0].t, u, 2.5 * h);
      for (const double g : path.u) EXPECT_GE(g, -1.01 * h);
      if (eta > 0.0 && name != "d1-minus") {  // one evaluation a step, one more in an impact
        EXPECT_LE(outcome.work.force_evaluations, 20 + 1 + 2);
        EXPECT_LE(outcome.work.factorizations, 1);
      }
    }
  }
}

// A load presses the mass on its stop. Where the law is one of velocities, every impact obeys it, the
// last ones of a row as well; the penetration is at most the motion of some steps.
TEST_P(Scheme, APressedContactObeysTheLawAtEachImpact) {
  const bool is_of_displacements = name == "paoli-schatzman" || name.starts_with("forward");
  for (const double eta : {0.0, 0.5, 1.0}) {
    if (!has_law(eta)) continue;
    auto p = mass_on_stop(1.0, 0.1, 0.5, 1.0, 0.0, eta, 8.0);
    p.system.add_load = [](double, std::span<double> f) { f[0] -= 1.0; };
    const double h = 0.0173;
    const auto [path, outcome] = run(name, p, h);
    EXPECT_TRUE(outcome.finished) << outcome.detail;
    EXPECT_GE(path.impacts->size(), 1u);
    for (const auto& impact : *path.impacts)
      if (!is_of_displacements) {
        EXPECT_NEAR(impact.v_after[0], -eta * impact.v_before[0], 1e-12);
      }
    for (const double u : path.u) EXPECT_GT(u, -3.0 * h);
  }
}

// Three free masses, the outer ones arriving at the middle one at the same time.
model::ImpactProblem<> row(double eta) {
  model::ImpactProblem<> p;
  p.system.mass = Eigen::Vector3d(1.0, 2.0, 1.0).asDiagonal();
  p.system.damping = p.system.stiffness = Eigen::Matrix3d::Zero();
  p.contacts = {{Eigen::Vector3d(1, -1, 0), 0.0, eta}, {Eigen::Vector3d(0, 1, -1), 0.0, eta}};
  p.start = {0.0, Eigen::Vector3d(1.04, 0, -1.04), Eigen::Vector3d(-1, 0, 1)};
  p.end = 2.0;
  return p;
}

TEST_P(Scheme, SimultaneousContactsThatShareAMassObeyTheLaw) {
  for (const double eta : {0.0, 0.5, 1.0}) {
    if (!has_law(eta)) continue;
    const auto [path, outcome] = run(name, row(eta), 0.1);
    ASSERT_TRUE(outcome.finished) << outcome.detail;
    const auto end = path.v.size() - 3;
    EXPECT_NEAR(path.v[end], eta, 1e-13);
    EXPECT_NEAR(path.v[end + 1], 0.0, 1e-13);
    EXPECT_NEAR(path.v[end + 2], -eta, 1e-13);
    EXPECT_EQ(impacts(path).size(), 2u);
  }
}

// Elastic and damped, loaded, stuck together and apart: in either numbering.
TEST_P(Scheme, TheNumbersOfTheContactsDoNotMatter) {
  for (const double eta : {0.0, 0.5, 1.0}) {
    auto p = row(eta);
    p.system.stiffness = Eigen::Vector3d(1.0, 3.0, 7.0).asDiagonal();
    p.system.damping = 0.1 * Eigen::Matrix3d::Ones();
    p.system.add_load = [](double t, std::span<double> f) {
      f[0] -= 1.0;
      f[2] += 1.0 + std::sin(t);
    };
    p.contacts.push_back({Eigen::Vector3d(0, 0, 1), -1.5, eta});
    if (method(name)->objection(p)) continue;
    const auto one = run(name, p, 0.05);
    std::rotate(p.contacts.begin(), p.contacts.begin() + 1, p.contacts.end());
    const auto other = run(name, p, 0.05);
    ASSERT_TRUE(one.outcome.finished) << one.outcome.detail;
    ASSERT_EQ(one.trajectory.t, other.trajectory.t);
    EXPECT_GE(one.trajectory.impacts->size(), 3u);
    for (std::size_t k = 0; k < one.trajectory.u.size(); ++k)
      EXPECT_NEAR(one.trajectory.u[k], other.trajectory.u[k], 1e-9);
  }
}

TEST_P(Scheme, RedundantContactsEndTheRunOrAreRefused) {
  for (const double eta : {0.0, 0.5, 1.0}) {
    auto p = mass_on_stop(1.0, 0.0, 1.0, 1.03, -1.0, eta, 4.0);
    p.contacts.push_back(p.contacts.front());
    if (method(name)->objection(p)) continue;
    const auto outcome = run(name, p, 0.1).outcome;
    p.start.u[0] = 0.0;
    p.start.v[0] = 1.0;
    if (name == "augmented-lagrangian") {  // its iteration finds one of the solutions
      EXPECT_TRUE(outcome.finished);
      EXPECT_FALSE(method(name)->objection(p));
      continue;
    }
    EXPECT_EQ(outcome.reason, Code("redundant-contacts")) << outcome.detail;
    EXPECT_EQ(outcome.detail.find(name + ": t = "), 0u) << outcome.detail;
    EXPECT_REFUSED(method(name)->prepare(p, 0.1), "redundant-contacts", name);
  }
}

// A run may be repeated, also one that was cut in an impact or has failed.
TEST_P(Scheme, ARepeatedRunIsTheSame) {
  for (const double eta : {0.0, 0.5, 1.0}) {
    auto p = mass_on_stop(1.0, 0.1, 1.0, 1.03, -1.0, eta, 4.05);
    if (method(name)->objection(p)) continue;
    const auto fresh = run(name, p, 0.1);
    const auto prepared = method(name)->prepare(p, 0.1);
    for (double cut : {0.5, 0.7, 0.8, 0.9, 1.0, 1.1}) {
      struct Cut : model::TrajectorySink {
        double at;
        explicit Cut(double t) : TrajectorySink(true), at(t) {}
        bool take(const model::SampleBlock& block) override { return block.t.back() < at; }
      } stopped(cut);
      prepared->advance(stopped);
      model::TrajectorySink sink(true);
      const auto outcome = prepared->advance(sink);
      EXPECT_EQ(sink.trajectory().u, fresh.trajectory.u);
      EXPECT_EQ(sink.trajectory().v, fresh.trajectory.v);
      EXPECT_EQ(sink.trajectory().impacts->size(), fresh.trajectory.impacts->size());
      EXPECT_EQ(outcome.work.force_evaluations, fresh.outcome.work.force_evaluations);
    }
    p.contacts.push_back(p.contacts.front());
    const auto failing = method(name)->prepare(p, 0.1);
    model::TrajectorySink one(true), two(true);
    const auto first = failing->advance(one), second = failing->advance(two);
    EXPECT_EQ(first.detail, second.detail);
    EXPECT_EQ(one.trajectory().t, two.trajectory().t);
  }
}

// Two walls have opposite directions; that is no obstacle as long as one of them is open.
TEST_P(Scheme, AMassBetweenTwoWallsRuns) {
  for (const double eta : {0.0, 0.5, 1.0}) {
    auto p = mass_on_stop(1.0, 0.0, 0.0, 0.53, -1.0, eta, 4.2);
    p.contacts.push_back({Eigen::VectorXd::Constant(1, -1.0), -1.0, eta});
    if (!has_law(eta)) continue;
    const auto [path, outcome] = run(name, p, 0.1);
    ASSERT_TRUE(outcome.finished) << outcome.detail;
    EXPECT_EQ(impacts(path).size(), eta == 1.0 ? 4u : eta == 0.5 ? 2u : 1u);
  }
}

// A force that turns the velocity back to -1 from either side and jumps there: no velocity is in
// balance.
struct Jump : model::NonlinearForce<model::any_dof> {
  using Vector = model::Vector<model::any_dof>;
  using Matrix = model::Matrix<model::any_dof>;
  void add(const Vector&, const Vector& v, Vector& p) const override {
    p[0] += v[0] > -1.0 ? 50.0 : -50.0;
  }
  void add_tangent(const Vector&, const Vector&, Matrix&, Matrix&) const override {}
};

TEST_P(Scheme, AStepWithoutSolutionEndsTheRun) {
  auto p = mass_on_stop(1.0, 0.0, 0.0, 1.0, -1.0, 1.0, 1.0);
  if (!has_law(1.0)) p.contacts.front().restitution = 0.0;
  if (method(name)->objection(p)) p.contacts.front().restitution = 1.0;
  p.system.nonlinear = std::make_shared<Jump>();
  const auto outcome = run(name, p, 0.1).outcome;
  if (name == "d1-minus") return;  // solves no equation
  EXPECT_EQ(outcome.reason, Code("newton-failed")) << outcome.detail;
}

TEST_P(Scheme, AMotionThatGrowsWithoutBoundDiverges) {
  auto p = mass_on_stop(1.0, -50.0, 1.0, 1.0, -1.0, 1.0, 100.0);
  if (method(name)->objection(p)) p.contacts.front().restitution = 0.0;
  const auto outcome = run(name, p, 0.01).outcome;
  EXPECT_EQ(outcome.reason, Code("diverged")) << outcome.detail;
  // Also where it would close the contact.
  p.system.damping(0, 0) = 0.0;
  p.system.add_load = [](double t, std::span<double> f) { f[0] -= t > 2.0 ? INFINITY : 0.0; };
  EXPECT_EQ(run(name, p, 0.01).outcome.reason, Code("diverged"));
}

INSTANTIATE_TEST_SUITE_P(Names, Scheme,
                         testing::Values("paoli-schatzman", "cd-lagrange", "d1-minus",
                                         "forward-increment-lagrange", "augmented-lagrangian",
                                         "nonsmooth-generalized-alpha",
                                         "newmark-position-multiplier", "newmark-implicit-contact",
                                         "moreau-jean", "moreau-jean:theta=1"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::ranges::replace_if(
                               name, [](unsigned char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

}  // namespace
}  // namespace clackers::methods
