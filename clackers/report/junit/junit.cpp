#include "clackers/report/junit/junit.hpp"

#include <fmt/format.h>

#include <cmath>
#include <ostream>
#include <pugixml.hpp>
#include <sstream>
#include <string>

#include "clackers/report/columns.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

// In JUnit's words.
enum class Status { passed, failed, skipped, error };

Status status_of(const record::Subject& subject) {
  if (!subject.refusal.empty()) return Status::skipped;
  if (!subject.complete) return Status::error;
  switch (subject.assessment.verdict) {
    case Verdict::disagrees:
      return Status::failed;
    case Verdict::undecided:
      return Status::skipped;
    case Verdict::agrees:
    case Verdict::not_claimed:
      break;
  }
  return Status::passed;
}

struct Totals {
  int tests = 0, failures = 0, errors = 0, skipped = 0;
  double seconds = 0.0;
};

void add(Totals& totals, const Totals& more) {
  totals.tests += more.tests;
  totals.failures += more.failures;
  totals.errors += more.errors;
  totals.skipped += more.skipped;
  totals.seconds += more.seconds;
}

double seconds_of(const record::Subject& subject) {
  double sum = 0.0;
  for (const auto& level : subject.levels)
    for (const auto& run : level.runs) sum += run.score.seconds;
  return sum;
}

Totals totals_of(const record::CaseRecord& problem) {
  Totals totals;
  for (const auto& subject : problem.subjects) {
    const auto status = status_of(subject);
    add(totals, {1, status == Status::failed, status == Status::error, status == Status::skipped,
                 seconds_of(subject)});
  }
  return totals;
}

void set(pugi::xml_node& node, const char* name, const std::string& value) {
  node.append_attribute(name) = xml_text(value).c_str();
}

void set(pugi::xml_node& node, const Totals& totals) {
  node.append_attribute("tests") = totals.tests;
  node.append_attribute("failures") = totals.failures;
  node.append_attribute("errors") = totals.errors;
  node.append_attribute("skipped") = totals.skipped;
  set(node, "time", fmt::format("{:.3f}", totals.seconds));
}

class Properties {
 public:
  explicit Properties(pugi::xml_node& owner) : node_(owner.append_child("properties")) {}
  void add(const std::string& name, const std::string& value) {
    auto property = node_.append_child("property");
    set(property, "name", name);
    set(property, "value", value);
  }
  // What was not measured is left out.
  void add(const std::string& name, double value) {
    if (!std::isnan(value)) add(name, exact_number(value));
  }
  void add(const std::string& name, const record::Cell& cell) {
    if (const auto* real = std::get_if<double>(&cell)) add(name, *real);
    if (const auto* whole = std::get_if<long long>(&cell)) add(name, fmt::format("{}", *whole));
    if (const auto* text = std::get_if<std::string>(&cell)) add(name, *text);
  }

 private:
  pugi::xml_node node_;
};

void add_measured(Properties& properties, const record::CaseRecord& problem,
                  const record::Subject& subject) {
  const auto row = subject_row(problem, subject);
  for (const auto* name :
       {"verdict", "claim", "behaviour", "order", "order_spread", "step", "u_error", "v_error",
        "energy_error", "impacts_expected", "impacts_found", "impacts_matched", "impacts_missed",
        "impacts_extra", "impact_time_error", "force_evaluations"})
    properties.add(name, column(name).get(row));
  // "tolerance" is the error that is accepted.
  properties.add("solver_tolerance", column("tolerance").get(row));
  if (subject.tolerance) properties.add("tolerance", *subject.tolerance);
  properties.add("seconds_of_all_runs", seconds_of(subject));
  if (const auto* run = subject.shown_run())
    for (const auto& metric : run->metrics) properties.add("metric:" + metric.name, metric.value);
}

std::string run_line(const record::Subject& subject, const measure::RunScore& score, int runs,
                     int failed) {
  auto text = fmt::format("{}: error in u {}", resolution_text(subject, score.step, 4),
                          scientific(score.u_error, 2));
  if (score.impacts)
    text += fmt::format(", {} of {} matched", score.impacts->matched,
                        counted(score.impacts->expected, "impact"));
  if (failed > 0) text += fmt::format(", {} of {} failed", failed, counted(runs, "run"));
  return text + '\n';
}

