#include "clackers/report/writers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

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

using Attributes = std::vector<std::pair<std::string_view, std::string>>;

std::string xml_escaped(std::string_view text, bool in_attribute) {
  std::string out;
  for (const char c : xml_text(text)) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (in_attribute && (c == '"' || c < ' ') && c >= 0)
      out += c == '"' ? "&quot;" : fmt::format("&#{:02};", int(c));
    else
      out += c;
  }
  return out;
}

// Writes elements, each in lines of its own.
class Xml {
 public:
  explicit Xml(std::ostream& out) : out_(out) {
    out_ << R"(<?xml version="1.0" encoding="UTF-8"?>)";
  }
  void open(std::string_view name, const Attributes& attributes = {}) {
    start(name, attributes);
    out_ << '>';
    open_.emplace_back(name);
  }
  void close() {
    const auto name = std::move(open_.back());
    open_.pop_back();
    line();
    out_ << "</" << name << '>';
    if (open_.empty()) out_ << '\n';
  }
  void empty(std::string_view name, const Attributes& attributes) {
    start(name, attributes);
    out_ << " />";
  }
  void text(std::string_view name, const Attributes& attributes, std::string_view text) {
    start(name, attributes);
    out_ << '>' << xml_escaped(text, false) << "</" << name << '>';
  }

 private:
  void line() { out_ << '\n' << std::string(2 * open_.size(), ' '); }
  void start(std::string_view name, const Attributes& attributes) {
    line();
    out_ << '<' << name;
    for (const auto& [key, value] : attributes)
      out_ << ' ' << key << "=\"" << xml_escaped(value, true) << '"';
  }

  std::ostream& out_;
  std::vector<std::string> open_;
};

Attributes with_totals(Attributes attributes, const Totals& totals) {
  for (const auto& [name, count] : {std::pair{"tests", totals.tests},
                                    {"failures", totals.failures},
                                    {"errors", totals.errors},
                                    {"skipped", totals.skipped}})
    attributes.emplace_back(name, fmt::format("{}", count));
  attributes.emplace_back("time", fmt::format("{:.3f}", totals.seconds));
  return attributes;
}

void add_property(Xml& xml, const std::string& name, const std::string& value) {
  xml.empty("property", {{"name", name}, {"value", value}});
}
// What was not measured is left out.
void add_property(Xml& xml, const std::string& name, double value) {
  if (!std::isnan(value)) add_property(xml, name, exact_number(value));
}
void add_property(Xml& xml, const std::string& name, const record::Cell& cell) {
  if (const auto* real = std::get_if<double>(&cell)) add_property(xml, name, *real);
  if (const auto* whole = std::get_if<long long>(&cell))
    add_property(xml, name, fmt::format("{}", *whole));
  if (const auto* text = std::get_if<std::string>(&cell)) add_property(xml, name, *text);
}

void add_measured(Xml& xml, const record::CaseRecord& problem, const record::Subject& subject) {
  const auto row = subject_row(problem, subject);
  for (const auto* name :
       {"verdict", "claim", "behaviour", "order", "order_spread", "step", "u_error", "v_error",
        "energy_error", "impacts_expected", "impacts_found", "impacts_matched", "impacts_missed",
        "impacts_extra", "impact_time_error", "force_evaluations"})
    add_property(xml, name, column(name).get(row));
  // "tolerance" is the error that is accepted.
  add_property(xml, "solver_tolerance", column("tolerance").get(row));
  if (subject.tolerance) add_property(xml, "tolerance", *subject.tolerance);
  add_property(xml, "seconds_of_all_runs", seconds_of(subject));
  if (const auto* run = subject.shown_run())
    for (const auto& metric : run->metrics)
      add_property(xml, "metric:" + metric.name, metric.value);
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

void add_status(Xml& xml, const record::Subject& subject) {
  const auto status = status_of(subject);
  if (status == Status::passed) return;
  const auto found = finding(subject).value_or(Finding{});
  const auto* cause = deciding_cause(subject);
  Attributes attributes{
      {"message", cause == nullptr
                      ? text_of(found)
                      : fmt::format("{} {}", text_of(diagnosis_text(*cause)), text_of(found))}};
  if (status == Status::skipped) return xml.empty("skipped", attributes);
  attributes.emplace_back(
      "type", found.code.empty() ? std::string(record::verdict_word(subject)) : found.code);
  xml.text(status == Status::failed ? "failure" : "error", attributes, log_text(subject));
}

void add_suite(Xml& xml, const record::Record& record, const record::CaseRecord& problem,
               const study::BaselineComparison* changes) {
  const auto& from = record.provenance;
  auto attributes = with_totals({{"name", case_text(problem.problem)}}, totals_of(problem));
  attributes.emplace_back("timestamp", from.date);
  xml.open("testsuite", attributes);
  xml.open("properties");
  add_property(xml, "command", from.command);
  add_property(xml, "version", from.version);
  add_property(xml, "compiler", from.compiler);
  add_property(xml, "machine", from.machine);
  add_property(xml, "processor", from.processor);
  for (const auto& parameter : problem.problem.parameters)
    if (parameter.text.empty())
      add_property(xml, parameter.name, parameter.value);
    else
      add_property(xml, parameter.name, parameter.text);
  if (const auto plan = plan_text(problem); !plan.empty()) add_property(xml, "plan", plan);
  xml.close();
  for (const auto& subject : problem.subjects) {
    xml.open("testcase",
             {{"name", subject.name},
              {"classname", fmt::format("clackers.{}.{}", record.command, problem.problem.name)},
              {"time", fmt::format("{:.3f}", seconds_of(subject))}});
    xml.open("properties");
    add_measured(xml, problem, subject);
    xml.close();
    add_status(xml, subject);
    xml.close();
  }
  if (changes == nullptr) return xml.close();
  auto of_case = *changes;
  std::erase_if(of_case.subjects, [&](const study::SubjectChange& change) {
    return change.case_name != problem.problem.name;
  });
  std::ostringstream text;
  write_changes(of_case, text, {.color = false, .width = 100});
  xml.text("system-out", {}, text.str());
  xml.close();
}

}  // namespace

void write_junit(const record::Record& record, std::ostream& out, const Style&,
                 const study::BaselineComparison* changes) {
  Totals totals;
  for (const auto& problem : record.cases) add(totals, totals_of(problem));
  Xml xml(out);
  xml.open("testsuites", with_totals({{"name", "clackers " + record.command}}, totals));
  for (const auto& problem : record.cases) add_suite(xml, record, problem, changes);
  xml.close();
}

}  // namespace clackers::report
