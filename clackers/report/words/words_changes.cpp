#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/report/format.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

using study::ChangeAtStep;

std::string at(double step) { return fmt::format("at h = {} s", short_number(step, 4)); }

std::string verdict_of(const study::Finding& found) {
  if (found.refused) return "refused";
  if (!found.complete) return "interrupted";
  return std::string(to_string(found.verdict));
}

std::string behaviour_of(const study::Finding& found) {
  if (found.refused) return "not run";
  const auto word = std::string(to_string(found.behaviour));
  return found.reason.empty() ? word : fmt::format("{} [{}]", word, found.reason);
}

void add_finding(const study::Change<study::Finding>& change, std::vector<std::string>& out) {
  const auto& [before, now] = change;
  const auto add = [&](std::string_view what, const std::string& old_text,
                       const std::string& new_text) {
    if (old_text != new_text)
      out.push_back(fmt::format("{} {}, before {}.", what, new_text, old_text));
  };
  add("verdict", verdict_of(before), verdict_of(now));
  if (before.refused && now.refused)
    add("refused as", fmt::format("[{}]", before.reason), fmt::format("[{}]", now.reason));
  else
    add("behaviour", behaviour_of(before), behaviour_of(now));
  add("claims", claim_text(before.claim), claim_text(now.claim));
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

std::string count_or_none(long long count) {
  return count == 0 ? "none" : fmt::format("{}", count);
}

void add_impacts(const ChangeAtStep<study::ImpactCounts>& change, std::vector<std::string>& out) {
  const auto& [step, before, now] = change;
  if (before.missed != now.missed)
    out.push_back(fmt::format("misses {} of {} {}, before {}.", count_or_none(now.missed),
                              counted(now.expected, "impact"), at(step),
                              count_or_none(before.missed)));
  if (before.extra != now.extra)
    out.push_back(fmt::format(
        "finds {} {}, before {}.",
        now.extra == 0 ? std::string("no extra impact") : counted(now.extra, "extra impact"),
        at(step), count_or_none(before.extra)));
}

}  // namespace

std::vector<std::string> change_texts(const study::SubjectChange& change) {
  using Presence = study::SubjectChange::Presence;
  if (change.presence == Presence::added) return {"is new; the baseline does not have it."};
  if (change.presence == Presence::gone) return {"is gone; only the baseline has it."};
  std::vector<std::string> out;
  if (change.finding) add_finding(*change.finding, out);
  if (change.order)
    out.push_back(fmt::format("order {}, before {}.", order_text(change.order->now),
                              order_text(change.order->before)));
  if (change.error) out.push_back(error_sentence(*change.error));
  if (change.impacts) add_impacts(*change.impacts, out);
  if (change.finished)
    out.push_back(fmt::format("the run {} {}.", at(change.finished->step),
                              change.finished->now ? "reaches its end, before it failed"
                                                   : "fails, before it reached its end"));
  if (change.work)
    out.push_back(fmt::format("takes {} force evaluations {}, before {}.", change.work->now,
                              at(change.work->step), change.work->before));
  return out;
}

std::string change_summary(const study::BaselineComparison& changes) {
  const auto all = std::ssize(changes.subjects);
  const auto changed = std::ranges::count_if(changes.subjects, &study::SubjectChange::any);
  const auto is_method = [](const study::SubjectChange& change) {
    return change.name != "histories";
  };
  const auto noun = std::ranges::all_of(changes.subjects, is_method) ? "method" : "subject";
  const auto what = changed == 0 ? fmt::format("nothing changed in {}", counted(all, noun))
                                 : fmt::format("{} of {} changed", changed, counted(all, noun));
  return fmt::format("Against the baseline of {} (clackers {}{}): {}.", changes.before.date,
                     changes.before.version, changes.interrupted ? ", interrupted" : "", what);
}

}  // namespace clackers::report
