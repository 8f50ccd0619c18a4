#include "clackers/report/groups.hpp"

#include <gtest/gtest.h>

#include "clackers/record/testing/sample_record.hpp"

namespace clackers::report {
namespace {

record::Subject subject(const std::string& name, Verdict verdict, double error) {
  record::Subject made;
  record::name_method(made, name);
  made.assessment.verdict = verdict;
  record::Run run;
  run.score.finished = true;
  run.score.u_error = error;
  made.levels = {{0.1, {run}}};
  return made;
}

// Eleven methods, so that they stand in groups.
record::CaseRecord many() {
  record::CaseRecord problem;
  for (const char* name : {"newmark", "rk4", "rk3", "chang", "cr"})
    problem.subjects.push_back(subject(name, Verdict::agrees, 1e-3));
  problem.subjects[1].assessment.verdict = Verdict::undecided;
  problem.subjects[3].levels[0].runs[0].score.u_error = 2e-3;
  problem.subjects[4].refusal = "no";
  problem.subjects.push_back(subject("newmark+penalty", Verdict::agrees, 0.1));
  problem.subjects.push_back(subject("rk4+penalty", Verdict::agrees, 0.2));
  problem.subjects.push_back(subject("rk3+penalty", Verdict::disagrees, 0.1));
  problem.subjects.push_back(subject("chang+penalty", Verdict::agrees, 0.3));
  problem.subjects.push_back(subject("rk4+penalty:law=hertz", Verdict::agrees, 0.2));
  problem.subjects.push_back(subject("moreau-jean", Verdict::not_claimed, 0.2));
  return problem;
}

std::vector<std::string> names(const std::vector<SubjectGroup>& groups) {
  std::vector<std::string> all;
  for (const auto& group : groups) {
    if (group.is_headed) all.push_back(heading_of(group));
    for (const auto* one : group.subjects) all.push_back(name_in(group, *one));
  }
  return all;
}

TEST(Groups, OfManyMethodsHaveTheirTreatmentAndTheWorstFirst) {
  const auto problem = many();
  EXPECT_EQ(names(groups_of(problem)),
            (std::vector<std::string>{"penalty, 4 methods", "rk3", "chang", "rk4", "newmark",
                                      "event-driven, 5 methods", "rk4", "chang", "newmark", "rk3",
                                      "cr", "standalone methods, 1 method", "moreau-jean",
                                      "penalty:law=hertz, 1 method", "rk4"}));
}

TEST(Groups, OfFewMethodsAreOneInTheOrderOfTheRecord) {
  auto problem = many();
  problem.subjects.resize(most_ungrouped);
  const auto groups = groups_of(problem);
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_FALSE(groups[0].is_headed);
  EXPECT_EQ(names(groups)[5], "newmark+penalty");
}

TEST(Groups, HoldOnlyTheVerdictsAskedFor) {
  auto problem = many();
  EXPECT_EQ(
      names(groups_of(problem, {"disagrees", "undecided"})),
      (std::vector<std::string>{"penalty, 1 method", "rk3", "event-driven, 1 method", "rk4"}));
  EXPECT_EQ(names(groups_of(problem, {"refused"})),
            (std::vector<std::string>{"event-driven, 1 method", "cr"}));
  problem.subjects.resize(2);
  EXPECT_EQ(names(groups_of(problem, {"undecided"})), std::vector<std::string>{"rk4"});
  EXPECT_TRUE(groups_of(problem, {"disagrees"}).empty());
}

std::vector<std::string> said(const record::CaseRecord& problem, bool twice = false) {
  std::vector<std::string> all;
  const auto found = named_findings(groups_of(problem), [&](const record::Subject& one) {
    const bool is_penalty = one.name.find("penalty") != std::string::npos;
    if (!is_penalty) return std::vector<Finding>{};
    return std::vector<Finding>(twice ? 2 : 1, {"Of " + one.name, "contact-stiffness"});
  });
  for (const auto& [who, name, finding] : found) all.push_back(name + ": " + finding.sentence);
  return all;
}

TEST(NamedFindings, AreSaidOnceForOneReasonAndVerdictWithATreatment) {
  auto problem = many();
  EXPECT_EQ(said(problem),
            (std::vector<std::string>{"rk3+penalty: Of rk3+penalty",
                                      "chang+penalty and 3 more with penalty: Of chang+penalty"}));
  problem.subjects.resize(8);
  EXPECT_EQ(said(problem).size(), 3u);  // no headings: each for itself
}

TEST(NamedFindings, OfOneSubjectAreAllSaid) {
  auto problem = many();
  problem.subjects.resize(6);
  EXPECT_EQ(said(problem, true).size(), 2u);
}

}  // namespace
}  // namespace clackers::report
