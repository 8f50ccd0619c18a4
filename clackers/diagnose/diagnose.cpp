#include "clackers/diagnose/diagnose.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "clackers/diagnose/causes.hpp"
#include "clackers/diagnose/ladder/sanity.hpp"
#include "clackers/diagnose/system/measured_causes.hpp"

namespace clackers::diagnose {
namespace {

bool is_unreadable(const Diagnosis& found) {
  return find_cause(found.code)->group == CauseGroup::reading;
}

/// Of the fit of a system to exact flights; a method's own error leaves less.
constexpr double gain_of_exact_flights = 1e6;

bool is_of_digits(const Diagnosis& found) {
  return found.confidence > least_confidence && (found.code == Code("printed-digits").name() ||
                                                 found.code == Code("single-precision").name());
}

// The same fault of another mass, contact or link is another cause.
bool is_same(const Diagnosis& one, const Diagnosis& other) {
  const auto same_number = [&](const char* name) {
    const double a = one.fact(name), b = other.fact(name);
    return a == b || (std::isnan(a) && std::isnan(b));
  };
  return one.code == other.code && one.text == other.text && same_number("mass") &&
         same_number("contact");
}

void add(std::vector<Diagnosis>& all, std::vector<Diagnosis> more) {
  for (auto& one : more)
    if (one.confidence >= least_confidence &&
        std::ranges::none_of(all, [&](const Diagnosis& known) { return is_same(known, one); }))
      all.push_back(std::move(one));
}

}  // namespace

std::vector<Diagnosis> diagnose(const DiagnosisInput& asked) {
  std::vector<Diagnosis> found;
  if (!asked.is_this_system) add(found, file_causes(asked));
  const auto says = [&](auto is) { return std::ranges::any_of(found, is); };
  // Rounded numbers agree where those that were computed do not.
  auto broken = says(is_of_digits) ? std::nullopt : no_ladder(asked);
  if (broken && broken->code != Code("step-without-effect").name()) return {*broken};
  if (!says(is_unreadable)) {
    auto question = asked;
    // Histories that are one tell what the finest tells alone.
    if (broken) {
      question.histories = asked.histories.last(1);
      question.limit = {};
    }
    if (!question.is_this_system) add(found, system_causes(question));
    // Exact flights of another system differ by roundings as well.
    if (says([](const Diagnosis& one) { return one.fact("gain") > gain_of_exact_flights; }))
      broken.reset();
    if (!broken) add(found, ladder_causes(asked));
  }
  if (broken) add(found, {*broken});
  // Errors that scatter are no matter of the period.
  if (asked.displacement.behaviour == Behaviour::irregular || asked.displacement.on_envelope)
    std::erase_if(found, [](const Diagnosis& one) { return one.code == "period-error"; });
  std::vector<Diagnosis> kept;
  std::ranges::copy_if(found, std::back_inserter(kept), [&](const Diagnosis& implied) {
    return std::ranges::none_of(
        found, [&](const Diagnosis& cause) { return brings_about(cause, implied); });
  });
  std::ranges::stable_sort(kept, std::greater{}, &Diagnosis::confidence);
  if (is_elsewhere(asked) || says(is_other_system))
    std::stable_partition(kept.begin(), kept.end(), std::not_fn(is_of_right_methods));
  return kept;
}

}  // namespace clackers::diagnose
