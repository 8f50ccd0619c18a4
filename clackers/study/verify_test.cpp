#include "clackers/study/verify.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "clackers/base/error.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/record/record_json.hpp"

namespace clackers::study {
namespace {

// A mass above a stop, five levels of two steps: milliseconds.
VerifyRequest small(std::vector<std::string> methods) {
  VerifyRequest request;
  request.methods = std::move(methods);
  request.cases = {"stop"};
  request.settings = {{"t_end", 8.0}};
  request.plan = {0.1, 5, 2};
  request.command = "clackers verify";
  return request;
}

// What must not depend on the machine, the time of day or the number of threads.
std::string findings_of(record::Record record) {
  record.provenance = {};
  for (auto& one : record.cases)
    for (auto& subject : one.subjects)
      for (auto& level : subject.levels)
        for (auto& run : level.runs) run.score.seconds = 0.0;
  return to_json(record);
}

const std::vector<record::Subject>& subjects(const record::Record& record) {
  return record.cases.at(0).subjects;
}

std::string refusal(const VerifyRequest& request) {
  bool worked = false;
  try {
    verify(request, [&](double) { worked = true; });
  } catch (const InputError& error) {
    EXPECT_FALSE(worked) << "refused after work had begun";
    return std::string(error.what()) + " [" + std::string(error.code().name()) + "]";
  }
  return "accepted";
}

TEST(Verify, AssessesAdaptiveMethodsOverTolerances) {
  auto request = small({"dopri5", "rk4"});
  const auto record = verify(request);
  const auto& adaptive = subjects(record).at(0);
  EXPECT_EQ(adaptive.refined_by, record::RefinementParameter::tolerance);
  ASSERT_EQ(adaptive.levels.size(), 8u);
  for (std::size_t i = 0; i < adaptive.levels.size(); ++i) {
    const auto& level = adaptive.levels[i];
    EXPECT_NEAR(level.step * std::pow(10.0, 3.0 + double(i)), 1.0, 1e-12);
    ASSERT_EQ(level.runs.size(), 1u);
    EXPECT_EQ(level.runs[0].score.step, level.step);
    EXPECT_EQ(level.runs[0].score.impacts->matched, level.runs[0].score.impacts->expected);
  }
  EXPECT_EQ(adaptive.assessment.displacement.behaviour, Behaviour::proper);
  EXPECT_NEAR(adaptive.assessment.displacement.order, 1.0, 0.15);
  EXPECT_EQ(adaptive.claim.order, 1.0);
  EXPECT_EQ(adaptive.assessment.verdict, Verdict::agrees);
  EXPECT_FALSE(adaptive.refinement);
  EXPECT_EQ(subjects(record).at(1).refined_by, record::RefinementParameter::step);

  request.plan.tolerances = {1e-4, 1e-6};
  EXPECT_EQ(subjects(verify(request)).at(0).levels.size(), 2u);
  request.methods = {"rk4"};
  EXPECT_EQ(
      refusal(request),
      "verify: tolerances = 0.0001; allowed: those of a method that is adaptive, such as dopri5. "
      "[wrong-resolution]");
}

TEST(Verify, AnExactFlowClaimsToBeExactWithoutLoad) {
  const auto record = verify(small({"exponential"}));
  const auto& subject = subjects(record).at(0);
  EXPECT_EQ(subject.claim.behaviour, Behaviour::exact);
  EXPECT_EQ(subject.assessment.verdict, Verdict::agrees);
}

TEST(Verify, AssessesMethodsOverTheLevels) {
  const auto record = verify(small({"rk4", "newmark"}));
  EXPECT_FALSE(record.interrupted);
  ASSERT_EQ(subjects(record).size(), 2u);
  for (const auto& method : subjects(record)) {
    SCOPED_TRACE(method.name);
    EXPECT_TRUE(method.complete);
    EXPECT_TRUE(method.refusal.empty());
    EXPECT_EQ(method.contact_time, 0.0);
    EXPECT_EQ(method.assessment.displacement.behaviour, Behaviour::proper);
    EXPECT_EQ(method.assessment.verdict, Verdict::agrees);
    EXPECT_NEAR(method.assessment.displacement.order, method.claim.order, 0.1 * method.claim.order);
    ASSERT_EQ(method.levels.size(), 5u);
    for (std::size_t l = 0; l < 5; ++l) {
      const auto& level = method.levels[l];
      EXPECT_EQ(level.step, 0.1 / std::exp2(double(l)));
      ASSERT_EQ(level.runs.size(), 2u);
      EXPECT_GT(level.runs[0].score.step, level.runs[1].score.step);
      for (const auto& whole : level.runs) {
        const auto& run = whole.score;
        EXPECT_TRUE(run.finished);
        EXPECT_EQ(run.work.steps, std::llround(8.0 / run.step));
        EXPECT_EQ(8.0 / double(run.work.steps), run.step);
        ASSERT_TRUE(run.impacts.has_value());
        EXPECT_EQ(run.impacts->matched, 3);
        // A step takes between a nanosecond and a millisecond on anything that runs this.
        EXPECT_GT(run.seconds, 1e-9 * double(run.work.steps));
        EXPECT_LT(run.seconds, 1e-3 * double(run.work.steps));
      }
    }
  }
  EXPECT_EQ(exit_code(record), 0);
}

TEST(Verify, HoldsTheProblemAndItsProvenance) {
  const auto record = verify(small({"rk4"}));
  EXPECT_EQ(record.provenance.command, "clackers verify");
  EXPECT_FALSE(record.provenance.version.empty() || record.provenance.date.empty());
  const auto& problem = record.cases[0].problem;
  EXPECT_EQ(problem.name, "stop");
  EXPECT_EQ(problem.equations, "Eq. (5)-(6)");
  EXPECT_FALSE(problem.summary.empty());
  ASSERT_EQ(problem.parameters.size(), 3u);
  EXPECT_EQ(problem.parameters[2].name, "t_end");
  EXPECT_EQ(problem.parameters[2].value, 8.0);
  EXPECT_EQ(problem.parameters[2].unit, "s");
  EXPECT_FALSE(problem.parameters[2].meaning.empty());
  const auto has = [&](std::string_view name) {
    return std::ranges::count(problem.constants, name, &Quantity::name) == 1;
  };
  EXPECT_TRUE(has("omega_D1") && has("I_ms"));
  EXPECT_EQ(problem.end, 8.0);
  const double T = M_PI / std::sqrt(0.9975);
  EXPECT_NEAR(problem.fast_period, 2.0 * T, 1e-14);
  EXPECT_EQ(problem.impact_count, 3);
  ASSERT_EQ(problem.impact_times.size(), 3u);
  EXPECT_NEAR(problem.impact_times[2], 2.5 * T, 1e-14);
  EXPECT_EQ(record.cases[0].plan.levels, 5);
  EXPECT_EQ(record.cases[0].response.t.size(), 1501u);
  EXPECT_EQ(record.cases[0].response.t.back(), 8.0);
  EXPECT_EQ(record.cases[0].response.y.size(), 1u);
  EXPECT_EQ(record.cases[0].response.y[0][0], 1.0);
}

TEST(Verify, TakesTheFastMassForTheFastPeriod) {
  auto request = small({"rk4"});
  request.cases = {"three-parameter"};
  request.settings = {{"a_t", 0.2}};
  request.plan = {0.02, 1, 1};
  EXPECT_NEAR(verify(request).cases[0].problem.fast_period, 2.0 * M_PI / 9.0 / std::sqrt(0.9975),
              1e-15);
}

TEST(Verify, KeepsTheErrorAgainstTimeOfTheRunWithMetrics) {
  const auto record = verify(small({"newmark"}));
  const auto& method = subjects(record)[0];
  const auto& shown = method.levels[4].runs[0];
  ASSERT_EQ(method.shown_run(), &shown);
  ASSERT_EQ(shown.error_history.y.size(), 1u);
  const auto& errors = shown.error_history.y[0];
  EXPECT_EQ(errors.size(), shown.error_history.t.size());
  EXPECT_GT(errors.size(), 200u);
  EXPECT_LE(errors.size(), 400u);
  EXPECT_EQ(std::ranges::max(errors), shown.score.u_error);
  EXPECT_FALSE(shown.metrics.empty());
}

TEST(Verify, NamesMethodsAsOneWouldTypeThem) {
  const auto record = verify(small({"rk4+event-driven", "newmark:beta=0+penalty", "moreau-jean"}));
  EXPECT_EQ(subjects(record)[0].name, "rk4");
  EXPECT_EQ(subjects(record)[1].name.find("newmark:beta=0"), 0u) << subjects(record)[1].name;
  EXPECT_NE(subjects(record)[1].name.find("+penalty"), std::string::npos);
}

TEST(Verify, AssessesSeveralCasesInTheirOrder) {
  auto request = small({"rk4", "newmark"});
  request.cases = {"stop", "symmetric-pair"};
  const auto record = verify(request);
  ASSERT_EQ(record.cases.size(), 2u);
  EXPECT_EQ(record.cases[0].problem.name, "stop");
  EXPECT_EQ(record.cases[1].problem.name, "symmetric-pair");
  for (const auto& one : record.cases) {
    ASSERT_EQ(one.subjects.size(), 2u);
    EXPECT_EQ(one.subjects[1].name, "newmark");
    EXPECT_EQ(one.subjects[1].levels.size(), 5u);
    ASSERT_FALSE(one.profiles.empty());
  }
  ASSERT_FALSE(record.profiles.empty());
  EXPECT_EQ(record.profiles[0].tasks.size(),
            record.cases[0].profiles[0].tasks.size() + record.cases[1].profiles[0].tasks.size());
  request.cases.pop_back();
  EXPECT_TRUE(verify(request).profiles.empty()) << "that of one case is in the case";
}

TEST(Verify, DoesNotDependOnTheNumberOfThreads) {
  auto request = small({"rk4", "newmark+penalty", "moreau-jean"});
  request.cases = {"stop", "symmetric-pair"};
  request.jobs = 1;
  const auto one = findings_of(verify(request));
  request.jobs = 3;
  EXPECT_EQ(findings_of(verify(request)), one);
  request.jobs = 0;
  EXPECT_EQ(findings_of(verify(request)), one);
}

TEST(Verify, SurvivesItsJson) {
  const auto record = verify(small({"rk4"}));
  EXPECT_EQ(record::to_json(record::record_from_json(to_json(record))), to_json(record));
}

TEST(Verify, ReportsProgressUpToOne) {
  std::vector<double> shares;
  verify(small({"rk4", "newmark"}), [&](double share) { shares.push_back(share); });
  ASSERT_FALSE(shares.empty());
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_EQ(shares.back(), 1.0);
  EXPECT_GT(shares.front(), 0.0);
}

TEST(Verify, TakesTheDefaultPanelAndCaseWhenNothingIsNamed) {
  VerifyRequest request;
  request.plan = {0.05, 1, 1};
  const auto record = verify(request);
  EXPECT_EQ(record.cases[0].problem.name, "three-parameter");
  ASSERT_EQ(subjects(record).size(), methods::default_panel().size());
  EXPECT_EQ(subjects(record)[0].name, methods::default_panel()[0]);
  EXPECT_EQ(exit_code(record), 3) << "one level decides nothing";
}

TEST(Verify, KeepsAMethodThatObjectsWithItsReason) {
  auto request = small({"rk4", "newmark+penalty"});
  request.settings.emplace_back("eta", 0.5);
  const auto record = verify(request);
  EXPECT_TRUE(subjects(record)[0].refusal.empty());
  // The name stands beside it.
  EXPECT_TRUE(subjects(record)[1].refusal.starts_with("with eta = 0.5: the law linear"));
  EXPECT_EQ(subjects(record)[1].refusal_code, "penalty-needs-elastic");
  EXPECT_TRUE(subjects(record)[1].complete);
  EXPECT_TRUE(subjects(record)[1].levels.empty());
  EXPECT_FALSE(record.interrupted);
  EXPECT_EQ(exit_code(record), 0);
}

// Its impacts are at the ends of steps as well, but to locate them would not help.
TEST(Verify, LeavesToTheClaimWhyAMethodDoesNotConverge) {
  VerifyRequest request;
  request.methods = {"newmark-implicit-contact", "newmark+reversal"};
  request.cases = {"stop"};
  request.plan = {0.05, 6, 2};
  const auto record = verify(request);
  EXPECT_TRUE(subjects(record)[0].diagnoses.empty());
  EXPECT_FALSE(subjects(record)[1].diagnoses.empty());
}

TEST(Verify, RefusesWhenEveryMethodObjects) {
  auto request = small({"newmark+penalty"});
  request.settings.emplace_back("eta", 0.5);
  const auto text = refusal(request);
  EXPECT_NE(text.find("eta = 0.5"), std::string::npos) << text;
  EXPECT_NE(text.find("[penalty-needs-elastic]"), std::string::npos) << text;
}

TEST(Verify, CarriesTheContactTimeOfACompliantContact) {
  EXPECT_GT(subjects(verify(small({"newmark+penalty"})))[0].contact_time, 0.0);
}

TEST(Verify, HoldsMethodsToTheirSmoothOrderWhereNothingCollides) {
  auto free = small({"rk4", "newmark+penalty", "newmark+reversal"});
  free.cases = {"sdof"};
  auto early = free;
  early.cases = {"stop"};
  early.settings = {{"t_end", 1.5}};  // the first impact is at 1.573 s
  for (const auto& request : {free, early}) {
    const auto record = verify(request);
    for (const auto& method : subjects(record)) {
      EXPECT_EQ(method.claim.behaviour, Behaviour::proper) << method.name;
      EXPECT_EQ(method.claim.order, method.name[0] == 'r' ? 4.0 : 2.0) << method.name;
      EXPECT_TRUE(method.claim.reason.empty());
      EXPECT_EQ(method.contact_time, 0.0);
      EXPECT_EQ(method.assessment.verdict, Verdict::agrees);
    }
  }
}

TEST(Verify, RefusesBadPlansBeforeAnyWork) {
  const auto with = [](auto change) {
    auto request = small({"rk4"});
    change(request);
    return refusal(request);
  };
  EXPECT_EQ(with([](auto& r) { r.plan.coarsest = 0.0; }),
            "verify: coarsest = 0; allowed: 0 < coarsest <= 8 s, the length of the run. "
            "[step-not-positive]");
  EXPECT_EQ(with([](auto& r) { r.plan.coarsest = -0.5; }),
            "verify: coarsest = -0.5; allowed: 0 < coarsest <= 8 s, the length of the run. "
            "[step-not-positive]");
  EXPECT_EQ(with([](auto& r) { r.plan.coarsest = 8.5; }),
            "verify: coarsest = 8.5; allowed: 0 < coarsest <= 8 s, the length of the run. "
            "[step-not-positive]");
  EXPECT_EQ(with([](auto& r) { r.plan.coarsest = NAN; }),
            "verify: coarsest = nan; allowed: 0 < coarsest <= 8 s, the length of the run. "
            "[not-a-number]");
  EXPECT_EQ(with([](auto& r) { r.plan.coarsest = INFINITY; }),
            "verify: coarsest = inf; allowed: 0 < coarsest <= 8 s, the length of the run. "
            "[not-finite]");
  EXPECT_EQ(
      with([](auto& r) { r.plan.levels = 0; }),
      "verify: levels = 0; allowed: a whole number, 1 or more. A verdict needs at least four. "
      "[out-of-range]");
  for (const int samples : {0, 65})
    EXPECT_EQ(with([&](auto& r) { r.plan.samples_per_level = samples; }),
              "verify: samples per level = " + std::to_string(samples) +
                  "; allowed: 1 <= samples per level <= 64. [out-of-range]");
  for (const auto& text :
       {with([](auto& r) { r.plan.coarsest = 1e-12; }), with([](auto& r) { r.plan.levels = 40; }),
        with([](auto& r) { r.plan.levels = 2'000'000'000; }), with([](auto& r) {
          r.settings = {{"t_end", 1e9}};
        })}) {
    EXPECT_NE(text.find("at most 1e+09"), std::string::npos) << text;
    EXPECT_NE(text.find("[too-many-steps]"), std::string::npos) << text;
  }
  EXPECT_NE(with([](auto& r) { r.jobs = -1; }).find("verify: jobs = -1"), std::string::npos);
}

TEST(Verify, RefusesUnknownNamesBeforeAnyWork) {
  const auto with = [](auto change) {
    auto request = small({"rk4"});
    change(request);
    return refusal(request);
  };
  EXPECT_NE(with([](auto& r) {
              r.methods = {"rk4", "newmrak"};
            }).find("Did you mean \"newmark\"?"),
            std::string::npos);
  EXPECT_NE(with([](auto& r) { r.cases = {"stopp"}; }).find("Did you mean \"stop\"?"),
            std::string::npos);
  EXPECT_NE(with([](auto& r) {
              r.settings = {{"ta", 1.0}};
            }).find("[unknown-name]"),
            std::string::npos);
  EXPECT_NE(with([](auto& r) {
              r.settings = {{"eta", 1.5}};
            }).find("[out-of-range]"),
            std::string::npos);
  EXPECT_NE(with([](auto& r) {
              r.methods = {"rk4", "newmark", "rk4+event-driven"};
            }).find("method = rk4+event-driven; allowed: each method once."),
            std::string::npos);
}

TEST(Verify, RefusesACaseTwiceAndSettingsThatOneCaseLacks) {
  auto request = small({"rk4"});
  request.cases = {"stop", "stop"};
  EXPECT_NE(refusal(request).find("each case once"), std::string::npos);
  request.cases = {"stop", "one-parameter"};
  EXPECT_NE(refusal(request).find("[unknown-name]"), std::string::npos);
}

TEST(Verify, LeavesNothingUnmarkedWhenInterruptedBeforeItBegan) {
  const std::atomic<bool> interrupt = true;
  const auto record = verify(small({"rk4", "newmark"}), {}, &interrupt);
  EXPECT_TRUE(record.interrupted);
  EXPECT_EQ(exit_code(record), 130);
  for (const auto& method : subjects(record)) {
    EXPECT_FALSE(method.complete);
    EXPECT_TRUE(method.levels.empty());
    EXPECT_EQ(method.assessment.verdict, Verdict::undecided);
    EXPECT_EQ(method.assessment.displacement.reason, "interrupted");
    EXPECT_EQ(method.assessment.reason, "interrupted");
    EXPECT_FALSE(method.self_convergence.has_value());
  }
  EXPECT_FALSE(record.cases[0].response.t.empty());
}

TEST(Verify, KeepsFinishedRowsWhenInterruptedOnTheWay) {
  // Half of the work is the first method's.
  auto request = small({"rk4", "newmark"});
  request.jobs = 1;
  std::atomic<bool> interrupt = false;
  const auto stop_late = [&](double share) { interrupt = share > 0.5; };
  // Progress comes every 50 ms at most: steps so small that the second method takes longer.
  request.plan = {4e-6, 2, 1};
  const auto record = verify(request, stop_late, &interrupt);
  ASSERT_TRUE(record.interrupted);
  EXPECT_TRUE(subjects(record)[0].complete);
  EXPECT_EQ(subjects(record)[0].levels.size(), 2u);
  EXPECT_FALSE(subjects(record)[1].complete);
  EXPECT_LT(subjects(record)[1].levels.size(), 2u);
  for (const auto& level : subjects(record)[1].levels)
    for (const auto& run : level.runs) EXPECT_TRUE(run.score.finished);
}

TEST(Verify, EndsSoonAfterAnInterrupt) {
  // A single run of 4e8 steps, minutes long.
  auto request = small({"rk4"});
  request.plan = {2e-8, 1, 1};
  std::atomic<bool> interrupt = false;
  std::chrono::steady_clock::time_point asked;
  std::jthread user([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    asked = std::chrono::steady_clock::now();
    interrupt = true;
  });
  const auto record = verify(request, {}, &interrupt);
  const auto waited = std::chrono::steady_clock::now() - asked;
  EXPECT_TRUE(record.interrupted);
  // It takes a block of states, microseconds; the rest is left to a loaded machine under a
  // sanitizer. The run itself would take minutes.
  EXPECT_LT(std::chrono::duration<double>(waited).count(), 2.0);
}

}  // namespace
}  // namespace clackers::study