// A line a level, or a line a history, for a person who reads the log of a failed build.
std::string log_text(const record::Subject& subject) {
  std::string text;
  for (const auto& cause : diagnosis_texts(subject)) text += text_of(cause) + '\n';
  text += fmt::format("claimed: {}\nfound: {}\n", claim_text(subject.claim),
                      fit_text(subject.assessment.displacement));
  for (const auto& level : subject.levels) {
    if (subject.kind == record::SubjectKind::histories) {
      for (const auto& run : level.runs)
        text += (run.file ? run.file->file + ": " : "") + run_line(subject, run.score, 1, 0);
    } else {
      auto worst = record::worst(level);
      worst.worst.step = level.step;
      text += run_line(subject, worst.worst, worst.runs, worst.failed);
    }
  }
  for (const auto& note : note_texts(subject)) text += note + '\n';
  return text;
}

void add_status(pugi::xml_node& test, const record::Subject& subject) {
  const auto status = status_of(subject);
  if (status == Status::passed) return;
  auto node = test.append_child(status == Status::failed    ? "failure"
                                : status == Status::skipped ? "skipped"
                                                            : "error");
  const auto found = finding(subject).value_or(Finding{});
  const auto causes = diagnosis_texts(subject);
  set(node, "message",
      causes.empty() ? text_of(found)
                     : fmt::format("{} {}", text_of(causes.front()), text_of(found)));
  if (status == Status::skipped) return;
  set(node, "type", found.code.empty() ? std::string(record::verdict_word(subject)) : found.code);
  node.text() = xml_text(log_text(subject)).c_str();
}

void add_suite(pugi::xml_node& suites, const record::Record& record,
               const record::CaseRecord& problem, const study::BaselineComparison* changes) {
  const auto& from = record.provenance;
  auto suite = suites.append_child("testsuite");
  set(suite, "name", case_text(problem.problem));
  set(suite, totals_of(problem));
  set(suite, "timestamp", from.date);
  Properties properties(suite);
  properties.add("command", from.command);
  properties.add("version", from.version);
  properties.add("compiler", from.compiler);
  properties.add("machine", from.machine);
  properties.add("processor", from.processor);
  for (const auto& parameter : problem.problem.parameters)
    if (parameter.text.empty())
      properties.add(parameter.name, parameter.value);
    else
      properties.add(parameter.name, parameter.text);
  if (const auto plan = plan_text(problem); !plan.empty()) properties.add("plan", plan);
  for (const auto& subject : problem.subjects) {
    auto test = suite.append_child("testcase");
    set(test, "name", subject.name);
    set(test, "classname", fmt::format("clackers.{}.{}", record.command, problem.problem.name));
    set(test, "time", fmt::format("{:.3f}", seconds_of(subject)));
    Properties measured(test);
    add_measured(measured, problem, subject);
    add_status(test, subject);
  }
  if (changes == nullptr) return;
  auto of_case = *changes;
  std::erase_if(of_case.subjects, [&](const study::SubjectChange& change) {
    return change.case_name != problem.problem.name;
  });
  std::ostringstream text;
  write_changes(of_case, text, {.color = false, .width = 100});
  suite.append_child("system-out").text() = xml_text(text.str()).c_str();
}

}  // namespace

void write_junit(const record::Record& record, std::ostream& out, const Style&,
                 const study::BaselineComparison* changes) {
  pugi::xml_document document;
  auto suites = document.append_child("testsuites");
  set(suites, "name", "clackers " + record.command);
  Totals totals;
  for (const auto& problem : record.cases) add(totals, totals_of(problem));
  set(suites, totals);
  for (const auto& problem : record.cases) add_suite(suites, record, problem, changes);
  auto declaration = document.prepend_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  document.save(out, "  ", pugi::format_default, pugi::encoding_utf8);
}

}  // namespace clackers::report
