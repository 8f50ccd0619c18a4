#include "clackers/exact/certified/shaped_enclosure.hpp"

#include <gtest/gtest.h>

#ifdef CLACKERS_HAS_ARB

#include "clackers/exact/certified/digits.hpp"
#include "clackers/exact/testing/assembly_members.hpp"

namespace clackers::certified {
namespace {

using exact::testing_oracle::MassSimulator;
using exact::testing_oracle::Real;
using exact::testing_oracle::RealVector;
using model::Side;

// Correctly rounded to 60 digits, while the simulation knows 90 of the largest.
void expect_same(const std::string& text, const Real& value) {
  EXPECT_LE(abs(Real(Real(text) - value)), Real("1e-59") * abs(value) + Real("1e-75")) << text;
}

void expect_same(const std::vector<std::string>& texts, const RealVector& values) {
  ASSERT_EQ(std::ssize(texts), values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) expect_same(texts[std::size_t(i)], values[i]);
}

// States before, between and after the first impacts, and the impacts, as simulated.
template <class Parameters, class Make>
void expect_simulated_digits(const Parameters& p, Make make, long long impacts) {
  const auto motion = make(p);
  const auto raw = exact::testing_oracle::raw_of(p);
  MassSimulator simulator(raw);
  Digits digits(*motion, 60);
  long long k = 0;
  for (int step = 0; k < impacts; ++step) {
    const double t = 0.337 * step;
    ASSERT_LT(t, motion->end());
    while (const auto hit = simulator.next(t)) {
      const auto state = simulator.at(hit->t);
      for (std::size_t c = 0; c < hit->contacts.size(); ++c) {
        const auto texts = digits.impact(++k);
        expect_same(texts.t, hit->t);
        expect_same(texts.before.u, state.u);
        expect_same(texts.before.v, hit->before);
        expect_same(texts.after.v, hit->after);
        expect_same(texts.after.a, state.a);
        const Real impulse = hit->impulses[Eigen::Index(c)];
        expect_same(texts.impulse, impulse);
        const auto energy = [&](const RealVector& v) {
          return Real((v.dot(raw.mass * v) + state.u.dot(raw.stiffness * state.u)) / 2);
        };
        expect_same(texts.energy_before, energy(hit->before));
        expect_same(texts.energy_after, energy(hit->after));
      }
    }
    const auto now = simulator.at(t);
    const auto texts = digits.at(t, Side::right);
    expect_same(texts.u, now.u);
    expect_same(texts.v, now.v);
    expect_same(texts.a, now.a);
  }
  EXPECT_GE(k, impacts);
}

TEST(ShapedEnclosure, BuildingsToSixtyDigitsAreThoseOfTheSimulation) {
  const auto make = [](const exact::BuildingsParameters& p) { return exact::make_buildings(p); };
  expect_simulated_digits(exact::BuildingsParameters{}, make, 3);
  expect_simulated_digits(exact::BuildingsParameters{.left = 3.0,
                                                     .right = 2.0,
                                                     .X = 3.0,
                                                     .r = 0.3,
                                                     .m1 = 1.7,
                                                     .Omega = 1.3,
                                                     .sigma = 0.11,
                                                     .V = 0.7,
                                                     .eta = 0.8},
                          make, 3);
}

TEST(ShapedEnclosure, RowsToSixtyDigitsAreThoseOfTheSimulation) {
  const auto make = [](const exact::RowParameters& p) { return exact::make_row(p); };
  expect_simulated_digits(exact::RowParameters{}, make, 12);
  expect_simulated_digits(exact::RowParameters{.masses = 4.0, .fast = 0.0, .eta = 0.9}, make, 6);
}

TEST(ShapedEnclosure, AlternatingImpactsToSixtyDigitsAreThoseOfTheSimulation) {
  const auto make = [](const exact::AlternatingParameters& p) {
    return exact::make_alternating(p);
  };
  expect_simulated_digits(exact::AlternatingParameters{}, make, 4);
  expect_simulated_digits(exact::AlternatingParameters{.rh = 4.0, .r = 0.6, .Omega = 1.1}, make, 4);
}

TEST(ShapedEnclosure, AssembliesToSixtyDigitsAreThoseOfTheSimulation) {
  const auto make = [](const exact::AssemblyParameters& p) { return exact::make_assembly(p); };
  for (const auto coupling :
       {exact::Coupling::chain, exact::Coupling::block, exact::Coupling::dense})
    expect_simulated_digits(
        exact::AssemblyParameters{.pairs = 3.0, .coupling = coupling, .xi1 = 0.07, .eta = 0.9},
        make, 6);
}

// Values at t = 0 and at impacts without damping are algebraic: zeros and halves among them.
TEST(ShapedEnclosure, AlgebraicValuesAreExact) {
  const auto alternating = exact::make_alternating({.Omega = 0.5, .sigma = 0.5});
  Digits start(*alternating, 20);
  EXPECT_EQ(start.at(0.0, Side::right).v[0], "0");  // Omega = sigma: the terms cancel
  EXPECT_EQ(start.at(0.0, Side::right).u[1], "0");
  const auto undamped = exact::make_buildings({.right = 1.0, .m1 = 0.5, .sigma = 0.0});
  Digits digits(*undamped, 1);
  EXPECT_EQ(digits.impact(1).energy_before, "0.5");
  EXPECT_EQ(digits.at(0.0, Side::right).v[1], "0");
  EXPECT_EQ(digits.impact(2).before.u[0], "0");
  // 0.25 lies halfway: half to even.
  const auto quarter = exact::make_buildings({.right = 1.0, .m1 = 0.25, .sigma = 0.0});
  EXPECT_EQ(Digits(*quarter, 1).impact(1).energy_before, "0.2");
  const auto plastic = exact::make_row({.eta = 0.0});
  EXPECT_EQ(Digits(*plastic, 5).at(15.0, Side::right).u[0], "0");
}

}  // namespace
}  // namespace clackers::certified

#endif
