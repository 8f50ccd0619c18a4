#include "clackers/study/baseline.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/study/check.hpp"
#include "clackers/study/verify.hpp"

namespace clackers::study {
namespace {

record::Run run_of(double step, double error) {
  record::Run whole;
  auto& run = whole.score;
  run.step = step;
  run.finished = true;
  run.u_error = error;
  run.rounding_floor = 1e-14;
  run.impacts = measure::ImpactScore{6, 6, 6, 0, 0, 1e-3, 1e-15};
  run.work.force_evaluations = std::llround(20.0 / step);
  return whole;
}

record::Subject method_of(const std::string& name) {
  record::Subject method;
  method.name = name;
  method.claim = {Behaviour::proper, 2.0, ""};
  for (const double h : {0.04, 0.02, 0.01})
    method.levels.push_back({h, {run_of(h, h * h), run_of(0.8 * h, 0.6 * h * h)}});
  auto& fit = method.assessment.displacement;
  fit.behaviour = Behaviour::proper;
  fit.has_line = true;
  fit.order = 2.0;
  fit.spread = 0.02;
  method.assessment.verdict = Verdict::agrees;
  return method;
}

record::Record record_of(const std::vector<std::string>& names) {
  record::CaseRecord one;
  one.problem.name = "three-parameter";
  one.problem.parameters = {{"N", 2, "", ""}, {"xi1", 0.05, "", ""}};
  one.problem.end = 20.0;
  one.problem.impact_count = 6;
  one.plan = {0.04, 3, 2};
  for (const auto& name : names) one.subjects.push_back(method_of(name));
  record::Record record;
  record.cases = {one};
  return record;
}

// What compare finds when one record of one method is changed.
SubjectChange after(const auto& change) {
  const auto before = record_of({"rk4"});
  auto now = before;
  change(now.cases[0].subjects.front());
  return compare(now, before).subjects.front();
}

std::string refusal_of(const record::Record& now, const record::Record& baseline) {
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
  ASSERT_EQ(changes.subjects.size(), 2u);
  EXPECT_EQ(changes.subjects[1].name, "newmark");
}

TEST(Baseline, FindsNewAndGoneSubjectsByName) {
  const auto changes = compare(record_of({"rk4", "new"}), record_of({"gone", "rk4"}));
  ASSERT_EQ(changes.subjects.size(), 3u);
  EXPECT_EQ(changes.subjects[0].presence, SubjectChange::Presence::both);
  EXPECT_FALSE(changes.subjects[0].any());
  EXPECT_EQ(changes.subjects[1].name, "new");
  EXPECT_EQ(changes.subjects[1].presence, SubjectChange::Presence::added);
  EXPECT_EQ(changes.subjects[2].name, "gone");
  EXPECT_EQ(changes.subjects[2].presence, SubjectChange::Presence::gone);
  EXPECT_TRUE(changes.any());
}

TEST(Baseline, ShowsEveryPartOfTheFinding) {
  const auto shown = [](const auto& change) { return after(change).finding.has_value(); };
  EXPECT_TRUE(shown([](auto& m) { m.assessment.verdict = Verdict::disagrees; }));
  EXPECT_TRUE(shown([](auto& m) { m.assessment.displacement.behaviour = Behaviour::reduced; }));
  EXPECT_TRUE(shown([](auto& m) { m.assessment.displacement.reason = "energy-growth"; }));
  EXPECT_TRUE(shown([](auto& m) { m.claim.behaviour = Behaviour::irregular; }));
  EXPECT_TRUE(shown([](auto& m) { m.claim.order = 3; }));
  EXPECT_TRUE(shown([](auto& m) { m.claim.reason = "contact-stiffness"; }));
  EXPECT_TRUE(shown([](auto& m) { m.complete = false; }));
  const auto refused = after([](auto& m) {
    m.refusal = "cannot";
    m.refusal_code = "linear-only";
  });
  EXPECT_TRUE(refused.finding->now.refused);
  EXPECT_EQ(refused.finding->now.reason, "linear-only");
  EXPECT_FALSE(refused.finding->before.refused);
}

TEST(Baseline, ShowsAnOrderThatMovedBeyondBothSpreads) {
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

  // Spreads of nearly nothing: less than can be shown is left out.
  auto before = record_of({"rk4"});
  before.cases[0].subjects[0].assessment.displacement.spread = 1e-9;
  auto now = before;
  now.cases[0].subjects[0].assessment.displacement.order = 2.009;
  EXPECT_FALSE(compare(now, before).subjects[0].order);
  now.cases[0].subjects[0].assessment.displacement.order = 2.011;
  EXPECT_TRUE(compare(now, before).subjects[0].order);
}

TEST(Baseline, ShowsAnErrorThatGrewAtTheFinestStepThatBothFinished) {
  // The finest step is the second run of the last level: 0.008 s, with error 0.6e-4.
  const auto grown = after([](auto& m) { m.levels[2].runs[1].score.u_error = 2.4e-4; });
  ASSERT_TRUE(grown.error);
  EXPECT_EQ(grown.error->step, 0.8 * 0.01);
  EXPECT_DOUBLE_EQ(grown.error->now / grown.error->before, 4.0);
  EXPECT_TRUE(after([](auto& m) { m.levels[2].runs[1].score.u_error = 0.5e-4; }).error);
  EXPECT_FALSE(after([](auto& m) { m.levels[2].runs[1].score.u_error *= 1.009; }).error);
  EXPECT_TRUE(after([](auto& m) { m.levels[2].runs[1].score.u_error *= 1.011; }).error);
  EXPECT_TRUE(after([](auto& m) { m.levels[2].runs[1].score.u_error = NAN; }).error);
  EXPECT_FALSE(after([](auto& m) { m.levels[0].runs[0].score.u_error = 1.0; }).error);

  // Of runs that one side did not finish, the next coarser step is compared.
  const auto failed = after([](auto& m) {
    m.levels[2].runs[1].score.finished = false;
    m.levels[2].runs[0].score.u_error = 1.0;
  });
  EXPECT_EQ(failed.error->step, 0.01);
  EXPECT_EQ(failed.finished->step, 0.8 * 0.01);
  EXPECT_TRUE(failed.finished->before);
  EXPECT_FALSE(failed.finished->now);
  const auto two_failed = after([](auto& m) {
    m.levels[0].runs[0].score.finished = false;
    m.levels[1].runs[0].score.finished = false;
  });
  EXPECT_EQ(two_failed.finished->step, 0.02);
}

TEST(Baseline, LeavesOutErrorsBelowTheRoundingFloors) {
  auto before = record_of({"rk4"});
  auto& old_run = before.cases[0].subjects[0].levels[2].runs[1].score;
  old_run.u_error = 1e-14;
  auto now = before;
  auto& run = now.cases[0].subjects[0].levels[2].runs[1].score;
  run.u_error = 2.9e-14;  // both floors are 1e-14
  EXPECT_FALSE(compare(now, before).subjects[0].error);
  run.u_error = 3.1e-14;
  EXPECT_TRUE(compare(now, before).subjects[0].error);
  old_run.u_error = run.u_error = NAN;
  EXPECT_FALSE(compare(now, before).subjects[0].error);
}

TEST(Baseline, ShowsImpactsThatAreMissedNowOfTheFinestSuchStep) {
  const auto missing = after([](auto& m) {
    m.levels[0].runs[0].score.impacts->missed = 3;
    m.levels[1].runs[1].score.impacts->missed = 2;
  });
  ASSERT_TRUE(missing.impacts);
  EXPECT_EQ(missing.impacts->step, 0.8 * 0.02);
  EXPECT_EQ(missing.impacts->before.missed, 0);
  EXPECT_EQ(missing.impacts->now.missed, 2);
  EXPECT_EQ(missing.impacts->now.expected, 6);
  EXPECT_EQ(after([](auto& m) { m.levels[1].runs[0].score.impacts->extra = 1; }).impacts->now.extra,
            1);
  EXPECT_FALSE(after([](auto& m) { m.levels[1].runs[0].score.impacts.reset(); }).impacts);
}

TEST(Baseline, ShowsWorkOfTheFinestStep) {
  const auto more = after([](auto& m) { m.levels[2].runs[1].score.work.force_evaluations = 5000; });
  ASSERT_TRUE(more.work);
  EXPECT_EQ(more.work->before, 2500);
  EXPECT_EQ(more.work->now, 5000);
  EXPECT_FALSE(after([](auto& m) { m.levels[2].runs[1].score.work.force_evaluations += 20; }).work);
}

TEST(Baseline, HoldsWhereItComesFromAndWhetherItWasInterrupted) {
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
  EXPECT_EQ(refused([](record::Record& r) { r.cases[0].problem.name = "stop"; }),
            "other-study: baseline: is of another case: --case stop --set N=2,xi1=0.05; this run: "
            "--case three-parameter --set N=2,xi1=0.05. Only the same case and the same steps can "
            "be compared; repeat one of the two with the options of the other.");
  EXPECT_NE(refused([](record::Record& r) {
              r.cases[0].problem.parameters[1].value = 0.1;
            }).find("other parameters: --case three-parameter --set N=2,xi1=0.1; this run"),
            std::string::npos);
  EXPECT_NE(refused([](record::Record& r) {
              r.cases[0].problem.parameters.pop_back();
            }).find("other parameters"),
            std::string::npos);
  EXPECT_NE(refused([](record::Record& r) {
              r.cases[0].problem.parameters[1].name = "xi";
            }).find("other parameters"),
            std::string::npos);
  EXPECT_NE(refused([](record::Record& r) {
              r.cases[0].problem.end = 21.0;
            }).find("another motion: 21 s, 6 impacts; this run: 20 s, 6 impacts"),
            std::string::npos);
  EXPECT_NE(refused([](record::Record& r) {
              r.cases[0].problem.impact_count = 7;
            }).find("another motion"),
            std::string::npos);
  EXPECT_NE(refused([](record::Record& r) { r.cases[0].plan.levels = 4; })
                .find("another ladder: --coarsest 0.04 --levels 4 --samples-per-level 2; this run: "
                      "--coarsest 0.04 --levels 3 --samples-per-level 2"),
            std::string::npos);
  EXPECT_NE(refused([](record::Record& r) { r.cases[0].plan.coarsest = 0.05; }).find("ladder"),
            std::string::npos);
  EXPECT_NE(
      refused([](record::Record& r) { r.cases[0].plan.samples_per_level = 3; }).find("ladder"),
      std::string::npos);
}

TEST(Baseline, MatchesSubjectsByCaseAndName) {
  auto before = record_of({"rk4"});
  before.cases.push_back(before.cases[0]);
  before.cases[1].problem.name = "stop";
  auto now = before;
  std::swap(now.cases[0], now.cases[1]);
  EXPECT_FALSE(compare(now, before).any());
  now.cases[0].subjects[0].levels[2].runs[1].score.u_error *= 2.0;
  now.cases[1].problem.name = "sdof";
  const auto changes = compare(now, before);
  ASSERT_EQ(changes.subjects.size(), 3u);
  EXPECT_EQ(changes.subjects[0].case_name, "stop");
  EXPECT_TRUE(changes.subjects[0].error.has_value());
  EXPECT_EQ(changes.subjects[1].case_name, "sdof");
  EXPECT_EQ(changes.subjects[1].presence, SubjectChange::Presence::added);
  EXPECT_EQ(changes.subjects[2].case_name, "three-parameter");
  EXPECT_EQ(changes.subjects[2].presence, SubjectChange::Presence::gone);
}

TEST(Baseline, OfTheOtherCommandIsRefused) {
  const auto now = record_of({"rk4"});
  auto other = now;
  other.command = "check";
  EXPECT_NE(
      refusal_of(now, other).find("another command: clackers check; this run: clackers verify"),
      std::string::npos);
}

TEST(Baseline, IsRefusedBeforeAnyRun) {
  VerifyRequest request;
  request.methods = {"rk4"};
  EXPECT_THROW(require_same_study(request, record::Record{}), InputError);
  request.plan = {0.5, 1, 1};
  auto record = verify(request);
  EXPECT_NO_THROW(require_same_study(request, record));
  request.settings = {{"xi1", 0.06}};
  EXPECT_THROW(require_same_study(request, record), InputError);
  const CheckRequest check;
  EXPECT_THROW(require_same_study(check, record), InputError);
  record.command = "check";
  EXPECT_THROW(require_same_study(check, record), InputError) << "of a ladder of steps";
  record.cases[0].plan = {0.0, 0, 0};
  EXPECT_NO_THROW(require_same_study(check, record));
}

}  // namespace
}  // namespace clackers::study
