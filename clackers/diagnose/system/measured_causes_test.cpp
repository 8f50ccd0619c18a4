#include "clackers/diagnose/system/measured_causes.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "clackers/diagnose/causes.hpp"
#include "clackers/diagnose/testing/histories.hpp"
#include "clackers/diagnose/testing/method_rows.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::diagnose::testing {
namespace {

using Problem = model::ImpactProblem<>;

// Masses between springs to the ground, each coupled to the next one; two pairs of them meet.
Problem chain(bool loaded) {
  Problem p;
  p.system.mass = Eigen::Vector4d(1.2, 1.7, 1.1, 1.5).asDiagonal();
  p.system.stiffness = Eigen::Vector4d(28.0, 31.0, 24.0, 36.0).asDiagonal();
  for (int i = 0; i < 3; ++i)
    p.system.stiffness.block<2, 2>(i, i) += Eigen::Matrix2d{{3.0, -3.0}, {-3.0, 3.0}};
  p.system.damping = 0.01 * p.system.stiffness + 0.02 * p.system.mass;
  if (loaded) p.system.add_load = model::HarmonicLoad({{0, 2.0, 4.0, 0.3}});
  p.start = {0.0, Eigen::Vector4d(0.08, 0.03, 0.05, 0.01), Eigen::Vector4d::Zero()};
  p.contacts = {model::contact_between(4, 0, 1, 0.8), model::contact_between(4, 2, 3, 0.8)};
  p.contacts[0].gap = -0.04;
  p.contacts[1].gap = -0.04;
  p.end = 12.0;
  return p;
}

Files files_of(const Problem& right) {
  Files files;
  files.problem.problem = right;
  files.problem.motion = std::make_shared<exact::PiecewiseMotion>(right);
  return files;
}

struct ChainFault {
  const char* name;
  std::function<void(Problem&)> put;
  std::vector<Diagnosis> found;  ///< code, value, unit, confidence unused, evidence, text
};

const std::vector<ChainFault>& chain_faults() {
  const auto load = [](double factor, double late) {
    return [=](Problem& p) {
      p.system.add_load = model::HarmonicLoad({{0, 2.0 * factor, 4.0, 0.3 - 4.0 * late}});
    };
  };
  static const std::vector<ChainFault> all{
      {"spring to the ground",
       [](Problem& p) { p.system.stiffness(1, 1) += 0.03 * 31.0; },
       {{"stiffness-differs", 3.0, "%", 0, {}, "between mass 2 and the ground"}}},
      {"spring between masses",
       [](Problem& p) {
         p.system.stiffness.block<2, 2>(1, 1) += 0.3 * Eigen::Matrix2d{{1.0, -1.0}, {-1.0, 1.0}};
       },
       {{"stiffness-differs", 10.0, "%", 0, {}, "between masses 2 and 3"}}},
      {"damper",
       [](Problem& p) { p.system.damping(1, 1) += 0.2 * (0.31 + 0.034); },
       {{"damping-differs", 20.0, "%", 0, {}, "between mass 2 and the ground"}}},
      {"all dampers",
       [](Problem& p) { p.system.damping *= 1.05; },
       {{"damping-differs", 5.0, "%", 0, {}, "of all dampers"}}},
      {"all springs",
       [](Problem& p) { p.system.stiffness *= 1.02; },
       {{"stiffness-differs", 2.0, "%", 0, {}, "of all springs"}}},
      {"mass",
       [](Problem& p) { p.system.mass(2, 2) *= 0.98; },
       {{"mass-differs", -2.0, "%", 0, {{"mass", 3.0}}}}},
      {"weaker load", load(0.8, 0.0), {{"load-differs", 0.8, "1", 0, {{"mass", 1.0}}}}},
      {"late load", load(1.0, 0.05), {{"load-differs", 1.0, "1", 0, {{"time", 0.05}}}}},
      {"no load",
       [](Problem& p) { p.system.add_load = nullptr; },
       {{"load-differs", 0.0, "1", 0, {}, "missing"}}},
      {"constant force",
       [](Problem& p) {
         p.system.add_load = model::HarmonicLoad({{0, 2.0, 4.0, 0.3}, {1, 0.3, 0.0, 0.0}});
       },
       {{"constant-force", 0.3, "N", 0, {{"mass", 2.0}}}}},
      {"two springs",
       [](Problem& p) {
         p.system.stiffness(0, 0) *= 1.05;
         p.system.stiffness(3, 3) *= 0.96;
       },
       {{"stiffness-differs", 100.0 * 0.05 * 31.0 / 28.0, "%", 0, {{"causes", 2.0}}},
        {"stiffness-differs", -100.0 * 0.04 * 39.0 / 36.0, "%"}}},
      {"restitution of one contact",
       [](Problem& p) { p.contacts[1].restitution = 0.75; },
       {{"restitution-differs", 0.75, "1", 0, {{"contact", 2.0}}}}},
      {"load and restitution",
       [=](Problem& p) {
         load(0.9, 0.0)(p);
         p.contacts[0].restitution = 0.6;
       },
       {{"load-differs", 0.9, "1"}, {"restitution-differs", 0.6, "1", 0, {{"contact", 1.0}}}}},
      // By the masses that the flights have impulses keep momentum.
      {"mass and restitution",
       [](Problem& p) {
         p.system.mass(0, 0) *= 1.1;
         p.contacts[0].restitution = 0.6;
       },
       {{"mass-differs", 10.0, "%", 0, {{"mass", 1.0}}},
        {"restitution-differs", 0.6, "1", 0, {{"contact", 1.0}}}}},
  };
  return all;
}

TEST(MeasuredCauses, OneWrongLinkMassLoadOrContactOfAChainIsNamed) {
  const auto right = chain(true);
  for (const auto* method : {"rk4", "newmark"})
    for (const auto& fault : chain_faults()) {
      SCOPED_TRACE(std::string(method) + ": " + fault.name);
      auto wrong = right;
      fault.put(wrong);
      auto files = files_of(right);
      for (const double h : {0.01, 0.005, 0.0025}) files.add(run(method, wrong, h), h);
      const auto found = measured_causes(files.question());
      ASSERT_EQ(found.size(), fault.found.size());
      for (std::size_t i = 0; i < found.size(); ++i) {
        const auto& expected = fault.found[i];
        EXPECT_EQ(found[i].code, expected.code);
        EXPECT_EQ(found[i].unit, expected.unit);
        EXPECT_NEAR(found[i].value, expected.value,
                    std::max(0.005, 0.02 * std::abs(expected.value)));
        EXPECT_TRUE(expected.text.empty() || found[i].text == expected.text) << found[i].text;
        for (const auto& [name, value] : expected.evidence)
          EXPECT_NEAR(found[i].fact(name), value, 0.02 * value) << name;
      }
    }
}

TEST(MeasuredCauses, HistoriesMayBeADecadeApart) {
  const auto right = chain(true);
  auto wrong = right;
  chain_faults().back().put(wrong);
  auto files = files_of(right);
  for (const double h : {0.02, 0.002}) files.add(run("rk4", wrong, h), h);
  EXPECT_EQ(codes(measured_causes(files.question())), "mass-differs restitution-differs");
}

TEST(MeasuredCauses, ARightSolverHasNone) {
  const auto right = chain(true);
  for (const auto* method : {"rk4", "newmark"}) {
    auto files = files_of(right);
    for (const double h : {0.01, 0.005, 0.0025}) files.add(run(method, right, h), h);
    auto question = files.question();
    question.limit.wrong = true;  // measured all the same
    EXPECT_EQ(codes(measured_causes(question)), "") << method;
  }
}

TEST(MeasuredCauses, AConstantLoadThatIsMissingIsALoad) {
  auto right = chain(true);
  right.system.add_load = model::HarmonicLoad({{0, 2.0, 4.0, 0.3}, {1, 0.5, 0.0, 0.0}});
  auto files = files_of(right);
  for (const double h : {0.01, 0.005}) files.add(run("rk4", chain(true), h), h);
  const auto found = measured_causes(files.question());
  ASSERT_EQ(codes(found), "load-differs");
  EXPECT_EQ(found[0].text, "missing");
  EXPECT_EQ(found[0].fact("mass"), 2.0);
}

TEST(MeasuredCauses, AFastClockIsNoStiffnessOfAllSprings) {
  auto right = chain(false);
  right.system.damping.setZero();
  for (const bool is_clock : {true, false}) {
    auto wrong = right;
    if (!is_clock) wrong.system.stiffness *= 0.998;
    auto files = files_of(right);
    for (const double h : {0.005, 0.0025}) {
      auto rows = run("rk4", wrong, h);
      while (rows.t.back() > 0.99 * right.end) rows.t.pop_back();
      rows.u.resize(rows.t.size() * 4);
      rows.v.resize(rows.u.size());
      if (is_clock)
        for (double& t : rows.t) t *= 1.001;
      files.add(rows, h);
    }
    const auto found = system_causes(files.question());
    ASSERT_EQ(codes(found), is_clock ? "time-unit" : "stiffness-differs");
    EXPECT_NEAR(found[0].value, is_clock ? 1.001 : -0.2, 1e-4);
  }
}

TEST(MeasuredCauses, AllLoadsMayBeOneCause) {
  const auto loaded = [](double factor, double late, double of_second) {
    auto p = chain(true);
    p.system.add_load = model::HarmonicLoad(
        {{0, 2.0 * factor, 4.0, 0.3 - 4.0 * late}, {2, 1.0 * of_second, 4.0, 1.0 - 4.0 * late}});
    return p;
  };
  const auto causes_of = [&](const Problem& wrong) {
    auto files = files_of(loaded(1.0, 0.0, 1.0));
    for (const double h : {0.01, 0.005}) files.add(run("rk4", wrong, h), h);
    return diagnose(files.question());
  };
  auto found = causes_of(loaded(1.0, 0.01, 1.0));
  ASSERT_EQ(codes(found), "load-differs");
  EXPECT_NEAR(found[0].fact("time"), 0.01, 1e-4);
  EXPECT_TRUE(sentence_of(found[0]).starts_with("Each load comes 0.01 s too late"));
  found = causes_of(loaded(1.02, 0.0, 1.02));
  ASSERT_EQ(codes(found), "load-differs");
  EXPECT_NEAR(found[0].value, 1.02, 1e-4);
  found = causes_of(chain(false));
  ASSERT_EQ(codes(found), "load-differs");
  EXPECT_TRUE(sentence_of(found[0]).starts_with("Each load is missing"));
  // Each by another factor: both are told, with what they explain together.
  found = causes_of(loaded(1.1, 0.0, 0.8));
  ASSERT_EQ(codes(found), "load-differs load-differs");
  for (const auto& one : found)
    EXPECT_NE(sentence_of(one).find("by 2 causes together"), std::string::npos);
}

TEST(MeasuredCauses, ALoadThatExplainsAllStandsAlone) {
  const auto right = chain(true);
  auto wrong = right;
  wrong.system.add_load = model::HarmonicLoad({{0, 2.2, 4.0, 0.3}});
  auto files = files_of(right);
  for (const double h : {0.004, 0.002, 0.001}) files.add(run("rk4", wrong, h), h);
  EXPECT_EQ(codes(measured_causes(files.question())), "load-differs");
}

TEST(MeasuredCauses, AnotherGapIsNoFaultOfMomentumAndRestitution) {
  const auto right = chain(true);
  auto wrong = right;
  for (auto& contact : wrong.contacts) contact.gap -= 0.004;
  auto files = files_of(right);
  for (const double h : {0.01, 0.005, 0.0025}) files.add(run("rk4", wrong, h), h);
  EXPECT_EQ(codes(measured_causes(files.question())), "");
}

TEST(ShiftedTime, IsOfStepsOrSecondsAndOfNoLateLoad) {
  const auto right = chain(true);
  const auto shift_by = [&](const Problem& solved, double steps, double seconds) {
    auto files = files_of(right);
    for (const double h : {0.01, 0.005, 0.0025}) {
      auto rows = run("rk4", solved, h);
      for (double& t : rows.t) t += steps * h + seconds;
      while (rows.t.back() > right.end) rows.t.pop_back();
      rows.u.resize(rows.t.size() * 4);
      rows.v.resize(rows.u.size());
      files.add(rows, h);
    }
    return shifted_time(files.question());
  };
  const auto in_steps = shift_by(right, 1.0, 0.0), in_seconds = shift_by(right, 0.0, 0.003);
  ASSERT_TRUE(in_steps);
  EXPECT_EQ(in_steps->unit, "steps");
  EXPECT_NEAR(in_steps->value, 1.0, 0.01);
  ASSERT_TRUE(in_seconds);
  EXPECT_EQ(in_seconds->unit, "s");
  EXPECT_NEAR(in_seconds->value, 0.003, 1e-5);
  // Beyond half a period.
  const auto clock = shift_by(right, 0.0, 2.0);
  ASSERT_TRUE(clock);
  EXPECT_EQ(clock->unit, "s");
  EXPECT_NEAR(clock->value, 2.0, 1e-5);
  auto late = right;
  late.system.add_load = model::HarmonicLoad({{0, 2.0, 4.0, 0.1}});
  EXPECT_FALSE(shift_by(late, 0.0, 0.0));
  EXPECT_FALSE(shift_by(right, 0.0, 0.0));
}

model::Trajectory rows_of(const exact::PiecewiseMotion& motion, double h) {
  model::Trajectory rows;
  rows.dof = motion.dof();
  for (int n = 0; n * h <= motion.end() * (1.0 + 1e-12); ++n)
    rows.t.push_back(std::min(n * h, motion.end()));
  rows.u.resize(rows.t.size() * std::size_t(rows.dof));
  rows.v.resize(rows.u.size());
  motion.sample(rows.t, model::Side::right, {rows.u, rows.v, {}});
  return rows;
}

TEST(MeasuredCauses, AnImpulseThatOneMassFeelsMoreKeepsNoMomentum) {
  const auto right = chain(false);
  const exact::PiecewiseMotion wrong(right, {.impulse_factor = {1.0, 0.9, 1.0, 1.0}}, right.end,
                                     3000);
  auto files = files_of(right);
  for (const double h : {0.02, 0.01}) files.add(rows_of(wrong, h), h);
  const auto found = measured_causes(files.question());
  const auto* momentum = find(found, "momentum-not-kept");
  ASSERT_NE(momentum, nullptr) << codes(found);
  // J b + d e2, d = -J / 10: (1 / 10) |e2 - b (e2 . w) / (b . w)| over |J b| in the norm of 1 / m.
  const double m1 = 1.2, m2 = 1.7;
  EXPECT_NEAR(momentum->value, 0.1 / std::sqrt(1.0 / m1 + 1.0 / m2) / std::sqrt(m1 + m2), 0.01);
  EXPECT_EQ(momentum->fact("contact"), 1.0);
}

// One mass on a stop; the restitution of an impact by its number and its closing speed.
model::Trajectory with_restitution(const Problem& right, double h,
                                   const std::function<double(int, double)>& restitution) {
  model::Trajectory rows;
  rows.dof = 1;
  auto now = right;
  double next = 0.0;
  for (int impact = 0; now.start.t < right.end; ++impact) {
    const exact::PiecewiseMotion flight(now, {}, right.end, 3000);
    const double last = flight.impact_count(right.end) == 0 ? right.end : flight.impact(1).t;
    for (; next < last; next += h) {
      rows.t.push_back(next);
      const auto state = flight.at(next, model::Side::right);
      rows.u.push_back(state.u[0]);
      rows.v.push_back(state.v[0]);
    }
    const double closing = flight.at(last, model::Side::right).v[0] / right.contacts[0].restitution;
    now.start = {last, Eigen::VectorXd::Zero(1),
                 Eigen::VectorXd::Constant(1, restitution(impact, closing) * closing)};
  }
  return rows;
}

TEST(MeasuredCauses, RestitutionThatFallsWithTheSpeedIsASlope) {
  const auto right = methods::runs::mass_on_stop(1.0, 0.02, 1.0, 0.0, 1.0, 0.9, 20.0);
  const auto causes_of = [&](const auto& restitution) {
    auto files = files_of(right);
    for (const double h : {0.02, 0.01}) files.add(with_restitution(right, h, restitution), h);
    return measured_causes(files.question());
  };
  const auto found = causes_of([](int, double closing) { return 0.9 - 0.1 * closing; });
  ASSERT_EQ(codes(found), "restitution-varies");
  EXPECT_NEAR(found[0].value, -0.1, 0.005);
  EXPECT_EQ(found[0].unit, "s/m");
  // Restitution that changes, but not with the speed.
  EXPECT_EQ(codes(causes_of([](int impact, double) { return 0.9 - 0.06 * (impact % 3); })), "");
}

}  // namespace
}  // namespace clackers::diagnose::testing
