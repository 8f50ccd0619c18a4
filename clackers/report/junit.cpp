#include "clackers/report/junit.hpp"

#include <fmt/format.h>

#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "clackers/report/changes.hpp"
#include "clackers/report/digest.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/junit_suite.hpp"

namespace clackers::report {
namespace {

using Property = JunitProperty;

double seconds(const study::MethodResult& method) {
  double sum = 0.0;
  for (const auto& level : method.ladder)
    for (const auto& run : level.runs) sum += run.seconds;
  return sum;
}

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
  auto all = junit_properties(record.provenance, record.problem);
  all.push_back({"ladder", ladder_text(record)});
  return all;
}

JunitTest test_of(const study::MethodResult& method, const std::string& problem) {
  JunitTest test{.name = typed_name(method),
                 .class_name = "clackers.verify." + problem,
                 .seconds = seconds(method),
                 .properties = measured(method),
                 .trouble = std::string(trouble(method)),
                 .message = {},
                 .type = {},
                 .body = {}};
  if (test.trouble.empty()) return test;
  const auto said = remark(method).value_or(Remark{});
  test.message = fmt::format("{} [{}]", said.sentence, said.code);
  test.type = said.code;
  test.body = fmt::format("claimed: {}\nfound: {}\n{}", claim_text(method.claim),
                          to_string(method.assessment.displacement.behaviour), levels_text(method));
  return test;
}

}  // namespace

void write_junit(const study::Record& record, std::ostream& out,
                 const study::BaselineComparison* changes) {
  JunitSuite suite{.command = "clackers verify",
                   .name = case_text(record.problem),
                   .timestamp = record.provenance.date,
                   .properties = of_study(record),
                   .tests = {},
                   .output = {}};
  for (const auto& method : record.methods)
    suite.tests.push_back(test_of(method, record.problem.name));
  if (changes != nullptr) {
    std::ostringstream text;
    write_changes(*changes, text, {.color = false, .width = 100});
    suite.output = text.str();
  }
  write_junit_suite(suite, out);
}

}  // namespace clackers::report
