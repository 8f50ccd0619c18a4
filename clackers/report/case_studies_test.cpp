#include "clackers/report/case_studies.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "clackers/report/format.hpp"
#include "clackers/report/sample_record.hpp"

namespace clackers::report {
namespace {

// The sample twice, the second time with other methods' verdicts.
study::CaseStudies studies() {
  study::CaseStudies all;
  all.records = {sample_record(), sample_record()};
  for (auto& record : all.records) record.interrupted = false;
  all.records[1].problem.name = "stop";
  all.profiles = study::profiles_of(all.records);
  return all;
}

std::string text(const study::CaseStudies& all, Format format = Format::table) {
  std::ostringstream out;
  write(all, format, out);
  return out.str();
}

TEST(CaseStudiesTable, HasEveryCaseThenTheProfileThenTheVerdictOverAll) {
  const auto all = studies();
  const auto found = text(all);
  const auto first = found.find("three-parameter ("), second = found.find("stop ("),
             profile = found.find("Performance profile over 2 cases and ");
  EXPECT_LT(first, second);
  EXPECT_LT(second, profile);
  ASSERT_NE(profile, std::string::npos);
  EXPECT_NE(found.find("by force evaluations"), std::string::npos);
  EXPECT_TRUE(found.ends_with("\nVerdict over 2 cases: disagrees.\n")) << found;
}

TEST(CaseStudiesTable, CountsWhoIsCheapestAndWhatIsNotSolved) {
  auto all = studies();
  all.profiles = {{"steps",
                   {"a", "b", "c", "d"},
                   {{"newmark+event-driven", {1, 3, 20, 1}, {{1, .5}, {3, .75}, {20, 1}}, 2, 0},
                    {"rk4", {4, 1, 1, INFINITY}, {{1, .5}, {4, .75}}, 2, 1}}}};
  const auto found = text(all);
  EXPECT_NE(found.find("\nnewmark       2    50 %    75 %     4/4       0\n"), std::string::npos)
      << found;
  EXPECT_NE(found.find("\nrk4           2    50 %    75 %     3/4       1\n"), std::string::npos);
}

TEST(CaseStudiesTable, FitsIntoEightyColumns) {
  std::istringstream in(text(studies()));
  for (std::string line; std::getline(in, line);) EXPECT_LE(display_width(line), 80u) << line;
}

TEST(CaseStudiesTable, SaysWhenThereIsNoProfile) {
  auto all = studies();
  all.profiles.clear();
  EXPECT_NE(text(all).find("No performance profile: "), std::string::npos);
}

TEST(CaseStudiesTable, IsJsonOrATableAndNothingElse) {
  EXPECT_EQ(text(studies(), Format::json), study::to_json(studies()) + "\n");
  EXPECT_TRUE(takes_several_cases(Format::table) && takes_several_cases(Format::json));
  for (const auto format : {Format::csv, Format::junit, Format::latex}) {
    EXPECT_FALSE(takes_several_cases(format));
    EXPECT_THROW(text(studies(), format), std::logic_error);
  }
}

}  // namespace
}  // namespace clackers::report
