#include "clackers/study/check.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "clackers/base/error.hpp"
#include "clackers/base/testing/refusal.hpp"
#include "clackers/study/testing/check_fixture.hpp"

namespace clackers::study {
namespace {

TEST_F(Check, FillsARecordOfOneCaseAndOneSubject) {
  CheckRequest request;
  request.subjects[0].files = {write(0.01)};
  request.command = "clackers check";
  const auto record = check(request);
  EXPECT_EQ(record.command, "check");
  EXPECT_EQ(record.provenance.command, "clackers check");
  ASSERT_EQ(record.cases.size(), 1u);
  EXPECT_EQ(record.cases[0].plan.levels, 0);
  ASSERT_EQ(record.cases[0].subjects.size(), 1u);
  const auto& subject = record.cases[0].subjects[0];
  EXPECT_EQ(subject.kind, record::SubjectKind::histories);
  EXPECT_EQ(subject.name, "histories");
  EXPECT_EQ(subject.assessment.verdict, Verdict::not_claimed);
  const auto* run = subject.shown_run();
  ASSERT_NE(run, nullptr);
  EXPECT_EQ(run->file->file, path_of(request.subjects[0].files[0]));
  EXPECT_EQ(run->file->rows, 2001);
  EXPECT_LT(run->score.u_error, 1e-14);
  EXPECT_EQ(run->score.impacts->matched, 6);
  EXPECT_TRUE(has(*run, "impacts-from-history"));
  EXPECT_FALSE(has(*run, "last-line-incomplete"));
  EXPECT_EQ(exit_code(record), 0);
}

TEST_F(Check, RefusesTheHistoryOfMoreMassesThanTheCaseHas) {
  CheckRequest request;
  request.case_name = "stop";
  request.subjects[0].files = {write(0.01)};
  EXPECT_REFUSED(check(request), "not-this-case", "displacements up to u2", "u1, the mass",
                 "another mesh");
}

// The motion decays by 1e-22. What is slower than 1e-12 of the beginning is rest for a reader of
// velocities; and of so many rows diagnosis keeps one in 667, between which the fast mass swings.
TEST_F(Check, FindsNothingWrongWithALongExactHistory) {
  CheckRequest request;
  request.settings = {{"a_t", 50.0}};
  const auto rows = numbers(0.001, 0.0, request.settings);
  request.subjects[0].files = {columns("long", rows)};
  const auto record = check(request);
  const auto& subject = record.cases.at(0).subjects[0];
  const auto& run = *subject.shown_run();
  EXPECT_EQ(run.file->rows, 1000001);
  EXPECT_GT(run.score.impacts->matched, 150);
  EXPECT_EQ(run.score.impacts->missed + run.score.impacts->extra, 0);
  EXPECT_TRUE(subject.diagnoses.empty());
  EXPECT_EQ(subject.assessment.verdict, Verdict::not_claimed);
}

TEST_F(Check, SeveralHistoriesAreLevelsCoarsestFirst) {
  CheckRequest request;
  for (const double h : {0.005, 0.01, 0.0025, 0.00125})
    request.subjects[0].files.push_back(write(h, 1.0));
  request.expect = claim_from("proper:2");
  const auto& record = check(request);
  const auto& subject = record.cases[0].subjects[0];
  ASSERT_EQ(subject.levels.size(), 4u);
  EXPECT_EQ(subject.levels[0].step, 0.01);
  EXPECT_EQ(subject.levels[3].step, 0.00125);
  EXPECT_EQ(subject.assessment.verdict, Verdict::agrees);
  EXPECT_NEAR(subject.assessment.displacement.order, 2.0, 0.01);
}

TEST_F(Check, SeveralSubjectsStandInOneRecordWithAProfile) {
  CheckRequest request;
  request.subjects = {{{write(0.01, 2.0), write(0.005, 2.0)}, "rough"},
                      {{write(0.01, 1.0), write(0.0025, 1.0)}, "fine"}};
  request.steps = {0.01, 0.005, 0.01, 0.0025};
  request.expect = claim_from("proper:2");
  const auto found = check(request).cases.at(0);
  ASSERT_EQ(found.subjects.size(), 2u);
  EXPECT_EQ(found.subjects[0].name, "rough");
  EXPECT_EQ(found.subjects[1].name, "fine");
  EXPECT_EQ(found.subjects[1].levels[1].step, 0.0025);
  // 20 s; the work is known by steps only.
  EXPECT_EQ(found.subjects[1].levels[1].runs[0].score.work.steps, 8000);
  for (const auto& subject : found.subjects) EXPECT_EQ(subject.claim.order, 2.0);
  ASSERT_EQ(found.profiles.size(), 1u);
  EXPECT_EQ(found.profiles[0].counter, "steps");
  EXPECT_EQ(found.profiles[0].methods[1].method, "fine");
}

TEST_F(Check, EverySubjectHasItsNameAndHistories) {
  CheckRequest request;
  const auto file = write(0.01);
  request.subjects = {{{file}, "A"}, {{file}, "A"}};
  EXPECT_REFUSED(check(request), "bad-syntax", "--name = A; allowed: each name once");
  request.subjects[1] = {{}, "B"};
  EXPECT_REFUSED(check(request), "bad-syntax", "--name = B; allowed: a name with one FILE");
  request.subjects[1].files = {file, file};
  EXPECT_REFUSED(check(request), "out-of-range", "check --name B: step of every history");
  request.steps = {0.01, 0.005};
  EXPECT_REFUSED(check(request), "wrong-size", "--steps = 2 of them; allowed: one a history, 3");
}

TEST_F(Check, NeighbouringStepsAreOneLevel) {
  CheckRequest request;
  for (const double h : {0.02, 0.0175, 0.015, 0.01, 0.0085})
    request.subjects[0].files.push_back(write(h, 1.0));
  const auto record = check(request);
  const auto& levels = record.cases[0].subjects[0].levels;
  ASSERT_EQ(levels.size(), 2u);
  EXPECT_EQ(levels[0].runs.size(), 3u);
  EXPECT_EQ(levels[1].runs.size(), 2u);
}

TEST_F(Check, AHistoryThatIsNotFiniteIsAFailedRun) {
  CheckRequest request;
  for (const double h : {0.005, 0.0025}) request.subjects[0].files.push_back(write(h, 1.0));
  request.subjects[0].files.push_back(write(0.01, 1.0, "\n20.0,inf,0,0,0\n"));
  const auto record = check(request);
  const auto& levels = record.cases[0].subjects[0].levels;
  ASSERT_EQ(levels.size(), 3u);
  const auto& score = levels[0].runs[0].score;
  EXPECT_EQ(score.step, 0.01);
  EXPECT_FALSE(score.finished);
  EXPECT_EQ(score.failure_code, "not-finite");
  EXPECT_NE(score.failure.find("u1 = \"inf\""), std::string::npos) << score.failure;
  EXPECT_TRUE(levels[1].runs[0].score.finished);
  request.subjects[0].files = {request.subjects[0].files[2]};
  EXPECT_REFUSED(check(request), "not-finite", "u1 = \"inf\"");
}

TEST_F(Check, TolerancesAreLevels) {
  CheckRequest request;
  for (const double h : {0.01, 0.005, 0.0025}) request.subjects[0].files.push_back(write(h, 1.0));
  request.tolerances = {1e-3, 1e-5, 1e-7};
  const auto record = check(request);
  const auto& subject = record.cases[0].subjects[0];
  EXPECT_EQ(subject.refined_by, record::RefinementParameter::tolerance);
  ASSERT_EQ(subject.levels.size(), 3u);
  EXPECT_EQ(subject.levels[2].step, 1e-7);
  request.steps = {0.01, 0.005, 0.0025};
  EXPECT_REFUSED(check(request), "bad-syntax", "--steps and --tolerances");
  request.steps.clear();
  request.tolerances[1] = 1.0;
  EXPECT_REFUSED(check(request), "out-of-range", "0 < tolerance < 1");
}

TEST_F(Check, ALastLineWithoutLineFeedIsNoted) {
  CheckRequest request;
  request.subjects[0].files = {write(0.01, 0.0, "")};
  const auto record = check(request);
  EXPECT_TRUE(has(*record.cases[0].subjects[0].shown_run(), "last-line-incomplete"));
}

TEST_F(Check, ProgressRisesToOne) {
  CheckRequest request;
  request.subjects[0].files = {write(0.01), write(0.005)};
  std::vector<double> shares;
  check(request, [&](double share) { shares.push_back(share); });
  ASSERT_FALSE(shares.empty());
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_EQ(shares.back(), 1.0);
}

TEST_F(Check, StopsAfterAnInterrupt) {
  CheckRequest request;
  request.subjects[0].files = {write(0.01)};
  const std::atomic<bool> interrupt = true;
  try {
    check(request, {}, &interrupt);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code("interrupted"));
  }
}

TEST_F(Check, StandardInputServesOneFile) {
  CheckRequest request;
  request.subjects[0].files = {"-", "-"};
  EXPECT_THROW(check(request), InputError);
}

TEST(CheckExpectation, IsABehaviourWithAnOrderWhereItNeedsOne) {
  EXPECT_EQ(claim_from("proper:2").behaviour, Behaviour::proper);
  EXPECT_EQ(claim_from("irregular:1.5").order, 1.5);
  EXPECT_EQ(claim_from("exact").behaviour, Behaviour::exact);
  for (const auto* text : {"proper", "proper:", "proper:x", "proper:2x", "exact:2", "undecided",
                           "proper:0", "proper:-1", "proper:nan", "nothing", "",
                           "stagnating:", "stagnating:2", "stagnating:wrong-limit"})
    EXPECT_THROW(claim_from(text), InputError) << text;
  EXPECT_EQ(claim_from("stagnating").reason, "");
  EXPECT_EQ(claim_from("velocity:1").behaviour, Behaviour::undecided);
  EXPECT_EQ(claim_from("proper:2,velocity:1.5").order, 2.0);
  EXPECT_EQ(claim_from("proper:2,velocity:1.5").velocity_order, 1.5);
  EXPECT_EQ(claim_from("stagnating:contact-stiffness").reason, "contact-stiffness");
}

}  // namespace
}  // namespace clackers::study
