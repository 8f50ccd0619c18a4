#include "clackers/exact/quantities/sensitivity.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "clackers/base/error.hpp"
#include "clackers/exact/testing/test_members.hpp"

namespace clackers::exact {
namespace {

using model::Side;
using namespace testing_oracle;

const std::vector<std::string> twelve{"m1",  "m2",  "k1",  "k2",  "c1",  "c2",
                                      "eta", "gap", "u10", "u20", "v10", "v20"};

Real& member(RawPair& p, const std::string& name) {
  const std::vector<Real*> all{&p.m1,  &p.m2,  &p.k1,  &p.k2,  &p.c1,  &p.c2,
                               &p.eta, &p.gap, &p.u10, &p.u20, &p.v10, &p.v20};
  const auto at = std::find(twelve.begin(), twelve.end(), name) - twelve.begin();
  return *all.at(static_cast<std::size_t>(at));
}

// (state at p + h - state at p - h) / 2h of a simulation, its error of order h^2 = 1e-50.
std::vector<RawState> difference(const std::function<RawPair(const Real&)>& change,
                                 const Real& size, const std::vector<Real>& times) {
  const Real h = size * Real("1e-25");
  auto up = simulate(change(h), times);
  const auto down = simulate(change(-h), times);
  for (std::size_t k = 0; k < times.size(); ++k)
    for (std::size_t i = 0; i < 2; ++i) {
      up[k].u[i] = (up[k].u[i] - down[k].u[i]) / (2 * h);
      up[k].v[i] = (up[k].v[i] - down[k].v[i]) / (2 * h);
      up[k].a[i] = (up[k].a[i] - down[k].a[i]) / (2 * h);
    }
  return up;
}

constexpr std::size_t in_a_flight = 4;

// Four times in each flight: times[4 k ... 4 k + 3] lie in flight k.
std::vector<double> times_of(const ClosedForm& motion, double period) {
  std::vector<double> times;
  for (int k = 0; (k + 0.5) * period < motion.end(); ++k)
    for (const double part : {0.04, 0.3, 0.6, 0.93})
      times.push_back(k == 0 ? 0.5 * part * period : (k - 0.5 + part) * period);
  return times;
}

// The bounds that sensitivity.hpp promises; 1e-45 is the simulation's.
void expect_derivative(const Sensitivity& found, const ClosedForm& motion,
                       const std::vector<double>& times, const std::vector<RawState>& reference) {
  const auto near = [&](const char* what, std::size_t k, const Real& expected, double value,
                        const Real& bound) {
    EXPECT_LE(abs(expected - Real(value)), bound + Real(1e-45))
        << what << " t " << times[k] << " found " << value << " true " << expected;
  };
  const auto system = motion.problem().system;
  for (std::size_t start = 0; start < times.size(); start += in_a_flight) {
    Real u = 0, v = 0, a[2] = {0, 0};
    for (std::size_t k = start; k < start + in_a_flight; ++k)
      for (std::size_t i = 0; i < 2; ++i) {
        u = std::max(u, Real(abs(reference[k].u[i])));
        v = std::max(v, Real(abs(reference[k].v[i])));
        a[i] = std::max(a[i], Real(abs(reference[k].a[i])));
      }
    for (Eigen::Index i = 0; i < motion.dof(); ++i) {
      const auto at = std::size_t(i);
      const double omega = std::sqrt(system.stiffness(i, i) / system.mass(i, i));
      const Real S = 1e-13 * (u + v / omega);
      for (std::size_t k = start; k < start + in_a_flight; ++k) {
        const auto d = found.at(times[k], Side::right);
        near("u", k, reference[k].u[at], d.u[i], S);
        near("v", k, reference[k].v[at], d.v[i], omega * S);
        near("a", k, reference[k].a[at], d.a[i], omega * omega * S + 1e-13 * a[at]);
      }
    }
  }
}

std::vector<Real> wide_times(const std::vector<double>& times) {
  return {times.begin(), times.end()};
}

Real size_of(RawPair p, const std::string& name) {
  const Real velocity = abs(p.u10) * sqrt(p.k1 / p.m1);
  if (name == "c1" || name == "c2") return sqrt(p.m1 * p.k1);
  if (name == "v10" || name == "v20") return velocity;
  return abs(member(p, name));
}

void expect_raw(const ClosedForm& motion, const RawPair& raw, double period,
                const std::vector<std::string>& names) {
  const auto times = times_of(motion, period);
  // A contact may be moved by little against what is left of the motion at its end.
  const Real moved = motion.envelope(motion.end()).u.minCoeff();
  for (const auto& name : names) {
    SCOPED_TRACE(name);
    const auto reference = difference(
        [&](const Real& h) {
          RawPair changed = raw;
          member(changed, name) += h;
          return changed;
        },
        name == "gap" ? moved : size_of(raw, name), wide_times(times));
    expect_derivative(*raw_sensitivity(motion, name), motion, times, reference);
  }
}

TEST(RawSensitivity, IsTheDerivativeOfASimulationOfRandomPairs) {
  constexpr unsigned seed = 20260411;
  Box box(seed);
  for (int i = 0; i < trials(6); ++i) {
    const auto p = simple_pair(box);
    SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << i << " xi1 " << p.xi1
                                    << " X " << p.X << " r " << p.r << " eta " << p.eta);
    const SynchronizedPair motion(p);
    expect_raw(motion, raw_of(wide(p)), motion.constants().period, twelve);
    if (HasFailure()) return;
  }
}

TEST(RawSensitivity, IsTheDerivativeAtAStopAndOfAFreeMass) {
  const RigidStop stop({.xi1 = 0.125, .eta = 0.75, .t_end = 12.0});
  EXPECT_EQ(raw_parameters(stop).size(), 7u);
  expect_raw(stop, raw_of_stop(0.125, 0.75), stop.flight().period.hi, raw_parameters(stop));
  const FreeMass free({.xi1 = 0.125, .t_end = 12.0});
  EXPECT_EQ(raw_parameters(free).size(), 5u);
  auto far = raw_of_stop(0.125, 1);
  far.gap = 1e6;
  expect_raw(free, far, free.flight().period.hi, raw_parameters(free));
}

TEST(ClassSensitivity, IsTheDerivativeOfASimulationOfRandomPairs) {
  constexpr unsigned seed = 20260412;
  Box box(seed);
  const std::vector<std::pair<std::string, Real WidePair::*>> members{
      {"m1", &WidePair::m1}, {"k1", &WidePair::k1}, {"xi1", &WidePair::xi1},
      {"A", &WidePair::A},   {"r", &WidePair::r},   {"eta", &WidePair::eta}};
  for (int i = 0; i < trials(6); ++i) {
    const auto p = simple_pair(box);
    SCOPED_TRACE(testing::Message() << "seed " << seed << " trial " << i << " xi1 " << p.xi1
                                    << " X " << p.X << " r " << p.r << " eta " << p.eta);
    const SynchronizedPair motion(p);
    const auto times = times_of(motion, motion.constants().period);
    ASSERT_EQ(class_parameters(motion).size(), members.size());
    for (const auto& [name, pointer] : members) {
      SCOPED_TRACE(name);
      const auto reference = difference(
          [&, at = pointer](const Real& h) {
            auto changed = wide(p);
            changed.*at += h;
            return raw_of(changed);
          },
          name == "xi1" ? Real(1) : wide(p).*pointer, wide_times(times));
      expect_derivative(*class_sensitivity(motion, name), motion, times, reference);
    }
    if (HasFailure()) return;
  }
}

TEST(ClassSensitivity, IsTheDerivativeOfTheExactDataPairAndOfSingleMasses) {
  const ExactDataPair motion({.sigma = 0.125, .X = 7.0, .r = 0.75, .eta = 0.5, .t_end = 12.0});
  const WideExact base{1, 1, 0.125, 0.125, 0.75, 0.5, 7.0};
  const auto times = times_of(motion, motion.constants().period);
  const std::vector<std::pair<std::string, Real WideExact::*>> members{
      {"m2", &WideExact::m2},       {"Omega", &WideExact::Omega},
      {"sigma", &WideExact::sigma}, {"A_over_X", &WideExact::A_over_X},
      {"r", &WideExact::r},         {"eta", &WideExact::eta}};
  ASSERT_EQ(class_parameters(motion).size(), members.size());
  for (const auto& [name, pointer] : members) {
    SCOPED_TRACE(name);
    const auto reference = difference(
        [&, at = pointer](const Real& h) {
          auto changed = base;
          changed.*at += h;
          return raw_of(changed);
        },
        1, wide_times(times));
    expect_derivative(*class_sensitivity(motion, name), motion, times, reference);
  }

  const RigidStop stop({.xi1 = 0.25, .eta = 0.75, .t_end = 12.0});
  const auto later = times_of(stop, stop.flight().period.hi);
  expect_derivative(
      *class_sensitivity(stop, "xi1"), stop, later,
      difference([](const Real& h) { return raw_of_stop(0.25 + h, 0.75); }, 1, wide_times(later)));
  expect_derivative(
      *class_sensitivity(stop, "eta"), stop, later,
      difference([](const Real& h) { return raw_of_stop(0.25, 0.75 + h); }, 1, wide_times(later)));
  const FreeMass free({.xi1 = 0.25, .t_end = 12.0});
  expect_derivative(*class_sensitivity(free, "xi1"), free, later,
                    difference(
                        [](const Real& h) {
                          auto raw = raw_of_stop(0.25 + h, 1);
                          raw.gap = 1e6;
                          return raw;
                        },
                        1, wide_times(later)));
}

TEST(ClassSensitivity, IsTheSumOfTheRawOnesOverManyImpacts) {
  // d/dA = u1(0)/A d/du10 + ...: all in proportion. The raw sums run over 60 impacts.
  const SynchronizedPair motion({.A = 2.0, .X = 5.0, .r = 0.5, .eta = 0.98, .t_end = 190.0});
  const auto& c = motion.constants();
  const auto whole = class_sensitivity(motion, "A");
  const auto both = class_sensitivity(motion, "eta"), raw = raw_sensitivity(motion, "eta");
  for (const double t : {0.7, 2.0, 5.0, 100.0, 186.0, 189.0}) {
    const auto at = [&](const char* name) {
      return raw_sensitivity(motion, name)->at(t, Side::left);
    };
    const Eigen::VectorXd sum =
        0.5 * (c.u1 * at("u10").u + c.u2 * at("u20").u + c.v1 * at("v10").u + c.v2 * at("v20").u);
    const auto expected = whole->at(t, Side::left);
    EXPECT_LE((sum - expected.u).norm(), 1e-12 * motion.envelope(t).u.norm()) << t;
    const auto one = both->at(t, Side::left), other = raw->at(t, Side::left);
    // k impacts: k/eta of the motion.
    EXPECT_LE((one.v - other.v).norm(), 1e-12 * 60 * motion.envelope(t).v.norm()) << t;
  }
}

TEST(Sensitivity, AtAnImpactTheSideDecides) {
  const SynchronizedPair motion({.X = 5.0, .r = 0.5, .eta = 0.5});
  const auto hit = motion.impact(2);
  const auto k1 = raw_sensitivity(motion, "k1"), eta = class_sensitivity(motion, "eta");
  // The relative velocity is turned about by an impact, and so is what it changes by, up to what
  // the moved instant adds to accelerations.
  EXPECT_GT((k1->at(hit.t, Side::left).v - k1->at(hit.t, Side::right).v).norm(), 0.1);
  const auto before = eta->at(hit.t, Side::left), after = eta->at(hit.t, Side::right);
  // v = v_1 eta^1 before and -v_1 eta^2 after.
  EXPECT_NEAR(after.v[0] / before.v[0], -2.0 * 0.5, 1e-12);
}

TEST(Sensitivity, DiesOutWithTheMotionOnceItIsTooSmallToTell) {
  const SynchronizedPair motion({.xi1 = 0.5, .eta = 0.5, .t_end = 1e6});
  for (const auto& name : twelve) {
    const auto d = raw_sensitivity(motion, name)->at(1e6, Side::left);
    EXPECT_TRUE(d.u.allFinite() && d.v.allFinite() && d.a.allFinite()) << name;
    // A moved contact is felt for ever.
    EXPECT_EQ(d.u.norm() == 0.0, name != "gap") << name;
  }
  for (const auto& name : class_parameters(motion))
    EXPECT_EQ(class_sensitivity(motion, name)->at(1e6, Side::left).v.norm(), 0.0) << name;
}

std::string refusal_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return std::string(error.what()) + " [" + std::string(error.code().name()) + "]";
  }
  return "accepted";
}

