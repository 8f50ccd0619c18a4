#include "clackers/report/changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "clackers/report/digest.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/layout.hpp"

namespace clackers::report {
namespace {

using study::Change;
using study::ChangeAtStep;
using study::Collisions;
using study::Standing;

std::string at(double step) { return fmt::format("at h = {} s", short_number(step, 4)); }

std::string verdict_of(const Standing& s) {
  if (s.refused) return "refused";
  if (!s.complete) return "interrupted";
  return std::string(to_string(s.verdict));
}

std::string behaviour_of(const Standing& s) {
  if (s.refused) return "not run";
  const auto word = std::string(to_string(s.behaviour));
  return s.reason.empty() ? word : fmt::format("{} [{}]", word, s.reason);
}

void add_standing(const Change<Standing>& standing, std::vector<std::string>& out) {
  const auto& [before, now] = standing;
  const auto say = [&](std::string_view what, const std::string& a, const std::string& b) {
    if (a != b) out.push_back(fmt::format("{} {}, before {}.", what, b, a));
  };
  say("verdict", verdict_of(before), verdict_of(now));
  if (before.refused && now.refused)
    say("refused as", fmt::format("[{}]", before.reason), fmt::format("[{}]", now.reason));
  else
    say("behaviour", behaviour_of(before), behaviour_of(now));
  say("claims", claim_text(before.claim), claim_text(now.claim));
}

std::string error_sentence(const ChangeAtStep<double>& error) {
  const auto numbers =
      fmt::format("{}, before {}.", scientific(error.now, 2), scientific(error.before, 2));
  const double factor = error.now / error.before;
  if (!(std::isfinite(factor) && factor > 0.0))
    return fmt::format("error in u {}: {}", at(error.step), numbers);
  const bool grew = factor > 1.0;
  return fmt::format("error in u {} {} by a factor {}: {}", at(error.step),
                     grew ? "grew" : "shrank", short_number(grew ? factor : 1.0 / factor, 3),
                     numbers);
}

std::string count_of(long long n) { return n == 0 ? "none" : fmt::format("{}", n); }

void add_collisions(const ChangeAtStep<Collisions>& change, std::vector<std::string>& out) {
  const auto& [step, before, now] = change;
  if (before.missed != now.missed)
    out.push_back(fmt::format("misses {} of {} collisions {}, before {}.", count_of(now.missed),
                              now.expected, at(step), count_of(before.missed)));
  if (before.extra != now.extra)
    out.push_back(fmt::format("finds {} extra collisions {}, before {}.",
                              now.extra == 0 ? "no" : fmt::format("{}", now.extra), at(step),
                              count_of(before.extra)));
}

std::vector<std::string> sentences_of(const study::MethodChange& method) {
  using Presence = study::MethodChange::Presence;
  if (method.presence == Presence::added) return {"is new; the baseline does not have it."};
  if (method.presence == Presence::gone) return {"is gone; only the baseline has it."};
  std::vector<std::string> out;
  if (method.standing) add_standing(*method.standing, out);
  if (method.order)
    out.push_back(fmt::format("order {}, before {}.", order_text(method.order->now),
                              order_text(method.order->before)));
  if (method.error) out.push_back(error_sentence(*method.error));
  if (method.collisions) add_collisions(*method.collisions, out);
  if (method.finished)
    out.push_back(fmt::format("the run {} {}.", at(method.finished->step),
                              method.finished->now ? "reaches its end, before it failed"
                                                   : "fails, before it reached its end"));
  if (method.work)
    out.push_back(fmt::format("takes {} force evaluations {}, before {}.", method.work->now,
                              at(method.work->step), method.work->before));
  return out;
}

}  // namespace

std::vector<ChangeText> change_texts(const study::BaselineComparison& comparison) {
  std::vector<ChangeText> out;
  for (const auto& method : comparison.methods)
    if (method.any()) out.push_back({method.name, sentences_of(method)});
  return out;
}

std::string change_summary(const study::BaselineComparison& comparison) {
  const auto all = comparison.methods.size();
  const auto changed = std::ranges::count_if(comparison.methods, &study::MethodChange::any);
  const auto methods = all == 1 ? "method" : "methods";
  const auto what = changed == 0 ? fmt::format("nothing changed in {} {}", all, methods)
                                 : fmt::format("{} of {} {} changed", changed, all, methods);
  return fmt::format("Against the baseline of {} (clackers {}{}): {}.", comparison.before.date,
                     comparison.before.version, comparison.interrupted ? ", interrupted" : "",
                     what);
}

void write_changes(const study::BaselineComparison& comparison, std::ostream& out,
                   const Style& style) {
  const auto print = [&](const std::string& text) {
    for (const auto& line : wrap(text, std::size_t(std::max(style.width, 20)))) out << line << '\n';
  };
  print(change_summary(comparison));
  for (const auto& text : change_texts(comparison))
    for (const auto& sentence : text.sentences) {
      study::MethodResult named;
      named.name = text.method;
      print(fmt::format("{}: {}", typed_name(named), sentence));
    }
}

}  // namespace clackers::report
