#include "clackers/report/check_junit.hpp"

#include <fmt/format.h>

#include <cmath>

#include "clackers/report/digest.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/junit_suite.hpp"

namespace clackers::report {
namespace {

std::string name_of(const study::CheckRecord& record) {
  const auto& finest = record.files.back().file;
  if (record.files.size() == 1) return finest;
  return fmt::format("{} histories down to {}", record.files.size(), finest);
}

std::string lines_of(const study::CheckRecord& record) {
  std::string out;
  for (const auto& file : record.files) {
    out += fmt::format("{}: h = {} s, error in u {}", file.file, short_number(file.score.step, 4),
                       scientific(file.score.u_error, 2));
    if (const auto& found = file.score.impacts)
      out += fmt::format(", {} of {} collisions", found->matched, found->expected);
    out += '\n';
  }
  for (const auto& note : record.files.back().notes) out += note + '\n';
  return out;
}

std::vector<JunitProperty> measured(const study::CheckRecord& record) {
  std::vector<JunitProperty> all{{"verdict", std::string(to_string(record.verdict))}};
  const auto add = [&](const std::string& name, double value) {
    if (!std::isnan(value)) all.push_back({name, exact_number(value)});
  };
  if (record.expect) all.push_back({"expect", claim_text(*record.expect)});
  if (record.tolerance) add("tolerance", *record.tolerance);
  const auto& fit = record.assessment.displacement;
  if (record.files.size() > 1) {
    all.push_back({"behaviour", std::string(to_string(fit.behaviour))});
    if (fit.has_line) {
      add("order", fit.order);
      add("order_spread", fit.spread);
    }
  }
  const auto& finest = record.files.back();
  add("step", finest.score.step);
  add("u_error", finest.score.u_error);
  add("v_error", finest.score.v_error);
  add("energy_error", finest.score.energy_error);
  if (const auto& found = finest.score.impacts) {
    all.push_back({"collisions_matched", fmt::format("{}", found->matched)});
    all.push_back({"collisions_expected", fmt::format("{}", found->expected)});
    if (found->matched > 0) add("collision_time_error", found->worst_time_error);
  }
  for (const auto& metric : finest.metrics) add("metric:" + metric.name, metric.value);
  return all;
}

std::string trouble(Verdict verdict) {
  if (verdict == Verdict::disagrees) return "failure";
  return verdict == Verdict::undecided ? "skipped" : "";
}

}  // namespace

void write_check_junit(const study::CheckRecord& record, std::ostream& out) {
  auto message = record.sentence;
  if (!record.reason.empty()) message += fmt::format(" [{}]", record.reason);
  JunitTest test{.name = name_of(record),
                 .class_name = "clackers.check." + record.problem.name,
                 .seconds = 0.0,
                 .properties = measured(record),
                 .trouble = trouble(record.verdict),
                 .message = message,
                 .type = record.reason.empty() ? "disagrees" : record.reason,
                 .body = lines_of(record)};
  write_junit_suite({.command = "clackers check",
                     .name = case_text(record.problem),
                     .timestamp = record.provenance.date,
                     .properties = junit_properties(record.provenance, record.problem),
                     .tests = {std::move(test)},
                     .output = {}},
                    out);
}

}  // namespace clackers::report
