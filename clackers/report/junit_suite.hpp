#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "clackers/study/record.hpp"

namespace clackers::report {

struct JunitProperty {
  std::string name, value;
};

/// A test of a suite. `trouble` is the word of the element that tells of trouble: "failure",
/// "skipped", "error", or empty for a test that passes.
struct JunitTest {
  std::string name, class_name;
  double seconds = 0.0;
  std::vector<JunitProperty> properties;
  std::string trouble, message, type;
  std::string body;  ///< lines for a person who reads the log of a failed build
};

/// What JUnit's readers take from one file: one suite with its tests.
struct JunitSuite {
  std::string command, name, timestamp;  ///< "clackers verify", the case, ISO 8601
  std::vector<JunitProperty> properties;
  std::vector<JunitTest> tests;
  std::string output;  ///< of the suite, empty for none
};

/// What was run, where and by what, and the parameters of the case.
std::vector<JunitProperty> junit_properties(const study::Provenance& provenance,
                                            const study::CaseSummary& problem);

/// Writes it as JUnit XML, everything escaped; the totals are counted here.
void write_junit_suite(const JunitSuite& suite, std::ostream& out);

}  // namespace clackers::report