TEST(RawSensitivity, KeepsItsDigitsWhereTheFirstFlightsAreLongForgotten) {
  // K (1 - eta) >> 1: what the first flight and the later ones leave in the common motion nearly
  // cancels. Values of an affine recursion that was identified from a simulation with 90 digits.
  const struct {
    double X, r, eta, t, dv1;
  } table[] = {
      {1793.0, 4.6033340302388925, 0.9999999, 1097708967.475334, 1.2395266206815248637e-6}};
  for (const auto& [X, r, eta, t, dv1] : table) {
    const SynchronizedPair motion({.xi1 = 0.0, .X = X, .r = r, .eta = eta, .t_end = 1.1e9});
    // 5e-11 of it is the bound of sensitivity.hpp here.
    EXPECT_NEAR(raw_sensitivity(motion, "c2")->at(t, Side::right).v[0] / dv1, 1.0, 5e-11);
  }
}

TEST(ClassSensitivity, KeepsItsDigitsWhereTheMotionItselfUnderflows) {
  const auto near = [](double found, double expected) {
    EXPECT_NEAR(found / expected, 1.0, 1e-7) << found;
  };
  const SynchronizedPair small({.A = 1e-60, .t_end = 12001.0});
  const auto by_A = class_sensitivity(small, "A")->at(12000.0, Side::right);
  near(by_A.u[0] / 2.6049951e-261, 1.0);
  EXPECT_NEAR(by_A.u[1] / 8.595e-263, 1.0, 1e-3);
  // The same ratio as at full size, where nothing underflows.
  const SynchronizedPair usual({.t_end = 12001.0});
  const auto whole = usual.at(12000.0, Side::right);
  near(by_A.u[1] / by_A.u[0], whole.u[1] / whole.u[0]);
  const SynchronizedPair light({.m1 = 1e-50, .k1 = 1e-50, .A = 1e-60, .t_end = 12001.0});
  const auto by_k1 = class_sensitivity(light, "k1")->at(12000.0, Side::right);
  const auto full = class_sensitivity(usual, "k1");
  near(by_k1.v[1] * 1e10, full->at(12000.0, Side::right).v[1]);
  const SynchronizedPair plastic({.xi1 = 0.0, .eta = 1e-100});
  EXPECT_NEAR(class_sensitivity(plastic, "eta")->at(11.0, Side::right).v[0] / 3.99996e-300, 1.0,
              1e-5);
  const SynchronizedPair fifth({.t_end = 14900.0});
  const auto by_xi1 = class_sensitivity(fifth, "xi1")->at(14899.0, Side::right);
  EXPECT_NEAR(by_xi1.u[0], -1.14e-320, 1e-322);
}

