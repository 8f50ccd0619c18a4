#include "clackers/report/digest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "clackers/report/format.hpp"
#include "clackers/study/verify.hpp"

namespace clackers::report {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void raise(double& most, double value) {
  if (std::isnan(most) || value > most) most = value;
}

void add_impacts(std::optional<assess::ImpactScore>& worst, const assess::ImpactScore& score) {
  const auto wrong = [](const assess::ImpactScore& s) { return s.missed + s.extra; };
  const double time_error = std::max(worst ? worst->worst_time_error : 0.0, score.worst_time_error);
  if (!worst || wrong(score) > wrong(*worst)) worst = score;
  worst->worst_time_error = time_error;
}

// What the reader should be told to type: the command that was typed, with a report.
std::string with_report(const std::string& command) {
  const std::string base = command.empty() ? "clackers verify" : command;
  return base + " --report report.html";
}

bool has_report(const std::string& command) {
  return command.find("--report") != std::string::npos;
}

}  // namespace

Digest digest(const study::MethodResult& method) {
  Digest d{.step = nan, .u_error = nan, .v_error = nan, .energy_error = nan, .impacts = {}};
  for (const auto& level : method.ladder) {
    d.runs += static_cast<long long>(level.runs.size());
    d.failed_runs += std::ranges::count(level.runs, false, &assess::RunScore::finished);
  }
  const auto finest = std::find_if(method.ladder.rbegin(), method.ladder.rend(),
                                   [](const assess::Level& level) { return !level.runs.empty(); });
  if (finest == method.ladder.rend()) return d;
  d.step = finest->step;
  for (const auto& run : finest->runs) {
    d.force_evaluations = std::max(d.force_evaluations, run.work.force_evaluations);
    d.seconds = std::max(d.seconds, run.seconds);
    if (!run.finished) continue;
    raise(d.u_error, run.u_error);
    raise(d.v_error, run.v_error);
    raise(d.energy_error, run.energy_error);
    if (run.impacts) add_impacts(d.impacts, *run.impacts);
  }
  return d;
}

std::string typed_name(const study::MethodResult& method) {
  constexpr std::string_view understood = "+event-driven";
  const std::string_view name = method.name;
  return std::string(name.ends_with(understood) ? name.substr(0, name.size() - understood.size())
                                                : name);
}

std::string order_text(const assess::LadderFit& fit, std::string_view between) {
  if (!fit.has_line) return {};
  return fmt::format("{:.2f}{}±{:.{}f}", fit.order, between, fit.spread, fit.spread < 9.95 ? 2 : 0);
}

std::string claim_text(const Claim& claim, bool with_code) {
  if (claim.behaviour == Behaviour::undecided) return "nothing";
  auto text = std::string(to_string(claim.behaviour));
  if (claim.order > 0.0) text += fmt::format(", order {}", short_number(claim.order));
  if (with_code && !claim.reason.empty()) text += fmt::format(" [{}]", claim.reason);
  return text;
}

std::string verdict_word(const study::MethodResult& method) {
  if (!method.refusal.empty()) return "refused";
  if (!method.complete) return "interrupted";
  return std::string(to_string(method.assessment.verdict));
}

std::optional<Remark> remark(const study::MethodResult& method) {
  if (!method.refusal.empty()) return Remark{method.refusal, method.refusal_code};
  if (!method.complete)
    return Remark{"interrupted before its last level; judged on what was finished, if at all",
                  "interrupted"};
  const auto& fit = method.assessment.displacement;
  const bool plain = method.assessment.verdict == Verdict::agrees && fit.reason.empty() &&
                     (fit.behaviour == Behaviour::proper || fit.behaviour == Behaviour::exact);
  if (plain) return {};
  return Remark{method.assessment.sentence,
                fit.reason.empty() ? std::string(to_string(fit.behaviour)) : fit.reason};
}

Closing closing(const study::Record& record) {
  const auto count = [&](std::string_view word) {
    return std::ranges::count(record.methods, word, verdict_word);
  };
  std::string parts;
  constexpr std::array<std::array<std::string_view, 2>, 6> words{{{"agrees", "agree"},
                                                                  {"disagrees", "disagree"},
                                                                  {"undecided", "undecided"},
                                                                  {"not claimed", "not claimed"},
                                                                  {"refused", "refused"},
                                                                  {"interrupted", "interrupted"}}};
  for (const auto& [one, several] : words)
    if (const auto n = count(one); n > 0)
      parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", n, n == 1 ? one : several);

  Closing out;
  const int code = study::exit_code(record);
  if (record.interrupted)
    out.word = "interrupted";
  else if (code == 1)
    out.word = "disagrees";
  else if (code == 3)
    out.word = "undecided";
  else
    out.word = count("agrees") > 0 ? "agrees" : "not claimed";
  out.sentence = parts.empty() ? "no method was judged" : parts;

  // First what is wrong, then the picture, then what a word in the table means.
  const auto needs_word = [&](const study::MethodResult& method) {
    return verdict_word(method) == out.word && remark(method).has_value();
  };
  const auto first = std::ranges::find_if(record.methods, needs_word);
  const bool trouble = out.word == "disagrees" || out.word == "undecided";
  const auto say = [&](std::string command, std::string_view in_words) {
    out.next_in_words = in_words.empty() ? command : std::string(in_words);
    out.next = std::move(command);
  };
  const auto& command = record.provenance.command;
  if (record.interrupted)
    say(command.empty() ? "clackers verify" : command, "the same command again");
  else if (trouble && first != record.methods.end())
    say("clackers explain " + remark(*first)->code, {});
  else if (!has_report(command))
    say(with_report(command), "the same with --report report.html");
  else
    say("clackers explain " + (first == record.methods.end() ? "proper" : remark(*first)->code),
        {});
  return out;
}

std::string counted_methods(const study::Record& record) {
  const auto n = record.methods.size();
  return fmt::format("{} method{}", n, n == 1 ? "" : "s");
}

std::string case_text(const study::CaseSummary& problem, std::string_view space) {
  std::string parameters;
  for (const auto& p : problem.parameters)
    parameters += fmt::format("{0}{2}{1}={1}{3}{4}{5}", parameters.empty() ? "" : ", ", space,
                              p.name, exact_number(p.value), p.unit.empty() ? "" : space, p.unit);
  return parameters.empty() ? problem.name : fmt::format("{} ({})", problem.name, parameters);
}

std::string ladder_text(const study::Record& record) {
  const auto& plan = record.plan;
  const double finest = plan.coarsest / std::exp2(plan.levels - 1);
  const auto per_period = [&](double step) {
    return short_number(record.problem.fast_period / step, 4);
  };
  return fmt::format("{} levels of {} steps, h = {} s to {} s, {} to {} steps per fast period",
                     plan.levels, plan.neighbours, short_number(plan.coarsest, 3),
                     short_number(finest, 3), per_period(plan.coarsest), per_period(finest));
}

}  // namespace clackers::report
