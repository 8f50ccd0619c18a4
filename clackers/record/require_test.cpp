#include "clackers/record/require.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "clackers/base/testing/refusal.hpp"

namespace clackers::record {
namespace {

Subject subject(Verdict verdict, Behaviour behaviour, double order = 0.0, double error = 1e-4) {
  Subject one;
  one.name = "newmark";
  one.assessment.verdict = verdict;
  one.assessment.displacement.behaviour = behaviour;
  one.assessment.displacement.has_line = order > 0.0;
  one.assessment.displacement.order = order;
  Run run;
  run.score.finished = true;
  run.score.u_error = error;
  one.levels.push_back({0.1, {run}});
  return one;
}

Record record_of(std::vector<Subject> subjects) {
  Record record;
  record.cases.emplace_back().problem.name = "stop";
  record.cases.back().subjects = std::move(subjects);
  return record;
}

// What is found instead; "met" for nothing.
std::string found(const Subject& one, std::string_view requirement) {
  const auto all = unmet(record_of({one}), requirement_from(requirement));
  return all.empty() ? "met" : all.front().found;
}

TEST(Requirement, IsReadFromItsText) {
  EXPECT_EQ(requirement_from("agrees").kind, Requirement::Kind::agrees);
  EXPECT_EQ(requirement_from("irregular").behaviour, Behaviour::irregular);
  EXPECT_EQ(requirement_from("order:2.5").value, 2.5);
  EXPECT_EQ(requirement_from("error:1e-3").value, 1e-3);
  EXPECT_EQ(requirement_from("error:1e-3").text, "error:1e-3");
}

TEST(Requirement, RefusesAnythingElse) {
  EXPECT_REFUSED(requirement_from("agree"), "unknown-name", "Did you mean \"agrees\"?");
  EXPECT_REFUSED(requirement_from("propper"), "unknown-name", "Did you mean \"proper\"?");
  EXPECT_REFUSED(requirement_from("undecided"), "unknown-name", "undecided");
  EXPECT_REFUSED(requirement_from("ordr:2"), "unknown-name", "Did you mean \"order\"?");
  for (const auto text :
       {"order", "order:", "order:two", "error:1e-3s", "agrees:1", "proper:2", "error:nan"})
    EXPECT_REFUSED(requirement_from(text), "bad-syntax", text);
  for (const auto text : {"order:0", "order:21", "error:-1", "error:0"})
    EXPECT_REFUSED(requirement_from(text), "out-of-range", text);
}

TEST(Requirement, AgreesNeedsAClaimThatWasMet) {
  EXPECT_EQ(found(subject(Verdict::agrees, Behaviour::proper, 2.0), "agrees"), "met");
  EXPECT_EQ(found(subject(Verdict::not_claimed, Behaviour::proper, 2.0), "agrees"), "not claimed");
}

TEST(Requirement, IsNeverMetByWhatIsUndecidedContradictedRefusedOrIncomplete) {
  for (const auto text : {"agrees", "proper", "order:1", "error:1"}) {
    EXPECT_EQ(found(subject(Verdict::undecided, Behaviour::proper, 2.0), text), "undecided");
    EXPECT_EQ(found(subject(Verdict::disagrees, Behaviour::proper, 2.0), text), "disagrees");
    auto refused = subject(Verdict::undecided, Behaviour::undecided);
    refused.refusal = "no";
    EXPECT_EQ(found(refused, text), "refused");
    auto incomplete = subject(Verdict::agrees, Behaviour::proper, 2.0);
    incomplete.complete = false;
    EXPECT_EQ(found(incomplete, text), "interrupted");
  }
}

TEST(Requirement, BehaviourIsWhatWasMeasured) {
  EXPECT_EQ(found(subject(Verdict::not_claimed, Behaviour::proper, 2.0), "proper"), "met");
  EXPECT_EQ(found(subject(Verdict::not_claimed, Behaviour::reduced, 1.0), "proper"), "reduced");
}

TEST(Requirement, OrderIsTheLeastOneWithinTheToleranceOfAClaim) {
  const auto measured = [](double order) {
    return subject(Verdict::not_claimed, Behaviour::proper, order);
  };
  EXPECT_EQ(found(measured(1.81), "order:2"), "met");
  EXPECT_EQ(found(measured(1.79), "order:2"), "order");
  EXPECT_EQ(found(measured(4.0), "order:2"), "met");
  auto envelope = measured(0.76);
  envelope.assessment.displacement.on_envelope = true;
  EXPECT_EQ(found(envelope, "order:1"), "met");
  envelope.assessment.displacement.order = 0.74;
  EXPECT_EQ(found(envelope, "order:1"), "order");
  EXPECT_EQ(found(subject(Verdict::not_claimed, Behaviour::exact), "order:2"), "met");
  EXPECT_EQ(found(subject(Verdict::agrees, Behaviour::stagnating), "order:2"), "stagnating");
}

TEST(Requirement, ErrorIsTheWorstOfTheFinestLevel) {
  auto one = subject(Verdict::not_claimed, Behaviour::undecided, 0.0, 1e-3);
  EXPECT_EQ(found(one, "error:1e-3"), "met");
  EXPECT_EQ(found(one, "error:0.9e-3"), "error");
  one.levels.back().runs.push_back({});
  one.levels.back().runs.back().score.finished = false;
  EXPECT_EQ(found(one, "error:1"), "error") << "a failed run has no error";
}

TEST(Requirement, DecidesTheExitCodeAndCountsRefusedMethods) {
  auto refused = subject(Verdict::undecided, Behaviour::undecided);
  refused.refusal = "no";
  const auto agrees = subject(Verdict::agrees, Behaviour::proper, 2.0);
  const auto undecided = subject(Verdict::undecided, Behaviour::undecided);
  const std::vector all{requirement_from("agrees"), requirement_from("order:2")};
  EXPECT_EQ(exit_code(record_of({agrees}), all), 0);
  EXPECT_EQ(exit_code(record_of({agrees, refused}), {}), 0);
  EXPECT_EQ(exit_code(record_of({agrees, refused}), all), 1);
  EXPECT_EQ(exit_code(record_of({undecided}), {}), 3);
  EXPECT_EQ(exit_code(record_of({undecided}), all), 1);
  EXPECT_EQ(exit_code(record_of({agrees}), {all[0], requirement_from("order:3")}), 1);
  auto interrupted = record_of({undecided});
  interrupted.interrupted = true;
  EXPECT_EQ(exit_code(interrupted, all), 130);
}

}  // namespace
}  // namespace clackers::record
