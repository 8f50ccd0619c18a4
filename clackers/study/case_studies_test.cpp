#include "clackers/study/case_studies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "clackers/base/error.hpp"

namespace clackers::study {
namespace {

const std::vector<std::string> two{"stop", "symmetric-pair"};

VerifyRequest small() {
  VerifyRequest request;
  request.methods = {"rk4", "newmark"};
  request.settings = {{"t_end", 8.0}};
  request.plan = {0.1, 5, 1};
  return request;
}

std::string refusal(const VerifyRequest& request, const std::vector<std::string>& cases) {
  bool worked = false;
  try {
    verify_cases(request, cases, [&](double) { worked = true; });
  } catch (const InputError& error) {
    EXPECT_FALSE(worked) << "refused after work had begun";
    return std::string(error.what()) + " [" + std::string(error.code().name()) + "]";
  }
  return "accepted";
}

TEST(CaseStudies, JudgeTheSameMethodsOnEachCaseAndProfileThemOverAll) {
  const auto all = verify_cases(small(), two);
  ASSERT_EQ(all.records.size(), 2u);
  EXPECT_EQ(all.records[0].problem.name, "stop");
  EXPECT_EQ(all.records[1].problem.name, "symmetric-pair");
  for (const auto& record : all.records) EXPECT_EQ(record.problem.end, 8.0);
  ASSERT_FALSE(all.profiles.empty());
  EXPECT_EQ(all.profiles[0].tasks.size(),
            all.records[0].profiles[0].tasks.size() + all.records[1].profiles[0].tasks.size());
  EXPECT_EQ(exit_code(all), 0);
}

TEST(CaseStudies, TellProgressOverAllCases) {
  std::vector<double> told;
  verify_cases(small(), two, [&](double share) { told.push_back(share); });
  ASSERT_GE(told.size(), 2u);
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_EQ(told.back(), 1.0);
  EXPECT_EQ(std::ranges::count(told, 0.5), 1);
}

TEST(CaseStudies, AreRefusedBeforeAnyWorkWhenOneCaseCannotBeRun) {
  EXPECT_EQ(refusal(small(), {"stop", "stop"}),
            "verify: case = stop; allowed: each case once. [bad-syntax]");
  EXPECT_NE(refusal(small(), {"stop", "stopp"}).find("Did you mean \"stop\"?"), std::string::npos);
  auto request = small();
  request.settings.emplace_back("eta", 0.5);
  EXPECT_NE(refusal(request, {"stop", "sdof"}).find("[unknown-name]"), std::string::npos);
}

TEST(CaseStudies, AreAllMarkedAfterAnInterrupt) {
  const std::atomic<bool> interrupt = true;
  const auto all = verify_cases(small(), two, {}, &interrupt);
  ASSERT_EQ(all.records.size(), 2u);
  for (const auto& record : all.records) EXPECT_TRUE(record.interrupted);
  EXPECT_TRUE(all.profiles.empty());
  EXPECT_EQ(exit_code(all), 130);
}

TEST(CaseStudies, ExitWithTheGravestCode) {
  const auto with = [](std::vector<Verdict> verdicts) {
    CaseStudies all;
    for (const auto verdict : verdicts) {
      all.records.emplace_back().methods.emplace_back();
      all.records.back().methods[0].assessment.verdict = verdict;
    }
    return exit_code(all);
  };
  using enum Verdict;
  EXPECT_EQ(with({agrees, not_claimed}), 0);
  EXPECT_EQ(with({agrees, undecided}), 3);
  EXPECT_EQ(with({undecided, disagrees, agrees}), 1);
}

TEST(CaseStudies, HoldRecordsThatReadBackOneByOne) {
  const auto all = verify_cases(small(), two);
  const auto json = nlohmann::ordered_json::parse(to_json(all));
  EXPECT_EQ(json["schema"], "clackers/verify-cases/1");
  ASSERT_EQ(json["records"].size(), 2u);
  EXPECT_EQ(json["records"][1].dump(1), to_json(all.records[1]));
  EXPECT_EQ(record_from_json(json["records"][0].dump()).problem.name, "stop");
  EXPECT_EQ(json["profiles"][0]["tasks"].size(), all.profiles[0].tasks.size());
}

}  // namespace
}  // namespace clackers::study
