#include "clackers/methods/contact/contact_set.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <numeric>
#include <random>

namespace clackers::methods {
namespace {

using Set = ContactSet<model::any_dof>;
using Eigen::Index;

std::vector<std::size_t> all_of(const Set& contacts) {
  std::vector<std::size_t> rows(contacts.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return rows;
}

model::ImpactProblem<> problem_of(const Eigen::MatrixXd& mass,
                                  std::vector<model::Contact<>> contacts) {
  const auto n = mass.rows();
  model::ImpactProblem<> p;
  p.system = {mass, Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  p.contacts = std::move(contacts);
  p.start = {0.0, Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  p.end = 1.0;
  return p;
}

// Three masses, coupled by their mass matrix, and a stop.
model::ImpactProblem<> chain() {
  return problem_of((Eigen::Matrix3d() << 2, 0.5, 0, 0.5, 1, 0, 0, 0, 3).finished(),
                    {{Eigen::Vector3d(1, -1, 0), 0.0, 0.6},
                     {Eigen::Vector3d(0, 1, -1), 0.1, 1.0},
                     {Eigen::Vector3d(0, 0, 1), 0.0, 1.0}});
}

// Masses in a row that all touch; mass i is above mass i + 1.
model::ImpactProblem<> row(const Eigen::VectorXd& m, const Eigen::VectorXd& eta) {
  std::vector<model::Contact<>> contacts;
  for (Index i = 0; i + 1 < m.size(); ++i) {
    Eigen::VectorXd b = Eigen::VectorXd::Zero(m.size());
    b[i] = 1.0;
    b[i + 1] = -1.0;
    contacts.push_back({b, 0.0, eta[i]});
  }
  return problem_of(m.asDiagonal(), contacts);
}

// The second way, without a Delassus matrix: every set of contacts with an impulse is tried.
// Newton's law at these and the momentum of the masses between the others are n equations for the
// velocities.
Eigen::VectorXd by_enumeration(const Eigen::VectorXd& m, const Eigen::VectorXd& eta,
                               const Eigen::VectorXd& v) {
  const Index n = m.size();
  for (int set = 0; set < (1 << (n - 1)); ++set) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
    Index group = 0;  // the row for the momentum of the group that mass i belongs to
    for (Index i = 0; i < n; ++i) {
      a(group, i) = m[i];
      b[group] += m[i] * v[i];
      if (i + 1 == n) break;
      if (set >> i & 1) {
        a(i + 1, i) = 1.0;
        a(i + 1, i + 1) = -1.0;
        b[i + 1] = -eta[i] * (v[i] - v[i + 1]);
      } else {
        group = i + 1;
      }
    }
    const Eigen::VectorXd after = a.fullPivLu().solve(b);
    bool holds = true;
    double impulse = 0.0;  // on the masses above the contact
    for (Index i = 0; i + 1 < n; ++i) {
      impulse += m[i] * (after[i] - v[i]);
      holds &= impulse > -1e-12 && after[i] - after[i + 1] + eta[i] * (v[i] - v[i + 1]) > -1e-12;
    }
    if (holds) return after;
  }
  ADD_FAILURE() << "no set of contacts solves the impact";
  return v;
}

TEST(ContactSet, KnowsGapsRatesAndTheirRounding) {
  const Set contacts(chain());
  const Eigen::Vector3d u(9, 2, -3), v(1, 2, 4);
  EXPECT_EQ(contacts.gap(1, u), 4.9);
  EXPECT_EQ(contacts.gap_rate(1, v), -2.0);
  EXPECT_EQ(contacts.rounding(1, u), 8 * 0x1p-52 * (2 + 3 + 0.1));
  EXPECT_EQ(contacts.rate_rounding(1, v), 8 * 0x1p-52 * (2 + 4));
}

TEST(ContactSet, KnowsWhatImpulsesDo) {
  const auto problem = chain();
  const Set contacts(problem);
  Eigen::Matrix3d b;
  for (Index i = 0; i < 3; ++i) b.row(i) = problem.contacts[std::size_t(i)].direction;
  const Eigen::Matrix3d response = problem.system.mass.inverse() * b.transpose();
  EXPECT_LT((contacts.response().velocity - response).norm(), 1e-15);
  EXPECT_LT((contacts.response().delassus - b * response).norm(), 1e-15);
  EXPECT_NEAR(contacts.inverse_effective_mass(2), 1.0 / 3.0, 1e-16);
  EXPECT_TRUE(contacts.are_coupled(0, 1));
  EXPECT_TRUE(contacts.are_coupled(2, 1));
  EXPECT_FALSE(contacts.are_coupled(0, 2));

  const Eigen::MatrixXd effective = problem.system.mass + 0.3 * Eigen::Matrix3d::Ones();
  numerics::SpdSolver<model::any_dof> solver;
  ASSERT_TRUE(solver.compute(effective));
  ContactResponse<model::any_dof> other;
  contacts.respond(solver, other);
  EXPECT_LT((effective * other.velocity - b.transpose()).norm(), 1e-15 * 4);
  EXPECT_LT((other.delassus - b * other.velocity).norm(), 1e-15 * 4);
}

TEST(ContactSet, ReversesOneRateByItsRestitutionWithAnImpulseAlongTheRow) {
  const auto problem = chain();
  Set contacts(problem);
  const Eigen::VectorXd before = Eigen::Vector3d(-1.0, 0.5, 0.25);
  Eigen::VectorXd after = before;
  auto impulses = contacts.no_impulses();
  ASSERT_FALSE(contacts.impact(std::vector<std::size_t>{0}, after, impulses));
  const auto& b = problem.contacts[0].direction;
  EXPECT_NEAR(b.dot(after), -0.6 * b.dot(before), 1e-15);
  EXPECT_GT(impulses[0], 0.0);
  EXPECT_EQ(impulses.tail(2), Eigen::Vector2d(0, 0));
  EXPECT_LT((problem.system.mass * (after - before) - impulses[0] * b).norm(), 1e-15);
}

// Three equal masses, two of them touching at rest: what comes in is shared by both.
TEST(ContactSet, SharesTheMomentumAmongNeighboursAtRest) {
  Set contacts(row(Eigen::Vector3d::Ones(), Eigen::Vector2d::Ones()));
  Eigen::VectorXd v = Eigen::Vector3d(-1, 0, 0), impulses;
  ASSERT_FALSE(contacts.impact(all_of(contacts), v, impulses));
  EXPECT_LT((v - Eigen::Vector3d(1, -2, -2) / 3).norm(), 1e-15);
  EXPECT_LT((impulses - Eigen::Vector2d(4, 2) / 3).norm(), 1e-15);
}

// Rows of three and five masses whose contacts all close, or are at rest: momentum, energy and the
// second way.
TEST(ContactSet, SolvesSimultaneousImpactsAsEnumerationDoes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int trial = 0; trial < 300; ++trial) {
    const Index n = trial % 2 == 0 ? 3 : 5;
    Eigen::VectorXd m(n), v(n), eta(n - 1);
    for (auto& x : m) x = 0.2 + part(random);
    for (auto& x : eta) x = part(random);
    if (trial % 3 == 0) eta.setOnes();
    v[0] = part(random);
    for (Index i = 1; i < n; ++i) v[i] = v[i - 1] + (part(random) < 0.3 ? 0.0 : part(random));
    const auto problem = row(m, eta);
    Set contacts(problem);
    Eigen::VectorXd after = v, impulses;
    ASSERT_FALSE(contacts.impact(all_of(contacts), after, impulses));
    EXPECT_LT((after - by_enumeration(m, eta, v)).cwiseAbs().maxCoeff(), 1e-13) << trial;
    EXPECT_NEAR(m.dot(after), m.dot(v), 1e-14);
    const double loss = 0.5 * m.dot(v.cwiseAbs2() - after.cwiseAbs2());
    EXPECT_GT(loss, -1e-14);
    if (trial % 3 == 0) {
      EXPECT_NEAR(loss, 0.0, 1e-14);
    }
  }
}

// With a separating contact among them and different restitutions Newton's law may gain energy;
// with equal ones it does not.
TEST(ContactSet, MayGainEnergyOnlyWhereAContactThatSeparatesTakesPart) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  const auto gain = [&](bool is_equal) {
    double most = -1.0;
    for (int trial = 0; trial < 300; ++trial) {
      Eigen::Vector3d m, v;
      Eigen::Vector2d eta;
      for (auto& x : m) x = 0.2 + part(random);
      for (auto& x : v) x = part(random);
      for (auto& x : eta) x = part(random);
      if (is_equal) eta[1] = eta[0];
      Set contacts(row(m, eta));
      Eigen::VectorXd after = v, impulses;
      EXPECT_FALSE(contacts.impact(all_of(contacts), after, impulses));
      const double before = m.dot(v.cwiseAbs2());
      most = std::max(most, m.dot(after.cwiseAbs2()) / before - 1.0);
    }
    return most;
  };
  EXPECT_LT(gain(true), 1e-14);
  EXPECT_GT(gain(false), 0.01);
}

TEST(ContactSet, DoesNotDependOnTheNumbersOfTheContacts) {
  auto problem =
      row((Eigen::VectorXd(4) << 1.0, 0.3, 2.0, 0.7).finished(), Eigen::Vector3d(0.9, 0.2, 0.5));
  Set contacts(problem);
  const Eigen::VectorXd v = Eigen::Vector4d(-2.0, 0.0, 0.0, 1.5);
  Eigen::VectorXd first = v, impulses;
  ASSERT_FALSE(contacts.impact(all_of(contacts), first, impulses));
  std::vector<std::size_t> order{0, 1, 2};
  while (std::ranges::next_permutation(order).found) {
    auto permuted = problem;
    for (std::size_t i = 0; i < 3; ++i) permuted.contacts[i] = problem.contacts[order[i]];
    Set others(permuted);
    Eigen::VectorXd after = v, numbered;
    ASSERT_FALSE(others.impact(all_of(others), after, numbered));
    // Some roundings of numbers below 4.
    EXPECT_LT((after - first).cwiseAbs().maxCoeff(), 5e-15);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(numbered[Index(i)], impulses[Index(order[i])], 5e-15);
  }
}

TEST(ContactSet, NamesContactsThatDependOnEachOther) {
  auto problem = chain();
  problem.contacts.push_back({Eigen::Vector3d(1, 0, -1), 0.1, 0.5});  // the first two together
  Set contacts(problem);
  Eigen::VectorXd v = Eigen::Vector3d(-1, 0, 1), impulses;
  const auto before = v;
  const auto no = contacts.impact(all_of(contacts), v, impulses);
  ASSERT_TRUE(no);
  EXPECT_EQ(no->code, Code("redundant-contacts"));
  EXPECT_EQ(no->sentence,
            "contacts 1, 2 and 4 are closed together and their directions depend linearly on each "
            "other, so their impulses are not unique");
  EXPECT_EQ(v, before);
  EXPECT_FALSE(contacts.impact(std::vector<std::size_t>{0, 2, 3}, v, impulses));
}

TEST(ContactSet, ObjectsToRedundantContactsThatAreClosedAtTheStart) {
  auto problem = chain();
  problem.contacts.push_back({Eigen::Vector3d(-2, 2, 0), 0.0, 1.0});  // no room for mass 1
  problem.start.u = Eigen::Vector3d(2, 2, 1.9);
  problem.contacts[1].gap = 2 - 1.9;
  const auto no = objection_to_closed_contacts("who", problem);
  ASSERT_TRUE(no);
  EXPECT_EQ(no->code, Code("redundant-contacts"));
  EXPECT_EQ(no->sentence,
            "who: t = 0 s: contacts 1 and 4 are closed together and their directions depend "
            "linearly on each other, so their impulses are not unique. Start with one of them "
            "open, or remove it.");
  problem.contacts.pop_back();  // closed together and coupled
  EXPECT_FALSE(objection_to_closed_contacts("who", problem));
}

TEST(ContactSet, FindsNoImpulsesForWhatIsNoNumber) {
  Set contacts(chain());
  Eigen::VectorXd v = Eigen::Vector3d(NAN, 0, 0), impulses;
  const auto no = contacts.impact(all_of(contacts), v, impulses);
  ASSERT_TRUE(no);
  EXPECT_EQ(no->code, Code("complementarity-failed"));
}

}  // namespace
}  // namespace clackers::methods
