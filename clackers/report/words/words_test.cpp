#include "clackers/report/words/words.hpp"

#include <gtest/gtest.h>

#include "clackers/base/codes.hpp"
#include "clackers/report/testing/sample_record.hpp"
#include "clackers/report/testing/written.hpp"

namespace clackers::report {
namespace {

study::Subject assessed(Behaviour behaviour, std::string reason = {}) {
  study::Subject subject;
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
  subject.assessment.evidence = {{"collisions-miscounted", Verdict::disagrees, {0.05, 5, 6, 1}}};
  EXPECT_TRUE(has(assessment_text(subject), "h = 0.05 s: 5 of 6 matched, 1 extra."));
  for (const auto* code :
       {"printed-digits", "within-tolerance", "beyond-tolerance", "tolerance-not-resolved",
        "other-start", "other-collisions", "sparse-rows"}) {
    subject.assessment.evidence = {{code, Verdict::undecided, {1e-3, 2e-3, 3e-3}}};
    EXPECT_GT(assessment_text(subject).size(), assessment_text(assessed(Behaviour::proper)).size())
        << code;
  }
}

TEST(AssessmentText, AClaimThatIsTooLowIsSaid) {
  auto subject = assessed(Behaviour::proper);
  subject.assessment.displacement.order = 4.0;
  subject.assessment.verdict = Verdict::disagrees;
  EXPECT_TRUE(has(assessment_text(subject), "converges faster"));
  subject.claim = {};
  EXPECT_TRUE(has(assessment_text(subject), "Nothing is claimed."));
}

TEST(ClaimText, HasBehaviourOrderAndReason) {
  EXPECT_EQ(claim_text({Behaviour::proper, 2.0, ""}), "proper, order 2");
  EXPECT_EQ(claim_text({Behaviour::stagnating, 0.0, "contact-stiffness"}),
            "stagnating [contact-stiffness]");
  EXPECT_EQ(claim_text({}), "nothing");
}

TEST(OrderText, NeedsALine) {
  assess::LadderFit fit;
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
  for (const auto& entry : study::note_entries) {
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
  EXPECT_TRUE(has(texts[0], "Also in 1 other history, with other numbers.")) << texts[0];
  EXPECT_TRUE(texts[1].starts_with("coarse.csv: The first row is at 0.02 s")) << texts[1];
  subject.levels[0].runs[0].file->notes[0] = subject.levels[1].runs[0].file->notes[0];
  EXPECT_FALSE(has(note_texts(subject)[0], "other history"));
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

TEST(VerdictLine, HistoriesWithALineGetAnExpectation) {
  auto record = sample_check();
  auto& assessment = record.cases[0].subjects[0].assessment;
  EXPECT_EQ(verdict_line(record).next, "clackers respond three-parameter --collisions");
  assessment.verdict = Verdict::not_claimed;
  assessment.displacement.behaviour = Behaviour::proper;
  assessment.displacement.reason.clear();
  assessment.displacement.has_line = true;
  assessment.displacement.order = 1.98;
  assessment.evidence.clear();
  EXPECT_EQ(verdict_line(record).next, "clackers check coarse.csv fine.csv --expect proper:2");
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
