#include "clackers/exact/assembly/shaped_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/exact/testing/assembly_members.hpp"

namespace clackers::exact {
namespace {

using namespace testing_oracle;
using model::Side;

BuildingsParameters random_buildings(Box& box) {
  BuildingsParameters p;
  p.left = std::floor(box.uniform(1.0, 5.0));
  p.right = std::floor(box.uniform(1.0, 5.0));
  p.X = box.one_in(2) ? 1.0 : box.one_in(2) ? 3.0 : 5.0;
  p.r = p.X == 1.0
            ? box.decades(-2.0, 2.0)
            : box.uniform(0.05, 0.999) * buildings_limit(int(p.left), int(p.right), p.X).proven;
  p.m1 = box.decades(-3.0, 3.0);
  p.Omega = box.decades(-3.0, 3.0);
  p.sigma = box.one_in(3) ? 0.0 : p.Omega * box.uniform(0.0, 0.3);
  p.V = box.decades(-3.0, 3.0);
  p.eta = box.one_in(2) ? 1.0 : box.uniform(0.1, 1.0);
  p.t_end = 11.0 / p.Omega;
  return p;
}

RowParameters random_row(Box& box) {
  RowParameters p;
  p.masses = std::floor(box.uniform(2.0, 7.0));
  p.fast = std::floor(box.uniform(0.0, p.masses + 1.0));
  p.X = 2.0 * std::floor(box.uniform(1.0, 5.0)) + 1.0;
  p.speed = box.uniform(0.05, 0.999) * row_limit(p);
  p.m1 = box.decades(-3.0, 3.0);
  p.Omega = box.decades(-3.0, 3.0);
  p.sigma = box.one_in(3) ? 0.0 : p.Omega * box.uniform(0.0, 0.3);
  p.eta = box.one_in(2) ? 1.0 : box.uniform(0.1, 1.0);
  p.t_end = 11.0 / p.Omega;
  return p;
}

AlternatingParameters random_alternating(Box& box) {
  AlternatingParameters p;
  p.rh = 2.0 * std::floor(box.uniform(1.0, 4.0));
  p.r = box.uniform(0.05, 0.999) * alternating_limit(p.rh);
  p.Omega = box.decades(-3.0, 3.0);
  p.sigma = box.one_in(3) ? 0.0 : p.Omega * box.uniform(0.0, 0.3);
  p.t_end = 11.0 / p.Omega;
  return p;
}

AssemblyParameters random_assembly(Box& box) {
  AssemblyParameters p;
  p.pairs = std::floor(box.uniform(1.0, 4.0));
  p.coupling = box.one_in(3) ? Coupling::dense : box.one_in(2) ? Coupling::block : Coupling::chain;
  p.seed = std::floor(box.uniform(0.0, 1e15));
  p.X = 4.0 * std::floor(box.uniform(0.0, 3.0)) + 1.0;
  p.xi1 = box.one_in(3) ? 0.0 : box.uniform(0.0, 0.3);
  p.eta = box.one_in(2) ? 1.0 : box.uniform(0.1, 1.0);
  p.t_end = 11.0;
  return p;
}

// Members of the class beside the event-driven simulation, up to the fourth impact or so.
template <class Draw, class Make>
void follow(unsigned seed, int members, const Draw& draw, const Make& make) {
  for (int i = 0; i < trials(members); ++i) {
    Box box(seed + unsigned(i));
    const auto p = draw(box);
    SCOPED_TRACE(testing::Message() << "seed " << seed + unsigned(i));
    const auto motion = make(p);
    EXPECT_GE(expect_simulated(raw_of(p), *motion, p.t_end, box), 1);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Buildings, AgreeWithTheSimulation) {
  follow(100, 15, random_buildings, [](const auto& p) { return make_buildings(p); });
}

TEST(Row, AgreesWithTheSimulation) {
  follow(200, 15, random_row, [](const auto& p) { return make_row(p); });
}

TEST(Alternating, AgreesWithTheSimulation) {
  follow(300, 15, random_alternating, [](const auto& p) { return make_alternating(p); });
}

TEST(Assembly, AgreesWithTheSimulation) {
  follow(400, 15, random_assembly, [](const auto& p) { return make_assembly(p); });
}

}  // namespace
}  // namespace clackers::exact
