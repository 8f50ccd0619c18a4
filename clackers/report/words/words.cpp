#include "clackers/report/words/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "clackers/base/text.hpp"
#include "clackers/judge/convergence/judge.hpp"
#include "clackers/report/format.hpp"
#include "clackers/study/refinement.hpp"

namespace clackers::report {
namespace {

bool is_option(std::string_view word, std::string_view option) {
  return word.substr(0, word.find('=')) == option;
}

bool has_option(const std::string& command, std::string_view option) {
  return std::ranges::any_of(shell_words(command),
                             [&](const auto& word) { return is_option(word, option); });
}

// The command with an option set anew.
std::string with_option(const std::string& command, const std::string& option,
                        const std::string& value) {
  std::vector<std::string> kept;
  const auto words = shell_words(command);
  for (std::size_t i = 0; i < words.size(); ++i)
    if (!is_option(words[i], option))
      kept.push_back(words[i]);
    else if (words[i] == option)
      ++i;  // its value
  kept.insert(kept.end(), {option, value});
  return shell_line(kept);
}

// A study of Python has the call as its command, "clackers.verify(solver, case='stop')".
bool is_call(std::string_view command) { return command.starts_with("clackers."); }

// The option as an argument of that call: --budget 60s is budget=60, --expect proper:2 is
// expect='proper:2'.
std::string argument_text(std::string_view option, std::string_view value) {
  option.remove_prefix(2);
  if (value.find(':') != std::string_view::npos) return fmt::format("{}='{}'", option, value);
  if (value.ends_with('s')) value.remove_suffix(1);
  return fmt::format("{}={}", option, value);
}

// What lets `verify` decide on a method that is undecided: an option with its value, and words.
struct NextOption {
  std::string option, value, words;
};

std::optional<NextOption> deciding_option(const record::CaseRecord& problem,
                                          const record::Subject& subject) {
  if (problem.plan.levels == 0 || subject.refined_by != record::RefinementParameter::step)
    return {};
  const auto& fit = subject.assessment.displacement;
  // Runs of a program that fails do not profit from another step.
  if (!subject.complete || fit.behaviour != Behaviour::undecided ||
      fit.reason == Code("run-failed").name())
    return {};
  const double usual = study::default_coarsest(problem.problem.fast_period, problem.problem.end);
  if (problem.plan.coarsest > 1.5 * usual)
    return NextOption{"--coarsest", short_number(usual, 3),
                      fmt::format(" ({} steps a fast period)",
                                  short_number(problem.problem.fast_period / usual, 2))};
  if (!subject.refinement || subject.refinement->end != record::RefinementEnd::budget) return {};
  const double seconds = subject.refinement->next_seconds;
  return NextOption{
      "--budget",
      seconds > 0.0 ? short_number(std::ceil(1.5 * seconds), 3) + "s" : std::string("60s"), ""};
}

// "proper:2" for histories without a claim that show an order; empty without one.
std::string expectation(const record::Record& record) {
  const auto counts = record::counts(record);
  if (record.command != "check" || counts.not_claimed == 0 || counts.total() > 1) return {};
  const auto& fit = record.cases.front().subjects.front().assessment.displacement;
  const double half = 0.5 * std::round(2.0 * fit.order);
  const bool is_plain = half > 0.0 && std::abs(fit.order - half) <= 0.1;
  if (!fit.has_line || !is_plain || fit.behaviour == Behaviour::undecided ||
      fit.behaviour == Behaviour::stagnating || fit.behaviour == Behaviour::divergent)
    return {};
  return fmt::format("{}:{}", to_string(fit.behaviour), short_number(half, 2));
}

}  // namespace

std::string text_of(const Finding& finding) {
  return finding.code.empty() ? finding.sentence
                              : fmt::format("{} [{}]", finding.sentence, finding.code);
}

std::string counted(long long count, std::string_view noun) {
  if (count == 1) return fmt::format("1 {}", noun);
  const bool in_y = noun.ends_with('y');
  return fmt::format("{} {}{}", count, in_y ? noun.substr(0, noun.size() - 1) : noun,
                     in_y ? "ies" : "s");
}

std::string order_text(const judge::LadderFit& fit, std::string_view space) {
  if (!fit.has_line) return {};
  return fmt::format("{:.2f}{}±{:.{}f}", fit.order, space, std::max(fit.spread, 0.01),
                     fit.spread < 9.95 ? 2 : 0);
}

std::string fit_text(const judge::LadderFit& fit) {
  auto text = std::string(to_string(fit.behaviour));
  if (fit.has_line)
    text += fmt::format(", order {}{}", order_text(fit),
                        fit.on_envelope ? " of the upper envelope" : "");
  if (fit.behaviour == Behaviour::stagnating && fit.floor > 0.0)
    text += fmt::format(" at {}", scientific(fit.floor));
  if (!fit.reason.empty()) text += fmt::format(" [{}]", fit.reason);
  return text;
}

std::string claim_text(const Claim& claim) {
  if (!claim.is_made())
    return claim.reason.empty() ? "nothing" : fmt::format("nothing [{}]", claim.reason);
  const auto velocity = claim.velocity_order > 0.0 ? fmt::format("velocities of order {}",
                                                                 short_number(claim.velocity_order))
                                                   : std::string();
  if (claim.behaviour == Behaviour::undecided) return velocity;
  auto text = std::string(to_string(claim.behaviour));
  if (claim.order > 0.0) text += fmt::format(", order {}", short_number(claim.order));
  if (!claim.reason.empty()) text += fmt::format(" [{}]", claim.reason);
  return velocity.empty() ? text : text + ", " + velocity;
}

std::string case_text(const record::CaseSummary& problem, std::string_view space) {
  std::string parameters;
  for (const auto& p : problem.parameters)
    parameters += fmt::format("{0}{2}{1}={1}{3}{4}{5}", parameters.empty() ? "" : ", ", space,
                              p.name, p.text.empty() ? exact_number(p.value) : p.text,
                              p.unit.empty() ? "" : space, p.unit);
  return parameters.empty() ? problem.name : fmt::format("{} ({})", problem.name, parameters);
}

std::string length_text(const record::CaseSummary& problem) {
  return fmt::format("{} s with {}; fast period {} s", short_number(problem.end),
                     counted(problem.impact_count, "impact"), short_number(problem.fast_period, 4));
}

std::string plan_text(const record::CaseRecord& problem) {
  const auto& plan = problem.plan;
  if (plan.levels == 0) return {};
  const double finest = plan.coarsest / std::exp2(plan.levels - 1);
  const auto per_period = [&](double step) {
    return short_number(problem.problem.fast_period / step, 4);
  };
  const auto steps = fmt::format(
      "{} of {}, h = {} s to {} s, {} to {} steps per fast period", counted(plan.levels, "level"),
      counted(plan.samples_per_level, "step"), short_number(plan.coarsest, 3),
      short_number(finest, 3), per_period(plan.coarsest), per_period(finest));
  const auto is_adaptive = [](const record::Subject& subject) {
    return subject.kind == record::SubjectKind::method && !subject.levels.empty() &&
           subject.refined_by == record::RefinementParameter::tolerance;
  };
  const auto adaptive = std::ranges::find_if(problem.subjects, is_adaptive);
  if (adaptive == problem.subjects.end()) return steps;
  const auto tolerances = fmt::format(
      "{}, tolerance {} to {}", counted(static_cast<long long>(adaptive->levels.size()), "level"),
      short_number(adaptive->levels.front().step, 3),
      short_number(adaptive->levels.back().step, 3));
  const bool are_all = std::ranges::all_of(problem.subjects, is_adaptive);
  return are_all ? tolerances : fmt::format("{}; adaptive: {}", steps, tolerances);
}

OpeningLine opening_line(const record::Record& record) {
  const auto word = record::verdict_word(record);
  OpeningLine line;
  line.text = fmt::format("{}{}: ", char(std::toupper(word.front())), word.substr(1));
  const bool is_alone = record.cases.size() == 1 && record.cases.front().subjects.size() == 1;
  if (!is_alone) {
    auto counts = verdict_line(record).counts;
    if (const auto colon = counts.find(':'); colon != std::string::npos) {
      counts.front() = 'o';
      counts[colon] = ',';
    }
    line.text += counts;
    return line;
  }
  const auto& subject = record.cases.front().subjects.front();
  if (const auto* cause = deciding_cause(subject); cause != nullptr && word != "agrees") {
    line.has_cause = true;
    line.text += text_of(diagnosis_text(*cause));
  } else if (const auto found = finding(subject)) {
    line.has_finding = true;
    line.text += text_of(*found);
  } else {
    const auto& fit = subject.assessment.displacement;
    const double most = (1.0 + judge::envelope_order_tolerance) * subject.claim.order;
    line.text += fit_text(fit);
    line.text += fit.has_line && subject.claim.order > 0.0 && fit.order > most
                     ? fmt::format(", more than claimed ({}).", claim_text(subject.claim))
                     : ", as claimed.";
  }
  return line;
}

VerdictLine verdict_line(const record::Record& record) {
  const auto all = record::counts(record);
  VerdictLine line;
  line.word = record::verdict_word(record);
  const bool is_check = record.command == "check";
  struct Part {
    int count;
    std::string_view singular, plural;
  };
  std::string parts;
  for (const auto& [count, singular, plural] :
       {Part{all.agrees, "agrees", "agree"}, Part{all.disagrees, "disagrees", "disagree"},
        Part{all.undecided, "undecided", "undecided"},
        Part{all.not_claimed, "not claimed", "not claimed"},
        Part{all.refused, "refused", "refused"},
        Part{all.interrupted, "interrupted", "interrupted"}})
    if (count > 0)
      parts +=
          fmt::format("{}{} {}", parts.empty() ? "" : ", ", count, count == 1 ? singular : plural);
  if (!is_check || all.total() > 1)
    line.counts = fmt::format("Of {}: {}.",
                              record.cases.size() == 1
                                  ? counted(all.total(), "method")
                                  : fmt::format("{} on {}", counted(all.total(), "verdict"),
                                                counted(std::ssize(record.cases), "case")),
                              parts.empty() ? "none was assessed" : parts);

  // First what decides the verdict, then the page, then what a word in the table means.
  const record::Subject* decisive = nullptr;
  for (const auto& problem : record.cases)
    for (const auto& subject : problem.subjects)
      if (decisive == nullptr && record::verdict_word(subject) == line.word && finding(subject))
        decisive = &subject;
  const auto* cause = decisive == nullptr ? nullptr : deciding_cause(*decisive);
  const auto code = cause != nullptr      ? cause->code
                    : decisive == nullptr ? std::string()
                                          : finding(*decisive)->code;
  const auto next = [&](std::string command, std::string in_words = {}) {
    line.next_in_words = in_words.empty() ? command : std::move(in_words);
    line.next = std::move(command);
  };
  const record::CaseRecord* place = nullptr;
  for (const auto& problem : record.cases)
    for (const auto& subject : problem.subjects)
      if (&subject == decisive) place = &problem;
  const auto option = place == nullptr || line.word == "disagrees"
                          ? std::nullopt
                          : deciding_option(*place, *decisive);
  const auto command =
      record.provenance.command.empty() ? "clackers " + record.command : record.provenance.command;
  // Of one history or a few the report says which to add.
  const bool needs_more = decisive != nullptr && cause == nullptr && !hint_text(*decisive).empty();
  const bool is_decided =
      line.word == "agrees" || (line.word == "not claimed" && (code.empty() || needs_more));
  const bool call = is_call(command);
  const auto explain = [&](const std::string& known) {
    next(call ? fmt::format("clackers.explain(\"{}\")", known) : "clackers explain " + known);
  };
  const auto same_with = [&](const std::string& name, const std::string& value,
                             const std::string& words = {}) {
    const auto text = call ? argument_text(name, value) : fmt::format("{} {}", name, value);
    const auto in_words = fmt::format("the same with {}{}", text, words);
    next(call ? in_words : with_option(command, name, value), in_words);
  };
  if (record.interrupted)
    next(command, call ? "the same call again" : "the same command again");
  else if (!call && cause != nullptr && !cause->text.empty() &&
           (code == Code("columns-exchanged").name() || code == Code("masses-exchanged").name()))
    same_with("--columns", cause->text);
  else if (option)
    same_with(option->option, option->value, option->words);
  else if (!is_decided && !code.empty())
    explain(code);
  else if (is_check && line.word == "disagrees")
    next(call ? fmt::format("clackers.case(\"{}\").impacts()", record.cases.front().problem.name)
              : fmt::format("clackers respond {} --impacts", record.cases.front().problem.name));
  else if (const auto expect = expectation(record); code.empty() && !expect.empty())
    same_with("--expect", expect);
  else if (call)
    next("record.save(\"report.html\")");
  else if (!has_option(command, "--report"))
    same_with("--report", "report.html");
  else
    explain(code.empty() ? "proper" : code);
  return line;
}

std::string resolution_text(const record::Subject& subject, double step, int digits) {
  return subject.refined_by == record::RefinementParameter::tolerance
             ? "tolerance " + short_number(step, digits)
             : fmt::format("h = {} s", short_number(step, digits));
}

std::string short_path(std::string_view path) {
  return std::string(path.substr(path.find_last_of('/') + 1));
}

std::string history_name(const record::Subject& subject, const record::Run& run) {
  if (subject.kind == record::SubjectKind::histories) return short_path(run.file->file);
  return fmt::format("{} at {}", subject.name, resolution_text(subject, run.score.step, 3));
}

}  // namespace clackers::report