TEST(Sensitivity, WithoutRestitutionIsThereUntilTheFirstImpact) {
  const SynchronizedPair plastic({.eta = 0.0, .t_end = 1.0}), elastic({.t_end = 1.0});
  for (const auto& name : twelve)
    EXPECT_EQ(raw_sensitivity(plastic, name)->at(1.0, Side::right).u,
              raw_sensitivity(elastic, name)->at(1.0, Side::right).u)
        << name;
  EXPECT_EQ(class_sensitivity(plastic, "eta")->at(1.0, Side::right).v.norm(), 0.0);
}

TEST(Sensitivity, IsRefusedWithoutRestitutionAndForUnknownNames) {
  const SynchronizedPair plastic({.eta = 0.0}), pair({});
  for (const auto& name : twelve) {
    const auto text = refusal_of([&] { raw_sensitivity(plastic, name); });
    EXPECT_EQ(text.find("sensitivity to " + name + ": eta = 0; allowed: 0 < eta <= 1."), 0u)
        << text;
    EXPECT_NE(text.find("[no-derivative]"), std::string::npos);
  }
  EXPECT_NE(refusal_of([&] { class_sensitivity(plastic, "eta"); }).find("[no-derivative]"),
            std::string::npos);
  // All else is smooth within the class, and zero at rest.
  const auto xi1 = class_sensitivity(plastic, "xi1");
  EXPECT_GT(xi1->at(1.0, Side::left).u.norm(), 0.1);
  EXPECT_EQ(xi1->at(2.0, Side::left).u.norm(), 0.0);
  EXPECT_NE(refusal_of([&] { raw_sensitivity(pair, "k3"); }).find("[unknown-name]"),
            std::string::npos);
  EXPECT_NE(refusal_of([&] { raw_sensitivity(RigidStop({}), "m2"); }).find("m1, k1, c1, eta, gap"),
            std::string::npos);
  EXPECT_NE(refusal_of([&] { class_sensitivity(pair, "X"); }).find("m1, k1, xi1, A, r, eta"),
            std::string::npos);
  EXPECT_THROW(raw_sensitivity(pair, "m1")->at(-1.0, Side::left), InputError);
  EXPECT_THROW(class_sensitivity(pair, "m1")->at(21.0, Side::left), InputError);
}

}  // namespace
}  // namespace clackers::exact
