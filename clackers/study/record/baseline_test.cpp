#include "clackers/study/baseline.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/error.hpp"

namespace clackers::study {
namespace {

assess::RunScore run_of(double step, double error) {
  assess::RunScore run;
  run.step = step;
  run.finished = true;
  run.u_error = error;
  run.rounding_floor = 1e-14;
  run.impacts = assess::ImpactScore{6, 6, 6, 0, 0, 1e-3, 1e-15};
  run.work.force_evaluations = std::llround(20.0 / step);
  return run;
}

MethodResult method_of(const std::string& name) {
  MethodResult method;
  method.name = name;
  method.claim = {Behaviour::proper, 2.0, ""};
  for (const double h : {0.04, 0.02, 0.01})
    method.ladder.push_back({h, {run_of(h, h * h), run_of(0.8 * h, 0.6 * h * h)}});
  auto& fit = method.assessment.displacement;
  fit.behaviour = Behaviour::proper;
  fit.has_line = true;
  fit.order = 2.0;
  fit.spread = 0.02;
  method.assessment.verdict = Verdict::agrees;
  return method;
}

Record record_of(const std::vector<std::string>& names) {
  Record record;
  record.problem.name = "three-parameter";
  record.problem.parameters = {{"N", 2, "", ""}, {"xi1", 0.05, "", ""}};
  record.problem.end = 20.0;
  record.problem.impact_count = 6;
  record.plan = {0.04, 3, 2};
  for (const auto& name : names) record.methods.push_back(method_of(name));
  return record;
}

// What compare finds when one record of one method is changed.
template <class Change>
MethodChange after(const Change& change) {
  const auto before = record_of({"rk4"});
  auto now = before;
  change(now.methods.front());
  return compare(now, before).methods.front();
}

std::string refusal_of(const Record& now, const Record& baseline) {
  try {
    compare(now, baseline);
  } catch (const InputError& error) {
    return std::string(error.code().name()) + ": " + error.what();
  }
  return "accepted";
}

TEST(Baseline, OfTheSameRecordShowsNoChange) {
  const auto record = record_of({"rk4", "newmark"});
  const auto changes = compare(record, record);
  EXPECT_FALSE(changes.any());
  ASSERT_EQ(changes.methods.size(), 2u);
  EXPECT_EQ(changes.methods[1].name, "newmark");
}

TEST(Baseline, KnowsNewAndGoneMethodsByName) {
  const auto changes = compare(record_of({"rk4", "new"}), record_of({"gone", "rk4"}));
  ASSERT_EQ(changes.methods.size(), 3u);
  EXPECT_EQ(changes.methods[0].presence, MethodChange::Presence::both);
  EXPECT_FALSE(changes.methods[0].any());
  EXPECT_EQ(changes.methods[1].name, "new");
  EXPECT_EQ(changes.methods[1].presence, MethodChange::Presence::added);
  EXPECT_EQ(changes.methods[2].name, "gone");
  EXPECT_EQ(changes.methods[2].presence, MethodChange::Presence::gone);
  EXPECT_TRUE(changes.any());
}

TEST(Baseline, TellsEveryPartOfTheStanding) {
  const auto told = [](const auto& change) { return after(change).standing.has_value(); };
  EXPECT_TRUE(told([](auto& m) { m.assessment.verdict = Verdict::disagrees; }));
  EXPECT_TRUE(told([](auto& m) { m.assessment.displacement.behaviour = Behaviour::reduced; }));
  EXPECT_TRUE(told([](auto& m) { m.assessment.displacement.reason = "energy-growth"; }));
  EXPECT_TRUE(told([](auto& m) { m.claim.behaviour = Behaviour::irregular; }));
  EXPECT_TRUE(told([](auto& m) { m.claim.order = 3; }));
  EXPECT_TRUE(told([](auto& m) { m.claim.reason = "contact-stiffness"; }));
  EXPECT_TRUE(told([](auto& m) { m.complete = false; }));
  EXPECT_FALSE(told([](auto& m) { m.assessment.sentence = "other words"; }));
  const auto refused = after([](auto& m) {
    m.refusal = "cannot";
    m.refusal_code = "linear-only";
  });
  EXPECT_TRUE(refused.standing->now.refused);
  EXPECT_EQ(refused.standing->now.reason, "linear-only");
  EXPECT_FALSE(refused.standing->before.refused);
}

TEST(Baseline, TellsAnOrderThatMovedBeyondBothSpreads) {
  const auto moved = [](double order, double spread) {
    return after([&](auto& m) {
             m.assessment.displacement.order = order;
             m.assessment.displacement.spread = spread;
           })
        .order;
  };
  // 2.00 with spread 0.02 before.
  EXPECT_FALSE(moved(2.039, 0.02));
  ASSERT_TRUE(moved(2.041, 0.02));
  EXPECT_EQ(moved(2.041, 0.02)->before.order, 2.0);
  EXPECT_EQ(moved(2.041, 0.02)->now.order, 2.041);
  EXPECT_TRUE(moved(1.959, 0.02));
  EXPECT_FALSE(moved(1.5, 0.49));
  EXPECT_FALSE(
      after([](auto& m) { m.assessment.displacement = {}; }).order);  // no line, nothing to compare

  // Spreads of nearly nothing: less than can be shown is not told.
  auto before = record_of({"rk4"});
  before.methods[0].assessment.displacement.spread = 1e-9;
  auto now = before;
  now.methods[0].assessment.displacement.order = 2.009;
  EXPECT_FALSE(compare(now, before).methods[0].order);
  now.methods[0].assessment.displacement.order = 2.011;
  EXPECT_TRUE(compare(now, before).methods[0].order);
}

TEST(Baseline, TellsAnErrorThatGrewAtTheFinestStepThatBothFinished) {
  // The finest step is the second run of the last level: 0.008 s, with error 0.6e-4.
  const auto grown = after([](auto& m) { m.ladder[2].runs[1].u_error = 2.4e-4; });
  ASSERT_TRUE(grown.error);
  EXPECT_EQ(grown.error->step, 0.8 * 0.01);
  EXPECT_DOUBLE_EQ(grown.error->now / grown.error->before, 4.0);
  EXPECT_TRUE(after([](auto& m) { m.ladder[2].runs[1].u_error = 0.5e-4; }).error);
  EXPECT_FALSE(after([](auto& m) { m.ladder[2].runs[1].u_error *= 1.009; }).error);
  EXPECT_TRUE(after([](auto& m) { m.ladder[2].runs[1].u_error *= 1.011; }).error);
  EXPECT_TRUE(after([](auto& m) { m.ladder[2].runs[1].u_error = NAN; }).error);
  EXPECT_FALSE(after([](auto& m) { m.ladder[0].runs[0].u_error = 1.0; }).error);

  // Of runs that one side did not finish, the next coarser step is compared.
  const auto failed = after([](auto& m) {
    m.ladder[2].runs[1].finished = false;
    m.ladder[2].runs[0].u_error = 1.0;
  });
  EXPECT_EQ(failed.error->step, 0.01);
  EXPECT_EQ(failed.finished->step, 0.8 * 0.01);
  EXPECT_TRUE(failed.finished->before);
  EXPECT_FALSE(failed.finished->now);
  const auto two_failed = after([](auto& m) {
    m.ladder[0].runs[0].finished = false;
    m.ladder[1].runs[0].finished = false;
  });
  EXPECT_EQ(two_failed.finished->step, 0.02);
}

TEST(Baseline, KeepsQuietAboutErrorsBelowTheRoundingFloors) {
  auto before = record_of({"rk4"});
  auto& old_run = before.methods[0].ladder[2].runs[1];
  old_run.u_error = 1e-14;
  auto now = before;
  auto& run = now.methods[0].ladder[2].runs[1];
  run.u_error = 2.9e-14;  // both floors are 1e-14
  EXPECT_FALSE(compare(now, before).methods[0].error);
  run.u_error = 3.1e-14;
  EXPECT_TRUE(compare(now, before).methods[0].error);
  old_run.u_error = run.u_error = NAN;
  EXPECT_FALSE(compare(now, before).methods[0].error);
}

TEST(Baseline, TellsCollisionsThatAreMissedNowOfTheFinestSuchStep) {
  const auto missing = after([](auto& m) {
    m.ladder[0].runs[0].impacts->missed = 3;
    m.ladder[1].runs[1].impacts->missed = 2;
  });
  ASSERT_TRUE(missing.collisions);
  EXPECT_EQ(missing.collisions->step, 0.8 * 0.02);
  EXPECT_EQ(missing.collisions->before.missed, 0);
  EXPECT_EQ(missing.collisions->now.missed, 2);
  EXPECT_EQ(missing.collisions->now.expected, 6);
  EXPECT_EQ(after([](auto& m) { m.ladder[1].runs[0].impacts->extra = 1; }).collisions->now.extra,
            1);
  EXPECT_FALSE(after([](auto& m) { m.ladder[1].runs[0].impacts.reset(); }).collisions);
}

TEST(Baseline, TellsWorkOfTheFinestStep) {
  const auto more = after([](auto& m) { m.ladder[2].runs[1].work.force_evaluations = 5000; });
  ASSERT_TRUE(more.work);
  EXPECT_EQ(more.work->before, 2500);
  EXPECT_EQ(more.work->now, 5000);
  EXPECT_FALSE(after([](auto& m) { m.ladder[2].runs[1].work.force_evaluations += 20; }).work);
}

TEST(Baseline, TellsWhereItComesFromAndWhetherItWasInterrupted) {
  auto before = record_of({"rk4"});
  before.provenance.date = "2030-01-02T03:04:05Z";
  before.interrupted = true;
  const auto changes = compare(record_of({"rk4"}), before);
  EXPECT_EQ(changes.before.date, "2030-01-02T03:04:05Z");
  EXPECT_TRUE(changes.interrupted);
}

TEST(Baseline, OfAnotherCaseOrLadderIsRefusedWithTheOptionsOfBoth) {
  const auto now = record_of({"rk4"});
  const auto refused = [&](const auto& change) {
    auto other = now;
    change(other);
    return refusal_of(now, other);
  };
  EXPECT_EQ(refused([](Record& r) { r.problem.name = "stop"; }),
            "other-study: baseline: is of another case: --case stop --set N=2,xi1=0.05; this run: "
            "--case three-parameter --set N=2,xi1=0.05. Only the same case and the same steps can "
            "be compared; repeat one of the two with the options of the other.");
  EXPECT_NE(refused([](Record& r) {
              r.problem.parameters[1].value = 0.1;
            }).find("other parameters: --case three-parameter --set N=2,xi1=0.1; this run"),
            std::string::npos);
  EXPECT_NE(refused([](Record& r) { r.problem.parameters.pop_back(); }).find("other parameters"),
            std::string::npos);
  EXPECT_NE(
      refused([](Record& r) { r.problem.parameters[1].name = "xi"; }).find("other parameters"),
      std::string::npos);
  EXPECT_NE(refused([](Record& r) {
              r.problem.end = 21.0;
            }).find("another motion: 21 s, 6 collisions; this run: 20 s, 6 collisions"),
            std::string::npos);
  EXPECT_NE(refused([](Record& r) { r.problem.impact_count = 7; }).find("another motion"),
            std::string::npos);
  EXPECT_NE(refused([](Record& r) { r.plan.levels = 4; })
                .find("another ladder: --coarsest 0.04 --levels 4 --neighbours 2; this run: "
                      "--coarsest 0.04 --levels 3 --neighbours 2"),
            std::string::npos);
  EXPECT_NE(refused([](Record& r) { r.plan.coarsest = 0.05; }).find("ladder"), std::string::npos);
  EXPECT_NE(refused([](Record& r) { r.plan.neighbours = 3; }).find("ladder"), std::string::npos);
}

TEST(Baseline, IsRefusedBeforeAnyRun) {
  VerifyRequest request;
  request.methods = {"rk4"};
  Record baseline;
  EXPECT_THROW(require_same_study(request, baseline), InputError);
  request.plan = {0.5, 1, 1};
  const auto record = verify(request);
  EXPECT_NO_THROW(require_same_study(request, record));
  request.settings = {{"xi1", 0.06}};
  EXPECT_THROW(require_same_study(request, record), InputError);
}

}  // namespace
}  // namespace clackers::study
