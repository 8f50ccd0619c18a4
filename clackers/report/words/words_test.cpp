#include "clackers/report/words/words.hpp"

#include <gtest/gtest.h>

#include "clackers/base/codes.hpp"
#include "clackers/report/testing/sample_record.hpp"
#include "clackers/report/testing/written.hpp"

namespace clackers::report {
namespace {

record::Subject assessed(Behaviour behaviour, std::string reason = {}) {
  record::Subject subject;
  subject.claim = {Behaviour::proper, 2.0, ""};
  auto& fit = subject.assessment.displacement;
  fit.behaviour = behaviour;
  fit.reason = std::move(reason);
  fit.has_line = behaviour == Behaviour::proper || behaviour == Behaviour::reduced ||
                 behaviour == Behaviour::irregular;
  fit.order = 1.036;
  fit.spread = 0.071;
  fit.scatter = 23.4;
  fit.floor = 0.0345;
  fit.first_level = 1;
  fit.last_level = 2;
  fit.steps = {0.1, 0.05, 0.025};
  return subject;
}

TEST(Counted, OneIsSingularAndOthersArePlural) {
  EXPECT_EQ(counted(1, "method"), "1 method");
  EXPECT_EQ(counted(0, "method"), "0 methods");
  EXPECT_EQ(counted(2, "history"), "2 histories");
}

TEST(AssessmentText, TheAnswerIsFirstAndTheNumbersFollow) {
  using enum Behaviour;
  EXPECT_TRUE(assessment_text(assessed(exact)).starts_with("Exact:"));
  EXPECT_TRUE(assessment_text(assessed(proper))
                  .starts_with("Converges with order 1.04 ±0.07 (h = 0.05 s to 0.025 s)."));
  EXPECT_TRUE(has(assessment_text(assessed(irregular)), "up to a factor 23"));
  EXPECT_TRUE(
      assessment_text(assessed(stagnating)).starts_with("Stagnates at an error in u of 3.5e-2"));
  for (const auto behaviour : {exact, proper, reduced, irregular, stagnating, divergent, undecided})
    EXPECT_TRUE(has(assessment_text(assessed(behaviour)), " Claimed: proper, order 2"))
        << int(behaviour);
}

TEST(AssessmentText, AReasonIsExplainedAsItsCodeIs) {
  const auto text = assessment_text(assessed(Behaviour::undecided, "too-few-levels"));
  EXPECT_TRUE(has(text, Code("too-few-levels").meaning())) << text;
}

TEST(AssessmentText, TheFirstFailureIsQuoted) {
  auto subject = assessed(Behaviour::undecided, "run-failed");
  subject.levels.resize(1);
  subject.levels[0].runs.resize(1);
  subject.levels[0].runs[0].score.step = 0.05;
  subject.levels[0].runs[0].score.failure = "left the finite numbers at t = 3 s.";
  EXPECT_TRUE(has(assessment_text(subject),
                  "First failure, h = 0.05 s: left the finite numbers at t = 3 s."));
}

TEST(AssessmentText, EvidenceIsGivenWithItsNumbers) {
  auto subject = assessed(Behaviour::proper);
  subject.assessment.evidence = {{"impacts-miscounted", Verdict::disagrees, {0.05, 5, 6, 1}}};
  EXPECT_TRUE(has(assessment_text(subject), "h = 0.05 s: 5 of 6 matched, 1 extra."));
  for (const auto code : std::to_array<judge::EvidenceCode>(
           {"printed-digits", "within-tolerance", "beyond-tolerance", "tolerance-not-resolved",
            "other-start", "other-impacts", "sparse-rows"})) {
    subject.assessment.evidence = {judge::evidence(code, Verdict::undecided, {1e-3, 2e-3, 3e-3})};
    EXPECT_GT(assessment_text(subject).size(), assessment_text(assessed(Behaviour::proper)).size())
        << code.name();
  }
}

TEST(AssessmentText, AClaimThatIsTooLowIsSaid) {
  auto subject = assessed(Behaviour::proper);
  subject.assessment.displacement.order = 4.0;
  subject.assessment.verdict = Verdict::disagrees;
  EXPECT_FALSE(has(assessment_text(subject), "converges faster")) << "impacts may be the cause";
  subject.assessment.mismatch = judge::Mismatch::higher_order;
  EXPECT_TRUE(has(assessment_text(subject), "converges faster"));
  subject.claim = {};
  EXPECT_TRUE(has(assessment_text(subject), "Nothing is claimed."));
}

TEST(AssessmentText, ALineMayEndAtAFloor) {
  auto subject = assessed(Behaviour::proper);
  auto& fit = subject.assessment.displacement;
  fit.largest_step = 0.05;
  fit.smallest_step = 0.0032;
  fit.floor = 3e-8;
  fit.floor_step = 0.003;
  EXPECT_TRUE(assessment_text(subject).starts_with(
      "Converges with order 1.04 ±0.07 (h = 0.05 s to 0.0032 s; from h = 0.003 s on a floor of "
      "3.0e-8)."))
      << assessment_text(subject);
}

TEST(AssessmentText, RemarksFollowTheFit) {
  auto subject = assessed(Behaviour::irregular);
  subject.assessment.evidence = {{"commensurate-steps", Verdict::not_claimed, {0.25}},
                                 {"errors-cancel", Verdict::not_claimed, {0.003}},
                                 {"unstable-coarse-steps", Verdict::not_claimed, {0.02}},
                                 {"steps-per-contact", Verdict::not_claimed, {21.0, 0.01}},
                                 {"more-samples", Verdict::not_claimed, {1.1, 0.49}},
                                 {"velocity-order-lower", Verdict::not_claimed, {0.999, 2.0}}};
  const auto text = assessment_text(subject);
  EXPECT_TRUE(text.starts_with("Converges irregularly")) << text;
  for (const auto* words :
       {"25 % of the runs are at the rounding floor because", "passes zero near h = 0.003 s.",
        "Runs above h = 0.02 s fail", "A contact, or a reversal of regular friction, has 21 steps.",
        "uncertain by ±0.49", "Velocities converge with order 1.00."})
    EXPECT_TRUE(has(text, words)) << words;
}

TEST(AssessmentText, ACauseThatIsShownIsNotSaidAgain) {
  auto subject = assessed(Behaviour::stagnating);
  auto& fit = subject.assessment.displacement;
  fit.has_line = false;
  fit.floor = 0.069;
  fit.reason = "wrong-limit";
  subject.assessment.evidence = {{"velocity-order-lower", Verdict::not_claimed, {0.999, 2.0}}};
  EXPECT_TRUE(has(assessment_text(subject), "a limit that is not the true motion"));
  EXPECT_TRUE(has(assessment_text(subject), "Velocities converge with order 1.00."));
  // The dissipation of a method does not explain a wrong limit.
  subject.diagnoses = {{"numerical-damping", -0.01, "1", 0.9, {}, "", ""}};
  EXPECT_TRUE(has(assessment_text(subject), "a limit that is not the true motion"));
  subject.diagnoses = {{"restitution-differs", 0.97, "1", 0.9, {}, "", ""},
                       {"velocity-order-lower", 1.0, "1", 0.9, {}, "", ""}};
  EXPECT_TRUE(has(assessment_text(subject), "Stagnates at an error in u of 6.9e-2"));
  EXPECT_FALSE(has(assessment_text(subject), "a limit that is not the true motion"));
  EXPECT_FALSE(has(assessment_text(subject), "Velocities converge"));
}

TEST(AssessmentText, AnOrderBelowItsUncertaintyIsNotSaid) {
  auto subject = assessed(Behaviour::stagnating);
  auto& fit = subject.assessment.displacement;
  fit.has_line = true;
  fit.floor = 0.34;
  fit.order = 0.25;
  fit.spread = 0.51;
  EXPECT_TRUE(assessment_text(subject).starts_with("Stagnates at an error in u of 3.4e-1"));
  fit.spread = 0.1;
  EXPECT_TRUE(assessment_text(subject).starts_with("Converges with order 0.25 ±0.10"));
}

TEST(AssessmentText, AnEarlyEndIsSaidFirst) {
  auto subject = assessed(Behaviour::proper);
  subject.assessment.evidence = {{"ends-early", Verdict::undecided, {1.0, 20.0, 0.0, 6.0}}};
  EXPECT_TRUE(assessment_text(subject).starts_with(
      "The history ends at 1 s of 20 s, with 0 of 6 impacts."));
}

TEST(AssessmentText, ALadderOfTolerancesHasTheRatioOfTheError) {
  auto subject = assessed(Behaviour::proper);
  subject.refined_by = record::RefinementParameter::tolerance;
  auto& fit = subject.assessment.displacement;
  fit.steps = {1e-3, 1e-4, 1e-5};
  subject.assessment.evidence = {{"error-over-tolerance", Verdict::not_claimed, {12.0, 9.0, 15.0}}};
  EXPECT_TRUE(
      has(assessment_text(subject),
          "(tolerance 0.0001 to 1e-5). The error is proportional to the tolerance. It is 12 "
          "times the tolerance (9 to 15)."))
      << assessment_text(subject);
}

record::Subject histories(std::vector<double> steps, std::string reason = {}) {
  auto subject = assessed(Behaviour::undecided, std::move(reason));
  subject.kind = record::SubjectKind::histories;
  for (const double step : steps) {
    auto& run = subject.levels.emplace_back(record::Level{step, {}}).runs.emplace_back();
    run.score.step = step;
    run.score.finished = true;
    run.score.u_error = 0.023;
    run.score.impacts = measure::ImpactScore{6, 6, 5, 1, 1, 0.0, 0.0};
  }
  return subject;
}

TEST(HintText, OfOneFileHasTheErrorAndTheStepsToAdd) {
  EXPECT_EQ(hint_text(histories({0.01})),
            "The largest error in u is 2.3 % of the largest envelope. 5 of 6 impacts matched, 1 "
            "extra. One step gives no order: add the same run at h = 0.005, 0.0025 and 0.00125 s; "
            "at least four are needed.");
}

TEST(HintText, OfFewLevelsHasTheMissingOnes) {
  EXPECT_EQ(hint_text(histories({0.02, 0.01}, "too-few-levels")),
            "2 levels; at least 4 are needed: add the same run at h = 0.005 and 0.0025 s.");
  auto subject = histories({1e-3, 1e-4}, "too-few-levels");
  subject.refined_by = record::RefinementParameter::tolerance;
  EXPECT_TRUE(has(hint_text(subject), "at tolerances 1e-5 and 1e-6."));
}

TEST(HintText, OfOneStepALevelHasThoseBetween) {
  const auto subject = histories({0.02, 0.01, 0.005, 0.0025}, "no-convergence-yet");
  EXPECT_TRUE(has(hint_text(subject), "as h = 0.0168, 0.0141 and 0.0119 s between the first two."))
      << hint_text(subject);
  EXPECT_FALSE(has(assessment_text(subject), "--levels")) << "no option of check";
}

TEST(RefinementText, SaysWhatWasAddedAndWhatItWouldTake) {
  auto subject = assessed(Behaviour::undecided, "too-few-levels");
  EXPECT_EQ(refinement_text(subject), "");
  subject.levels.resize(11);
  subject.refinement = {3, 0, 8, record::RefinementEnd::budget, 40.0};
  EXPECT_EQ(
      refinement_text(subject),
      "3 finer levels were added (11 in all). The next level takes about 40 s: --budget 60s.");
}

TEST(ClaimText, HasBehaviourOrderAndReason) {
  EXPECT_EQ(claim_text({Behaviour::proper, 2.0, ""}), "proper, order 2");
  EXPECT_EQ(claim_text({Behaviour::stagnating, 0.0, "contact-stiffness"}),
            "stagnating [contact-stiffness]");
  EXPECT_EQ(claim_text({}), "nothing");
}

TEST(OrderText, NeedsALine) {
  judge::LadderFit fit;
  EXPECT_EQ(order_text(fit), "");
  fit.has_line = true;
  fit.order = 1.996;
  fit.spread = 12.3;
  EXPECT_EQ(order_text(fit), "2.00 ±12");
}

TEST(Finding, AMethodThatIsAsClaimedHasNone) {
  const auto record = sample_record();
  const auto& subjects = record.cases[0].subjects;
  EXPECT_FALSE(finding(subjects[0]));
  EXPECT_EQ(finding(subjects[3])->code, "reduced");
  EXPECT_EQ(finding(subjects[5])->code, "contact-stiffness");
  EXPECT_EQ(finding(subjects[6])->code, "interrupted");
  EXPECT_EQ(finding(subjects[7])->code, "penalty-needs-elastic");
}

TEST(FalseConvergence, TheDistanceOfTheLimitIsGiven) {
  auto subject = sample_record().cases[0].subjects[5];
  EXPECT_EQ(false_convergence(subject)->code, "wrong-limit");
  EXPECT_TRUE(has(false_convergence(subject)->sentence, "a limit 0.0031 away"));
  auto& comparison = subject.self_convergence->against_reference;
  comparison.reason.clear();
  EXPECT_TRUE(has(false_convergence(subject)->sentence, "2.1e4 times the estimate"));
  comparison.false_convergence = false;
  EXPECT_FALSE(false_convergence(subject));
}

TEST(NoteText, EveryCodeHasASentenceOfItsOwn) {
  for (const auto& entry : record::note_entries) {
    const auto text = note_text({std::string(entry.code), {17.0, 1.0, 3.0, 4.0, 5.0}, "<name>"});
    EXPECT_NE(text, entry.code);
    EXPECT_TRUE(text.ends_with('.')) << text;
    EXPECT_EQ(has(text, "<name>"), !entry.text.empty()) << text;
  }
}

TEST(NoteTexts, OneForEachCode) {
  auto subject = sample_check().cases[0].subjects[0];
  const auto texts = note_texts(subject);
  ASSERT_EQ(texts.size(), 2u);
  EXPECT_EQ(texts[0], "No events file: impacts were found in the history itself.");
  EXPECT_TRUE(texts[1].starts_with("coarse.csv: The first row is at 0.02 s")) << texts[1];
  auto& numbers = subject.levels[0].runs[0].file->notes[0].numbers;
  numbers.resize(5);
  numbers[4] = 0.01;
  EXPECT_TRUE(has(note_texts(subject)[0], "Also in 1 other history, with other numbers."));
}

TEST(NoteTexts, OfASolverNameItsRun) {
  auto subject = sample_check().cases[0].subjects[0];
  subject.kind = record::SubjectKind::program;
  subject.name = "mine";
  subject.levels[0].runs[0].score.step = 0.02;
  EXPECT_TRUE(note_texts(subject)[1].starts_with("mine at h = 0.02 s: The first row"));
  subject.refined_by = record::RefinementParameter::tolerance;
  EXPECT_TRUE(note_texts(subject)[1].starts_with("mine at tolerance 0.02: The first row"));
}

TEST(VerdictLine, TheFirstWordThatHoldsIsTheVerdict) {
  auto record = sample_record();
  EXPECT_EQ(verdict_line(record).word, "interrupted");
  EXPECT_EQ(verdict_line(record).counts,
            "Of 8 methods: 5 agree, 1 disagrees, 1 refused, 1 interrupted.");
  record.interrupted = false;
  auto& subjects = record.cases[0].subjects;
  EXPECT_EQ(verdict_line(record).word, "disagrees");
  EXPECT_EQ(verdict_line(record).next, "clackers explain reduced");
  subjects[3].assessment.verdict = Verdict::agrees;
  subjects[0].assessment.verdict = Verdict::undecided;
  subjects[0].assessment.reason = "too-few-levels";
  EXPECT_EQ(verdict_line(record).word, "undecided");
  EXPECT_EQ(verdict_line(record).next, "clackers explain too-few-levels");
  subjects[0].assessment = subjects[1].assessment;
  EXPECT_EQ(verdict_line(record).word, "agrees");
}

TEST(VerdictLine, APageIsProposedOnce) {
  auto record = sample_record();
  record.interrupted = false;
  std::erase_if(record.cases[0].subjects,
                [](const auto& subject) { return finding(subject).has_value(); });
  for (const auto* command : {"clackers verify", "clackers verify rk4:report=1"}) {
    record.provenance.command = command;
    EXPECT_EQ(verdict_line(record).next, std::string(command) + " --report report.html");
  }
  for (const auto* command :
       {"clackers verify --report x.html", "clackers verify --report=x.html"}) {
    record.provenance.command = command;
    EXPECT_EQ(verdict_line(record).next, "clackers explain proper");
  }
}

TEST(VerdictLine, OfACallOfPythonTheNextStepIsPython) {
  auto record = sample_check();
  record.provenance.command = "clackers.check(t, u)";
  const auto next = [&] { return verdict_line(record).next; };
  EXPECT_EQ(next(), "clackers.case(\"three-parameter\").impacts()");
  auto& assessment = record.cases[0].subjects[0].assessment;
  assessment.verdict = Verdict::not_claimed;
  assessment.displacement.behaviour = Behaviour::proper;
  assessment.displacement.reason.clear();
  assessment.displacement.has_line = true;
  assessment.displacement.order = 1.98;
  assessment.evidence.clear();
  EXPECT_EQ(next(), "the same with expect='proper:2'");
  assessment.displacement.order = 1.75;
  EXPECT_EQ(next(), "record.save(\"report.html\")");
  record.cases[0].subjects[0].diagnoses = {{"restitution-differs", 0.99, "1", 0.9, {}, "", ""}};
  assessment.verdict = Verdict::disagrees;
  EXPECT_EQ(next(), "clackers.explain(\"restitution-differs\")");
  record.interrupted = true;
  EXPECT_EQ(verdict_line(record).next_in_words, "the same call again");
}

TEST(VerdictLine, OfACallOfPythonOptionsAreArguments) {
  auto record = sample_record();
  record.interrupted = false;
  record.provenance.command = "clackers.verify('rk4')";
  auto& problem = record.cases[0];
  problem.subjects.resize(1);
  auto& subject = problem.subjects[0];
  subject.diagnoses.clear();
  subject.assessment.verdict = Verdict::undecided;
  subject.assessment.displacement.behaviour = Behaviour::undecided;
  subject.assessment.displacement.reason = subject.assessment.reason = "too-few-levels";
  problem.plan.coarsest = 0.09;  // a fourteenth of the fast period
  subject.refinement = {.end = record::RefinementEnd::budget, .next_seconds = 40.0};
  EXPECT_EQ(verdict_line(record).next, "the same with budget=60");
}

TEST(VerdictLine, HistoriesWithALineGetAnExpectation) {
  auto record = sample_check();
  auto& assessment = record.cases[0].subjects[0].assessment;
  EXPECT_EQ(verdict_line(record).next, "clackers respond three-parameter --impacts");
  assessment.verdict = Verdict::not_claimed;
  assessment.displacement.behaviour = Behaviour::proper;
  assessment.displacement.reason.clear();
  assessment.displacement.has_line = true;
  assessment.displacement.order = 1.98;
  assessment.evidence.clear();
  EXPECT_EQ(verdict_line(record).next, "clackers check coarse.csv fine.csv --expect proper:2");
}

TEST(VerdictLine, AnOrderThatIsNoHalfNumberIsNotExpected) {
  auto record = sample_check();
  auto& assessment = record.cases[0].subjects[0].assessment;
  assessment.verdict = Verdict::not_claimed;
  assessment.displacement.behaviour = Behaviour::proper;
  assessment.displacement.reason.clear();
  assessment.displacement.has_line = true;
  assessment.evidence.clear();
  assessment.displacement.order = 1.51;
  EXPECT_EQ(verdict_line(record).next, "clackers check coarse.csv fine.csv --expect proper:1.5");
  assessment.displacement.order = 1.75;
  EXPECT_EQ(verdict_line(record).next, "clackers check coarse.csv fine.csv --report report.html");
  record.cases[0].subjects[0].diagnoses = {{"restitution-differs", 0.99, "1", 0.9, {}, "", ""}};
  assessment.verdict = Verdict::disagrees;
  EXPECT_EQ(verdict_line(record).next, "clackers explain restitution-differs");
}

TEST(VerdictLine, FailedRunsThatDecideStandBeforeCauses) {
  auto record = sample_check();
  auto& subject = record.cases[0].subjects[0];
  subject.diagnoses = {{"restitution-differs", 0.99, "1", 0.9, {}, "", ""}};
  EXPECT_TRUE(opening_line(record).has_cause);
  subject.assessment.verdict = Verdict::undecided;
  subject.assessment.evidence.clear();
  subject.assessment.displacement.behaviour = Behaviour::undecided;
  subject.assessment.reason = subject.assessment.displacement.reason = "run-failed";
  EXPECT_FALSE(opening_line(record).has_cause);
  EXPECT_TRUE(opening_line(record).text.ends_with("[run-failed]")) << opening_line(record).text;
  EXPECT_EQ(verdict_line(record).next, "clackers explain run-failed");
}

TEST(VerdictLine, NamesNoCauseThatTheClaimAllows) {
  auto record = sample_check();
  auto& subject = record.cases[0].subjects[0];
  subject.assessment.verdict = Verdict::disagrees;
  subject.claim = {Behaviour::irregular, 1.0, ""};
  subject.diagnoses = {{"impact-at-step-end", 0.5, "steps", 0.95, {}, "end", ""},
                       {"unstable-coarse-steps", 0.1, "s", 0.95, {}, "", ""}};
  EXPECT_EQ(deciding_cause(subject), nullptr);
  subject.claim = {Behaviour::proper, 2.0, ""};
  EXPECT_EQ(deciding_cause(subject), subject.diagnoses.data());
  std::ranges::reverse(subject.diagnoses);
  EXPECT_EQ(deciding_cause(subject), &subject.diagnoses[1]);
  subject.claim = {Behaviour::irregular, 1.0, ""};
  subject.diagnoses.push_back({"mass-ratio-differs", 2.0, "%", 0.9, {}, "", ""});
  EXPECT_EQ(deciding_cause(subject), &subject.diagnoses[2]);
}

TEST(VerdictLine, AnUndecidedMethodGetsTheNumberToType) {
  auto record = sample_record();
  record.interrupted = false;
  auto& problem = record.cases[0];
  problem.subjects.erase(problem.subjects.begin() + 1, problem.subjects.end());
  auto& subject = problem.subjects[0];
  subject.assessment.verdict = Verdict::undecided;
  subject.assessment.displacement.behaviour = Behaviour::undecided;
  subject.assessment.reason = subject.assessment.displacement.reason = "no-convergence-yet";
  subject.refinement = record::Refinement{1, 0, 8, record::RefinementEnd::budget, 40.0};
  record.provenance.command = "clackers verify rk4 --budget 20s --levels 5";
  EXPECT_EQ(verdict_line(record).next, "clackers verify rk4 --levels 5 --budget 60s");
  // A fast period of 1.4 s has 14 steps of 0.1 s.
  problem.problem.fast_period = 1.4;
  problem.plan.coarsest = 0.4;
  record.provenance.command =
      "clackers verify --exec './s.sh {h} --coarsest 3 -q' --coarsest 3 --name s";
  EXPECT_EQ(verdict_line(record).next,
            "clackers verify --exec './s.sh {h} --coarsest 3 -q' --name s --coarsest 0.1");
  record.provenance.command = "clackers verify rk4 --coarsest=0.4";
  EXPECT_EQ(verdict_line(record).next, "clackers verify rk4 --coarsest 0.1");
  EXPECT_EQ(verdict_line(record).next_in_words,
            "the same with --coarsest 0.1 (14 steps a fast period)");
}

TEST(VerdictLine, ExchangedColumnsGetTheOptionThatReadsThem) {
  auto record = sample_check();
  record.cases[0].subjects[0].diagnoses = {
      {"masses-exchanged", 1.0, "1", 0.9, {}, "t,u2,v2,u1,v1", ""}};
  EXPECT_EQ(verdict_line(record).next,
            "clackers check coarse.csv fine.csv --columns t,u2,v2,u1,v1");
}

TEST(CaseText, HasTheParametersWithUnits) {
  const auto record = sample_record();
  EXPECT_EQ(case_text(record.cases[0].problem), "three-parameter (N = 2, xi1 = 0.05, a_t = 1 m)");
  EXPECT_EQ(plan_text(record.cases[0]),
            "8 levels of 8 steps, h = 0.05 s to 0.000391 s, 25.16 to 3221 steps per fast period");
  EXPECT_EQ(plan_text(sample_check().cases[0]), "");
}

}  // namespace
}  // namespace clackers::report
