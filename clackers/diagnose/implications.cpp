#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/diagnose/diagnosis.hpp"

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
  double least_lead = -less_sure;    ///< in confidence, of a cause over what it replaces
  std::string_view other_than = {};  ///< not where the cause has this unit
};

const std::vector<Implication>& implications() {
  static const auto unreadable = of_group(CauseGroup::reading),
                    of_system = of_group(CauseGroup::system), of_gap = of_group(CauseGroup::gap),
                    of_impacts = of_group(CauseGroup::impacts),
                    of_time = of_group(CauseGroup::time), of_method = of_group(CauseGroup::method),
                    of_ladder = Codes{"wrong-limit", "noise-floor", "commensurate-steps"},
                    of_output = of_group(CauseGroup::output);
  static const auto of_rigid_impacts = [] {
    auto codes = of_group(CauseGroup::impacts);
    std::erase_if(codes, [](const Code& code) { return code.name() == "contact-compliant"; });
    return codes;
  }();
  static const std::vector<Implication> table{
      // Numbers that are not those of the case: nothing fitted to them means anything.
      {unreadable, all({of_system,
                        of_gap,
                        of_impacts,
                        of_time,
                        of_method,
                        of_ladder,
                        {"velocity-at-half-steps", "velocity-order-lower"}})},
      {of_output, all({of_system,
                       of_gap,
                       of_impacts,
                       of_time,
                       of_method,
                       of_ladder,
                       {"velocity-order-lower", "output-resampled"}})},
      {of_system, all({of_method, {"wrong-limit", "noise-floor"}})},
      // Each impact early or late by what the closing speed makes of the gap.
      {of_gap, all({of_rigid_impacts, of_time, of_method, {"wrong-limit", "noise-floor"}})},
      {of_gap, {"parameter-differs"}, -0.1},
      {{"impact-missed", "impact-doubled"},
       all({of_system,
            of_gap,
            of_time,
            of_method,
            {"wrong-limit", "noise-floor", "impact-impulse-wrong", "contact-in-tension"}})},
      {{"impact-impulse-wrong"}, all({of_method, {"wrong-limit", "noise-floor"}})},
      {{"time-shifted", "time-drifts"},
       all({of_method, {"noise-floor", "impact-tolerance", "impact-at-step-end"}})},
      // Times that are late by steps have the right limit.
      {{"time-shifted", "time-drifts"}, {"wrong-limit"}, -less_sure, "steps"},
      // Rows inside a contact show that it lasts; a fit of rigid impacts does not see them.
      {{"contact-compliant"},
       all({of_system,
            of_gap,
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
      // Without half of the acceleration a velocity is that of half a step before.
      {{"acceleration-not-renewed"}, of_time},
      {{"velocity-at-half-steps"},
       {"velocity-order-lower", "contact-in-tension", "impact-at-step-end", "impact-interpolated"}},
      {{"output-resampled"},
       {"velocity-order-lower", "impact-interpolated", "impact-at-step-end", "contact-in-tension",
        "noise-floor"}},
      // Impacts at steps would make displacements of order one as well.
      {{"velocity-order-lower"},
       {"impact-at-step-end", "impact-interpolated", "restitution-scatters", "restitution-varies",
        "restitution-differs", "momentum-not-kept", "contact-in-tension"}},
      // The velocity of a row at an impact is either limit.
      {{"commensurate-steps"}, {"velocity-order-lower"}},
      {{"printed-digits"}, {"noise-floor", "impact-tolerance"}},
      {{"single-precision"}, {"printed-digits", "noise-floor", "impact-tolerance"}},
      {{"wrong-limit"}, of_method},
  };
  return table;
}

bool contains(const Codes& codes, const std::string& code) {
  return std::ranges::find(codes, code, &Code::name) != codes.end();
}

}  // namespace

bool brings_about(const Diagnosis& cause, const Diagnosis& implied) {
  return cause.code != implied.code &&
         std::ranges::any_of(implications(), [&](const Implication& rule) {
           return contains(rule.causes, cause.code) && contains(rule.implied, implied.code) &&
                  (rule.other_than.empty() || cause.unit != rule.other_than) &&
                  cause.confidence >= implied.confidence + rule.least_lead;
         });
}

}  // namespace clackers::diagnose
