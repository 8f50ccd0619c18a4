#include "clackers/record/record.hpp"

#include <gtest/gtest.h>

#include <regex>

namespace clackers::record {
namespace {

TEST(Provenance, SaysWhoComputesHereAndNow) {
  const auto here = provenance("clackers verify");
  EXPECT_EQ(here.command, "clackers verify");
  EXPECT_TRUE(std::regex_match(here.version, std::regex(R"(\d+\.\d+\.\d+)"))) << here.version;
  EXPECT_TRUE(std::regex_search(here.compiler, std::regex("^(GCC|.*[Cc]lang).*[0-9]")))
      << here.compiler;
  EXPECT_TRUE(std::regex_match(here.date, std::regex(R"(20\d\d-\d\d-\d\dT\d\d:\d\d:\d\dZ)")))
      << here.date;
  EXPECT_NE(here.machine.find("processors"), std::string::npos) << here.machine;
  EXPECT_FALSE(here.processor.empty());
}

TEST(Provenance, ReadsTheProcessorsName) {
  EXPECT_EQ(processor_name("processor\t: 0\nmodel name\t: Quick 9000 @ 3 GHz\nstepping\t: 1\n"),
            "Quick 9000 @ 3 GHz");
  EXPECT_EQ(processor_name("model name\t: Last"), "Last");
  EXPECT_EQ(processor_name("processor\t: 0\nBogoMIPS\t: 50\n"), "unknown");
  EXPECT_EQ(processor_name("model name\nBogoMIPS\t: 50\n"), "unknown");
  EXPECT_EQ(processor_name(""), "unknown");
}

}  // namespace
}  // namespace clackers::record
