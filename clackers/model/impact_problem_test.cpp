#include "clackers/model/impact_problem.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "clackers/base/constants.hpp"
#include "clackers/base/testing/refusal.hpp"

namespace clackers::model {
namespace {

ImpactProblem<> sound() {
  ImpactProblem<> p;
  p.system.mass = Eigen::MatrixXd(2, 2);
  p.system.mass << 2.0, 0.5, 0.5, 1.0;
  p.system.damping = Eigen::MatrixXd::Zero(2, 2);
  p.system.stiffness = Eigen::Vector2d(1.0, -3.0).asDiagonal();  // may be indefinite
  p.contacts = {{Eigen::Vector2d(1.0, -1.0), 0.25, 0.5}};
  p.start = {1.0, Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(-1.0, 0.0)};
  p.end = 2.0;
  return p;
}

struct Refusal {
  const char* code;
  const char* words;  // somewhere in the message
  std::function<void(ImpactProblem<>&)> spoil;
};

const std::vector<Refusal> refusals = {
    {"wrong-size", "empty", [](auto& p) { p.system.mass.resize(0, 0); }},
    {"wrong-size", "mass has 2 x 1", [](auto& p) { p.system.mass.resize(2, 1); }},
    {"wrong-size", "damping has 1 x 2", [](auto& p) { p.system.damping.setZero(1, 2); }},
    {"wrong-size", "stiffness has 3 x 3", [](auto& p) { p.system.stiffness.setZero(3, 3); }},
    {"wrong-size", "start u", [](auto& p) { p.start.u.setZero(3); }},
    {"wrong-size", "start v", [](auto& p) { p.start.v.resize(0); }},
    {"wrong-size", "contact 1 direction", [](auto& p) { p.contacts[0].direction.setOnes(1); }},
    {"not-finite", "mass(2,2)", [](auto& p) { p.system.mass(1, 1) = infinity; }},
    {"not-a-number", "damping(1,1)", [](auto& p) { p.system.damping(0, 0) = nan; }},
    {"not-a-number", "stiffness(2,1)", [](auto& p) { p.system.stiffness(1, 0) = nan; }},
    {"not-a-number", "start u[2]", [](auto& p) { p.start.u[1] = nan; }},
    {"not-finite", "start v[1]", [](auto& p) { p.start.v[0] = -infinity; }},
    {"not-a-number", "start", [](auto& p) { p.start.t = nan; }},
    {"not-finite", "end", [](auto& p) { p.end = infinity; }},
    {"not-a-number", "gap", [](auto& p) { p.contacts[0].gap = nan; }},
    {"not-finite", "contact 1 direction[2]",
     [](auto& p) { p.contacts[0].direction[1] = infinity; }},
    {"not-positive-definite", "mass(1,2) = 0.6", [](auto& p) { p.system.mass(0, 1) = 0.6; }},
    {"not-positive-definite", "not positive definite",
     [](auto& p) { p.system.mass(1, 1) = 0.125; }},
    {"not-positive-definite", "not positive definite", [](auto& p) { p.system.mass(0, 0) = -1.0; }},
    {"not-symmetric", "damping(1,2)",
     [](auto& p) {
       p.system.damping(0, 1) = 1e-9;
       p.system.damping(0, 0) = 1;
     }},
    {"not-symmetric", "stiffness(1,2)", [](auto& p) { p.system.stiffness(1, 0) = 1.0; }},
    {"out-of-range", "direction = 0", [](auto& p) { p.contacts[0].direction.setZero(); }},
    {"out-of-range", "0 <= restitution <= 1", [](auto& p) { p.contacts[0].restitution = 1.1; }},
    {"out-of-range", "0 <= restitution <= 1", [](auto& p) { p.contacts[0].restitution = -0.1; }},
    {"not-a-number", "restitution", [](auto& p) { p.contacts[0].restitution = nan; }},
    {"starts-in-contact", "contact 1: at the start its gap is -0.75",
     [](auto& p) { p.contacts[0].gap = 1.75; }},
    {"starts-in-contact", "changing by -1 m/s", [](auto& p) { p.contacts[0].gap = 1.0; }},
    {"out-of-range", "end > start = 1", [](auto& p) { p.end = 1.0; }},
};

TEST(ImpactProblem, RefusesWhatIsUnsoundInWords) {
  EXPECT_NO_THROW(validate(sound()));
  for (const auto& refusal : refusals) {
    auto problem = sound();
    refusal.spoil(problem);
    EXPECT_REFUSED(validate(problem), refusal.code, refusal.words);
  }
}

TEST(ImpactProblem, MayStartOnAContactThatDoesNotClose) {
  auto problem = sound();
  problem.contacts[0].gap = 1.0;
  for (const double v : {0.0, 1.0}) {
    problem.start.v[0] = v;
    EXPECT_NO_THROW(validate(problem)) << v;
  }
}

TEST(ImpactProblem, TakesTheRoundingOfAProductForSymmetric) {
  auto problem = sound();
  problem.system.stiffness(0, 1) = 3.0;
  problem.system.stiffness(1, 0) = 3.0 * (1.0 + 0x1p-50);
  EXPECT_NO_THROW(validate(problem));
}

TEST(ImpactProblem, IsTheSameWithItsSizeKnown) {
  auto problem = sound();
  problem.system.add_load = [](double t, std::span<double> f) { f[1] += t; };
  const auto two = with_dof<2>(problem);
  EXPECT_EQ(two.system.mass, problem.system.mass);
  EXPECT_EQ(two.system.damping, problem.system.damping);
  EXPECT_EQ(two.system.stiffness, problem.system.stiffness);
  double f[2] = {0.0, 1.0};
  two.system.add_load(2.5, f);
  EXPECT_EQ(f[1], 3.5);
  ASSERT_EQ(two.contacts.size(), 1u);
  EXPECT_EQ(two.contacts[0].direction, problem.contacts[0].direction);
  EXPECT_EQ(two.contacts[0].gap, 0.25);
  EXPECT_EQ(two.contacts[0].restitution, 0.5);
  EXPECT_EQ(two.start.t, 1.0);
  EXPECT_EQ(two.start.u, problem.start.u);
  EXPECT_EQ(two.start.v, problem.start.v);
  EXPECT_EQ(two.end, 2.0);
  EXPECT_EQ(with_dof<any_dof>(problem).dof(), 2);
  EXPECT_THROW(with_dof<1>(problem), InputError);
}

struct Coupled : NonlinearForce<any_dof> {
  void add(const Vector<any_dof>& u, const Vector<any_dof>& v, Vector<any_dof>& p) const override {
    p[0] += u[0] * u[1];
    p[1] += v[0] * u[1];
  }
  void add_tangent(const Vector<any_dof>& u, const Vector<any_dof>& v, Matrix<any_dof>& dp_du,
                   Matrix<any_dof>& dp_dv) const override {
    dp_du(0, 0) += u[1];
    dp_du(0, 1) += u[0];
    dp_du(1, 1) += v[0];
    dp_dv(1, 0) += u[1];
  }
  double potential(const Vector<any_dof>& u) const override { return u[0] + 3.0 * u[1]; }
  bool has_kinks() const override { return true; }
};

TEST(ImpactProblem, ANonlinearForceTakesVectorsOfTheSize) {
  auto problem = sound();
  problem.system.nonlinear = std::make_shared<Coupled>();
  EXPECT_EQ(with_dof<any_dof>(problem).system.nonlinear, problem.system.nonlinear);
  const auto force = with_dof<2>(problem).system.nonlinear;
  const Vector<2> u(2.0, 3.0), v(5.0, 7.0);
  Vector<2> p(0.5, 0.25);
  force->add(u, v, p);
  EXPECT_EQ(p, (Vector<2>(6.5, 15.25)));
  Matrix<2> dp_du = Matrix<2>::Constant(1.0), dp_dv = Matrix<2>::Constant(-1.0);
  force->add_tangent(u, v, dp_du, dp_dv);
  EXPECT_EQ(dp_du, (Matrix<2>{{4.0, 3.0}, {1.0, 6.0}}));
  EXPECT_EQ(dp_dv, (Matrix<2>{{-1.0, -1.0}, {2.0, -1.0}}));
  EXPECT_EQ(force->potential(u), 11.0);
  EXPECT_TRUE(force->has_kinks());
  problem.system.nonlinear = nullptr;
  EXPECT_EQ(with_dof<2>(problem).system.nonlinear, nullptr);
}

TEST(Contact, OpensAlongItsRow) {
  const auto contact = sound().contacts[0];
  EXPECT_EQ(contact.gap_at(Eigen::Vector2d(3.0, 1.0)), 1.75);
  EXPECT_EQ(contact.gap_rate(Eigen::Vector2d(3.0, 1.0)), 2.0);
}

}  // namespace
}  // namespace clackers::model
