#include <gtest/gtest.h>

#include "clackers/diagnose/diagnosis.hpp"
#include "clackers/report/testing/sample_record.hpp"
#include "clackers/report/testing/written.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

using diagnose::Diagnosis;

std::string text(const Diagnosis& cause) { return diagnosis_text(cause).sentence; }

TEST(DiagnosisText, HasValueUncertaintyGainAndCure) {
  const Diagnosis cause{
      "restitution-differs",
      0.99,
      "1",
      0.99,
      {{"gain", 9e7}, {"runner-up-gain", 6.0}, {"uncertainty", 1e-4}, {"expected", 1.0}},
      "",
      "damping-differs"};
  EXPECT_EQ(text_of(diagnosis_text(cause)),
            "Restitution looks like 0.9900 ±0.0001 instead of 1 (9e7 times closer; "
            "damping-differs: 6 times): check the impact law and its coefficient. "
            "[restitution-differs]");
}

TEST(DiagnosisText, TellsWhatShareOfTheErrorStaysUnexplained) {
  Diagnosis cause{"damping-differs", 10.0, "%", 0.9, {{"gain", 49.0}}, "", ""};
  EXPECT_TRUE(has(text(cause), " (2 % of the error stays unexplained): ")) << text(cause);
  cause.evidence[0].value = 50.0;
  EXPECT_TRUE(has(text(cause), " (50 times closer): ")) << text(cause);
}

TEST(DiagnosisText, RelativeChangesAreInPercent) {
  Diagnosis cause{"frequency-differs", 0.00498, "1", 0.9, {{"mass", 2.0}}, "", ""};
  EXPECT_TRUE(text(cause).starts_with("The natural frequency of mass 2 differs by +0.498 %: "))
      << text(cause);
  cause = {"damping-differs", -1.5, "%", 0.9, {{"uncertainty", 0.1}}, "", ""};
  EXPECT_TRUE(text(cause).starts_with("Damping differs by -1.5 ±0.1 %: ")) << text(cause);
  cause = {"period-error", -0.002, "1", 0.9, {{"order", 2.0}}, "", ""};
  EXPECT_TRUE(text(cause).starts_with(
      "The motion runs 0.2 % too slow, less with smaller steps (order 2): "))
      << text(cause);
}

TEST(DiagnosisText, NamesWhatTheCureNeeds) {
  EXPECT_TRUE(has(text({"masses-exchanged", NAN, "", 0.9, {}, "t,u2,v2,u1,v1", ""}),
                  "read them with --columns t,u2,v2,u1,v1."));
  EXPECT_TRUE(text({"unit-scaled", 1000.0, "1", 0.9, {}, "mm", ""})
                  .starts_with("Displacements and velocities are 1000 times those of the case, in "
                               "mm: convert"));
  EXPECT_TRUE(text({"unit-scaled", 1000.0, "1", 0.9, {}, "v mm/s", ""})
                  .starts_with("Velocities are 1000 times those of the case, in mm/s: "));
  EXPECT_TRUE(text({"unit-scaled", 7.0, "1", 0.9, {}, "u", ""})
                  .starts_with("Displacements are 7 times those of the case: convert"));
  EXPECT_TRUE(text({"impact-missed", 3.0, "", 0.9, {{"time", 7.5}}, "", ""})
                  .starts_with("Impact 3 is missing (t = 7.5 s): "));
}

TEST(DepartureText, OrdersSolversByTheTimeTheyLeaveTheExactMotion) {
  auto problem = sample_check().cases[0];
  auto& subjects = problem.subjects;
  subjects.resize(1);
  subjects[0].name = "A";
  subjects[0].departure = {2, 4.7181};
  EXPECT_EQ(departure_text(problem), "");  // nothing to compare with
  auto& run = subjects[0].levels.back().runs.back();
  subjects[0].levels = {{run.score.step, {run}}};
  subjects[0].levels[0].runs[0].score.u_error = 2.6e-7;
  subjects.insert(subjects.end(), 2, subjects[0]);
  subjects[1].name = "B";
  subjects[1].departure = {0, 0.31};
  subjects[2].name = "C";
  subjects[2].departure.reset();
  EXPECT_EQ(departure_text(problem),
            "First to leave the exact motion: B at t = 0.31 s (before any impact); then A at t = "
            "4.72 s (impact 2); C stays within 2.6e-7 of the largest envelope to its end.");
  auto record = sample_check();
  record.cases[0] = problem;
  EXPECT_TRUE(has(written(record, Format::table), "First to leave the exact motion: B"));
  subjects[2].levels[0].runs[0].score.u_error = 0.0;
  EXPECT_TRUE(has(departure_text(problem), "; C stays on it to rounding."));
  subjects[0].departure = subjects[1].departure = {};
  EXPECT_EQ(departure_text(problem), "");
}

TEST(DiagnosisText, SaysHowLateAShiftIs) {
  EXPECT_TRUE(text({"time-shifted", 1.0, "steps", 0.9, {}, "", ""})
                  .starts_with("Every state stands 1 step too late: "));
  EXPECT_TRUE(text({"time-shifted", -1e-3, "s", 0.9, {}, "", ""})
                  .starts_with("Every state stands 0.001 s too early: "));
}

TEST(DiagnosisText, EveryCodeHasASentenceWithACure) {
  for (const auto& known : diagnose::causes()) {
    const Code code = known.code;
    // All that a cause may have, and nothing.
    Diagnosis full{std::string(code.name()), 1.5, "1", 0.9, {}, "<name>", ""};
    for (const auto name : diagnose::fact_names) full.evidence.push_back({std::string(name), 2.0});
    Diagnosis bare;
    bare.code = code.name();
    for (const auto& cause : {full, bare}) {
      const auto found = diagnosis_text(cause);
      EXPECT_EQ(found.code, code.name());
      EXPECT_TRUE(found.sentence.ends_with('.')) << found.sentence;
      EXPECT_TRUE(has(found.sentence, ": ")) << found.sentence;
      for (const auto* mark : {"{", "}", "[", "]", "nan"})
        EXPECT_FALSE(has(found.sentence, mark)) << found.sentence;
    }
    EXPECT_FALSE(has(diagnosis_text(full).sentence, "?")) << diagnosis_text(full).sentence;
  }
}

TEST(DiagnosisTexts, AreThreeAtMostInTheirOrder) {
  record::Subject subject;
  for (const auto* code : {"wrong-limit", "noise-floor", "period-error", "time-drifts"})
    subject.diagnoses.push_back({code, 0.1, "1", 0.9, {}, "", ""});
  const auto texts = diagnosis_texts(subject);
  ASSERT_EQ(texts.size(), 3u);
  EXPECT_EQ(texts[0].code, "wrong-limit");
  EXPECT_EQ(texts[2].code, "period-error");
}

}  // namespace
}  // namespace clackers::report
