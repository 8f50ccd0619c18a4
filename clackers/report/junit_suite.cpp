#include "clackers/report/junit_suite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "clackers/report/format.hpp"
#include "clackers/report/xml.hpp"

namespace clackers::report {
namespace {

std::string properties(const std::vector<JunitProperty>& all, std::string_view margin) {
  auto out = fmt::format("{}<properties>\n", margin);
  for (const auto& [name, value] : all)
    out += fmt::format("{}  <property{}{}/>\n", margin, xml_attribute("name", name),
                       xml_attribute("value", value));
  return out + fmt::format("{}</properties>\n", margin);
}

// Milliseconds as JUnit's writers print them; the properties hold what was measured.
std::string time_text(double s) { return fmt::format("{:.3f}", s); }

std::string trouble_element(const JunitTest& test) {
  if (test.trouble.empty()) return {};
  const bool skipped = test.trouble == "skipped";
  const auto start =
      fmt::format("      <{}{}{}", test.trouble, xml_attribute("message", test.message),
                  skipped ? "" : xml_attribute("type", test.type));
  if (skipped) return start + "/>\n";
  return fmt::format("{}>{}</{}>\n", start, xml_text(test.body), test.trouble);
}

}  // namespace

std::vector<JunitProperty> junit_properties(const study::Provenance& provenance,
                                            const study::CaseSummary& problem) {
  std::vector<JunitProperty> all{{"command", provenance.command},
                                 {"version", provenance.version},
                                 {"compiler", provenance.compiler},
                                 {"machine", provenance.machine},
                                 {"processor", provenance.processor}};
  for (const auto& parameter : problem.parameters)
    all.push_back({parameter.name, exact_number(parameter.value)});
  return all;
}

void write_junit_suite(const JunitSuite& suite, std::ostream& out) {
  const auto count = [&](std::string_view trouble) {
    return std::ranges::count(suite.tests, trouble, &JunitTest::trouble);
  };
  double seconds = 0.0;
  for (const auto& test : suite.tests) seconds += test.seconds;
  const auto totals = fmt::format(
      " tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{}\"", suite.tests.size(),
      count("failure"), count("error"), count("skipped"), time_text(seconds));
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites"
      << xml_attribute("name", suite.command) << totals << ">\n  <testsuite"
      << xml_attribute("name", suite.name) << totals << xml_attribute("timestamp", suite.timestamp)
      << ">\n"
      << properties(suite.properties, "    ");
  for (const auto& test : suite.tests)
    out << "    <testcase" << xml_attribute("name", test.name)
        << xml_attribute("classname", test.class_name)
        << xml_attribute("time", time_text(test.seconds)) << ">\n"
        << properties(test.properties, "      ") << trouble_element(test) << "    </testcase>\n";
  if (!suite.output.empty())
    out << "    <system-out>" << xml_text(suite.output) << "</system-out>\n";
  out << "  </testsuite>\n</testsuites>\n";
}

}  // namespace clackers::report
