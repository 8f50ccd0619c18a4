#include "clackers/diagnose/diagnose.hpp"

#include <algorithm>
#include <functional>
#include <vector>

#include "clackers/diagnose/causes.hpp"

namespace clackers::diagnose {
namespace {

using Codes = std::vector<Code>;

Codes of_group(CauseGroup group) {
  Codes codes;
  for (const auto& cause : causes())
    if (cause.group == group) codes.push_back(cause.code);
  return codes;
}

Codes all(std::initializer_list<Codes> groups) {
  Codes joined;
  for (const auto& group : groups) joined.insert(joined.end(), group.begin(), group.end());
  return joined;
}

// A cause that is this much less sure than what it implies does not replace it.
constexpr double less_sure = 0.25;

// Each of `causes` brings about what each of `implied` describes.
struct Implication {
  Codes causes, implied;
  double least_lead = -less_sure;  ///< in confidence, of a cause over what it replaces
};

const std::vector<Implication>& implications() {
  static const auto unreadable = of_group(CauseGroup::reading),
                    of_system = of_group(CauseGroup::system), of_gap = of_group(CauseGroup::gap),
                    of_impacts = of_group(CauseGroup::impacts),
                    of_time = of_group(CauseGroup::time), of_method = of_group(CauseGroup::method),
                    of_ladder = of_group(CauseGroup::ladder);
  static const std::vector<Implication> table{
      // Numbers that are not those of the case: nothing fitted to them means anything.
      {unreadable, all({of_system,
                        of_gap,
                        of_impacts,
                        of_time,
                        of_method,
                        of_ladder,
                        {"velocity-at-half-steps", "velocity-order-lower"}})},
      {of_system, all({of_method, {"wrong-limit", "noise-floor"}})},
      // Each impact early or late by what the closing speed makes of the gap.
      {of_gap, all({of_impacts, of_time, of_method, {"wrong-limit", "noise-floor"}})},
      {{"impact-missed", "impact-doubled"},
       all({of_system,
            of_gap,
            of_time,
            of_method,
            {"wrong-limit", "noise-floor", "impact-impulse-wrong", "contact-in-tension"}})},
      {{"impact-impulse-wrong"}, all({of_method, {"wrong-limit", "noise-floor"}})},
      {{"time-shifted", "time-drifts"},
       all({of_method, {"wrong-limit", "noise-floor", "impact-tolerance", "impact-at-step-end"}})},
      {{"contact-compliant"},
       all({of_system,
            of_time,
            of_method,
            {"wrong-limit", "noise-floor", "impact-tolerance", "impact-at-step-end",
             "impact-interpolated", "impact-missed", "impact-doubled", "impact-impulse-wrong"}})},
      {{"contact-in-tension"},
       all({of_system, of_time, of_method, {"wrong-limit", "contact-compliant"}})},
      {{"impact-at-step-end"},
       all({of_time, of_method, {"impact-interpolated", "impact-tolerance", "noise-floor"}})},
      {{"impact-tolerance"}, {"noise-floor", "impact-interpolated", "time-shifted", "wrong-limit"}},
      // Delays that vary little with the step look like a small change of the system.
      {{"impact-tolerance", "impact-at-step-end"}, of_system, 0.1},
      {{"velocity-at-half-steps"},
       {"velocity-order-lower", "contact-in-tension", "impact-at-step-end", "impact-interpolated"}},
      {{"output-resampled"},
       {"velocity-order-lower", "impact-interpolated", "impact-at-step-end", "contact-in-tension",
        "noise-floor"}},
      {{"printed-digits"}, {"noise-floor", "impact-tolerance"}},
      {{"single-precision"}, {"printed-digits", "noise-floor", "impact-tolerance"}},
      {{"wrong-limit"}, of_method},
  };
  return table;
}

bool contains(const Codes& codes, const std::string& code) {
  return std::ranges::find(codes, code, &Code::name) != codes.end();
}

bool is_unreadable(const Diagnosis& found) {
  return find_cause(found.code)->group == CauseGroup::reading;
}

bool is_implied(const Diagnosis& one, const std::vector<Diagnosis>& found) {
  return std::ranges::any_of(implications(), [&](const Implication& rule) {
    return contains(rule.implied, one.code) &&
           std::ranges::any_of(found, [&](const Diagnosis& cause) {
             return cause.code != one.code && contains(rule.causes, cause.code) &&
                    cause.confidence >= one.confidence + rule.least_lead;
           });
  });
}

void add(std::vector<Diagnosis>& all, std::vector<Diagnosis> more) {
  for (auto& one : more) {
    if (!(one.confidence >= least_confidence)) continue;
    const auto same = std::ranges::find(all, one.code, &Diagnosis::code);
    if (same == all.end())
      all.push_back(std::move(one));
    else if (same->confidence < one.confidence)
      *same = std::move(one);
  }
}

}  // namespace

std::vector<Diagnosis> diagnose(const Question& question) {
  std::vector<Diagnosis> found;
  if (!question.is_this_system) add(found, file_causes(question));
  const bool is_readable = std::ranges::none_of(found, is_unreadable);
  if (is_readable) {
    if (!question.is_this_system) add(found, system_causes(question));
    add(found, ladder_causes(question));
  }
  std::vector<Diagnosis> kept;
  std::ranges::copy_if(found, std::back_inserter(kept),
                       [&](const Diagnosis& one) { return !is_implied(one, found); });
  std::ranges::stable_sort(kept, std::greater{}, &Diagnosis::confidence);
  return kept;
}

}  // namespace clackers::diagnose
