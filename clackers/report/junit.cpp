#include "clackers/report/junit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "clackers/report/changes.hpp"
#include "clackers/report/digest.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/xml.hpp"

namespace clackers::report {
namespace {

struct Property {
  std::string name, value;
};

std::string properties(const std::vector<Property>& all, std::string_view margin) {
  auto out = fmt::format("{}<properties>\n", margin);
  for (const auto& [name, value] : all)
    out += fmt::format("{}  <property{}{}/>\n", margin, xml_attribute("name", name),
                       xml_attribute("value", value));
  return out + fmt::format("{}</properties>\n", margin);
}

double seconds(const study::MethodResult& method) {
  double sum = 0.0;
  for (const auto& level : method.ladder)
    for (const auto& run : level.runs) sum += run.seconds;
  return sum;
}

// Milliseconds as JUnit's writers print them; the properties hold what was measured.
std::string time_text(double s) { return fmt::format("{:.3f}", s); }

// The word of the element that tells of trouble; empty for a test that passes.
std::string_view trouble(const study::MethodResult& method) {
  const auto word = verdict_word(method);
  if (word == "disagrees") return "failure";
  if (word == "undecided" || word == "refused") return "skipped";
  if (word == "interrupted") return "error";
  return {};
}

// A line a level, for a person who reads the log of a failed build.
std::string levels_text(const study::MethodResult& method) {
  std::string out;
  for (const auto& level : method.ladder) {
    study::MethodResult alone;
    alone.ladder = {level};
    const auto d = digest(alone);
    out += fmt::format("h = {} s: error in u {}", short_number(level.step, 4),
                       scientific(d.u_error, 2));
    if (d.impacts)
      out += fmt::format(", {} of {} collisions", d.impacts->found, d.impacts->expected);
    if (d.failed_runs > 0) out += fmt::format(", {} of {} runs failed", d.failed_runs, d.runs);
    out += '\n';
  }
  return out;
}

std::string trouble_element(const study::MethodResult& method) {
  const auto kind = trouble(method);
  if (kind.empty()) return {};
  const auto said = remark(method).value_or(Remark{});
  const auto message = fmt::format("{} [{}]", said.sentence, said.code);
  const auto start = fmt::format("      <{}{}{}", kind, xml_attribute("message", message),
                                 kind == "skipped" ? "" : xml_attribute("type", said.code));
  if (kind == "skipped") return start + "/>\n";
  const auto body =
      fmt::format("claimed: {}\nfound: {}\n{}", claim_text(method.claim),
                  to_string(method.assessment.displacement.behaviour), levels_text(method));
  return fmt::format("{}>{}</{}>\n", start, xml_text(body), kind);
}

std::vector<Property> measured(const study::MethodResult& method) {
  const auto d = digest(method);
  const auto& fit = method.assessment.displacement;
  std::vector<Property> all{{"verdict", verdict_word(method)}, {"claim", claim_text(method.claim)}};
  const auto add = [&](std::string name, double value) {
    all.push_back({std::move(name), exact_number(value)});
  };
  if (!method.refusal.empty() || d.runs == 0) return all;
  all.push_back({"behaviour", std::string(to_string(fit.behaviour))});
  if (fit.has_line) {
    add("order", fit.order);
    add("order_spread", fit.spread);
  }
  add("step", d.step);
  add("u_error", d.u_error);
  add("v_error", d.v_error);
  add("energy_error", d.energy_error);
  if (d.impacts) {
    all.push_back({"collisions_found", fmt::format("{}", d.impacts->found)});
    all.push_back({"collisions_expected", fmt::format("{}", d.impacts->expected)});
    if (d.impacts->matched > 0) add("collision_time_error", d.impacts->worst_time_error);
  }
  all.push_back({"force_evaluations", fmt::format("{}", d.force_evaluations)});
  add("seconds", seconds(method));
  return all;
}

std::vector<Property> of_study(const study::Record& record) {
  const auto& from = record.provenance;
  std::vector<Property> all{{"command", from.command},     {"version", from.version},
                            {"compiler", from.compiler},   {"machine", from.machine},
                            {"processor", from.processor}, {"ladder", ladder_text(record)}};
  for (const auto& parameter : record.problem.parameters)
    all.push_back({parameter.name, exact_number(parameter.value)});
  return all;
}

}  // namespace

void write_junit(const study::Record& record, std::ostream& out,
                 const study::BaselineComparison* changes) {
  const auto count = [&](std::string_view kind) {
    return std::ranges::count(record.methods, kind, trouble);
  };
  double all_seconds = 0.0;
  for (const auto& method : record.methods) all_seconds += seconds(method);
  const auto totals =
      fmt::format(" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{}\"",
                  record.methods.size(), count("failure"), count("error"), count("skipped"),
                  time_text(all_seconds));
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites"
      << xml_attribute("name", "clackers verify") << totals << ">\n  <testsuite"
      << xml_attribute("name", case_text(record.problem)) << totals
      << xml_attribute("timestamp", record.provenance.date) << ">\n"
      << properties(of_study(record), "    ");
  for (const auto& method : record.methods)
    out << "    <testcase" << xml_attribute("name", typed_name(method))
        << xml_attribute("classname", "clackers.verify." + record.problem.name)
        << xml_attribute("time", time_text(seconds(method))) << ">\n"
        << properties(measured(method), "      ") << trouble_element(method) << "    </testcase>\n";
  if (changes != nullptr) {
    std::ostringstream text;
    write_changes(*changes, text, {.color = false, .width = 100});
    out << "    <system-out>" << xml_text(text.str()) << "</system-out>\n";
  }
  out << "  </testsuite>\n</testsuites>\n";
}

}  // namespace clackers::report
