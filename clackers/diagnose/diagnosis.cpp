#include "clackers/diagnose/diagnosis.hpp"

#include <algorithm>
#include <cmath>

namespace clackers::diagnose {
namespace {

using Group = CauseGroup;
using Effect = CauseEffect;

// clang-format off
constexpr auto all_causes = std::to_array<Cause>({
    {"unit-scaled", Group::reading, Effect::open, "1",
     "numbers of the file over those in m and m/s",
     "[{quantity} are {value} times those of the case][, in {unit_text}]",
     "convert them to m and m/s."},
    {"columns-exchanged", Group::reading, Effect::open, "1",
     "factor of the numbers, where they are in another unit or sign as well",
     "The columns are in another order than their names",
     "read them with[ --columns {text}]."},
    {"masses-exchanged", Group::reading, Effect::open, "1",
     "factor of the numbers, where they are in another unit or sign as well",
     "The columns of the two masses are exchanged",
     "read them with[ --columns {text}]."},
    {"sign-reversed", Group::reading, Effect::open, "",
     "",
     "The sign[ of {text}] is reversed",
     "measure in the direction of the case, or change the sign."},
    {"starts-at-rest", Group::reading, Effect::open, "m/s",
     "velocity at the start",
     "The history starts at rest[, the case with v{mass} = {expected} m/s]",
     "start with the velocities of the case; a free decay has v(0) = -sigma u(0)."},
    {"velocity-at-half-steps", Group::other, Effect::open, "steps",
     "0.5: half a step later than the row; -0.5: earlier",
     "Velocities are those of half a step {later}",
     "print the mean of two neighbours, at the times of the rows."},
    {"velocity-order-lower", Group::other, Effect::method, "1",
     "order of the velocities",
     "Velocities converge with order {value}[, displacements with {expected}]",
     "check how velocities are updated or printed."},
    {"printed-digits", Group::other, Effect::method, "1",
     "significant digits",
     "Printed digits limit the error[, {digits} in {text}][, and alone may make {floor}]",
     "print 17 significant digits."},
    {"single-precision", Group::other, Effect::method, "bits",
     "of the mantissas",
     "Numbers[ of {text}] have the 24 bits of single precision[, which make an error of {floor}]",
     "compute and print in double precision."},
    {"output-resampled", Group::other, Effect::open, "s",
     "time between rows",
     "The output is resampled[ by {text} interpolation between steps of {step} s][, which makes an error of {floor}]",
     "print the solver's own steps."},
    {"ends-early", Group::other, Effect::open, "s",
     "last time of the history",
     "The history ends at {value} s[ of {expected} s]",
     "run to the end of the case, or set its end (t_end or a_t)."},
    {"output-offset", Group::output, Effect::other_system, "m",
     "displacement of the file minus the true one",
     "{text} is {value_pm} m too large in all rows[ after the first], while the motion is right",
     "check what is added where results are printed."},
    {"output-drifts", Group::output, Effect::other_system, "m/s",
     "rate with which the displacement of the file leaves the true one",
     "{text} drifts by {value_pm} m/s, while the motion is right",
     "check what is added where results are printed."},
    {"time-shifted", Group::time, Effect::open, "steps or s",
     "time of the file minus the true one",
     "Every state stands {shift} too {late}",
     "check which time is printed beside which state."},
    {"time-unit", Group::reading, Effect::open, "1",
     "times of the file over those in seconds",
     "Times {clock}",
     "{clock_cure}."},
    {"time-drifts", Group::time, Effect::open, "s",
     "distance of the last time from the grid of equal steps",
     "Printed times leave the grid of equal steps[, by {value} s in the end]",
     "compute t = n h instead of adding h."},
    {"restitution-differs", Group::system, Effect::other_system, "1",
     "coefficient of restitution of the history",
     "Restitution[ of contact {contact}] looks like {value_pm}[ instead of {expected}]",
     "check the impact law and its coefficient."},
    {"mass-ratio-differs", Group::system, Effect::other_system, "%",
     "relative change of the mass",
     "The mass ratio {looks}",
     "check the masses."},
    {"frequency-differs", Group::system, Effect::other_system, "%",
     "relative change of the natural frequency",
     "The natural frequency[ of mass {mass}] {looks}",
     "check stiffness and mass."},
    {"damping-differs", Group::system, Effect::other_system, "% or 1",
     "relative change of the damping ratio; the ratio where the case has none",
     "Damping[ of mass {mass}][ {text}] {damping}",
     "check the damping coefficients: C, ratio, or per mass."},
    {"stiffness-differs", Group::system, Effect::other_system, "%",
     "relative change of the stiffness",
     "The stiffness {text} {looks}, as each step between impacts shows",
     "check K."},
    {"mass-differs", Group::system, Effect::other_system, "%",
     "relative change of the mass",
     "Mass {mass} {looks}, as each step between impacts shows",
     "check M."},
    {"load-differs", Group::system, Effect::other_system, "1",
     "amplitude of the load over that of the case",
     "{whose_load} {load}, as each step between impacts shows",
     "check where the load is added, and at which time it is evaluated."},
    {"constant-force", Group::system, Effect::other_system, "N",
     "the force",
     "A constant force of {value_pm} N acts on mass {mass}",
     "check loads, gravity and the position of rest."},
    {"restitution-varies", Group::system, Effect::other_system, "s/m",
     "change of the coefficient of restitution with the closing speed",
     "Restitution[ of contact {contact}] depends on the closing speed: it changes by {value} for each m/s",
     "check the impact law; the case has one coefficient for all speeds."},
    {"restitution-threshold", Group::system, Effect::other_system, "m/s",
     "closing speed below which impacts do not bounce",
     "Impacts[ of contact {contact}] slower than {value_pm} m/s do not bounce",
     "set the threshold speed of restitution to 0."},
    {"energy-gained-at-impacts", Group::system, Effect::other_system, "1",
     "change of the coefficient of restitution for each step that an impact comes late",
     "Impacts[ of contact {contact}] gain energy: restitution grows by {value} with each step that they come late",
     "let the correction of penetration not change velocities; in engines, set error reduction to 0."},
    {"restitution-scatters", Group::system, Effect::other_system, "1",
     "largest distance between coefficients of restitution of one history",
     "Restitution[ of contact {contact}] scatters by {value} between impacts, with the place of the impact in its step",
     "check what is done to velocities in the step before the impact."},
    {"momentum-not-kept", Group::system, Effect::other_system, "1",
     "part of the change of momentum that no impulse along the contact makes",
     "Impacts[ of contact {contact}] do not keep momentum: {percent} of its change is no impulse along the contact",
     "let the impulse act on both masses, with opposite signs."},
    {"damping-changes-at-impact", Group::system, Effect::other_system, "1",
     "damping after the first impact over that before",
     "After the first impact damping is another[, {value} times that before]",
     "check the damping force where a step starts anew after an impact."},
    {"parameter-differs", Group::system, Effect::other_system, "that of the parameter",
     "value of the parameter that the history fits",
     "The history fits {text}[ = {value_pm}][ instead of {expected}]",
     "check that parameter, and what is computed from it."},
    {"gap-differs", Group::gap, Effect::other_system, "m",
     "gap of the case at which contacts close",
     "Contacts close at a gap of {value_pm} m instead of 0",
     "check the gap of the contact and the positions that it is measured from."},
    {"impact-missed", Group::impacts, Effect::other_system, "1",
     "number of the impact",
     "{impacts} missing[ (t = {time} s)]",
     "check the detection of contacts: the masses pass through each other there."},
    {"impact-doubled", Group::impacts, Effect::other_system, "1",
     "number of the impact",
     "Impact {number} was applied twice[ (t = {time} s)]",
     "check the detection of contacts just after an impact."},
    {"impact-impulse-wrong", Group::impacts, Effect::other_system, "1",
     "impulse over the right one",
     "The impulse of the impacts is {value_pm} times the right one",
     "check effective masses and the factor 1 + eta."},
    {"impact-at-step-end", Group::impacts, Effect::open, "steps",
     "mean delay of impacts",
     "Impacts are applied at the {text} of the step in which they happen[, or {steps} steps later]",
     "locate the impact within the step; the order is one otherwise."},
    {"impact-interpolated", Group::impacts, Effect::open, "1",
     "order of the impact times",
     "Impacts are located with order {value}, the flights between them with more",
     "locate them with dense output of the integrator's order."},
    {"event-interpolated", Group::impacts, Effect::open, "1",
     "power of the solver's own steps that the state at impacts errs by",
     "States at impacts are interpolated with order {value} between the solver's own steps, which are far better",
     "limit the largest step, or find the event on an interpolant of the solver's order."},
    {"impact-tolerance", Group::impacts, Effect::open, "s",
     "largest delay of an impact",
     "Impacts are located to {value} s, whatever the step",
     "tighten the tolerance of the search for impacts."},
    {"acceleration-not-renewed", Group::impacts, Effect::open, "1",
     "part of the step that the old acceleration acts for",
     "The acceleration {text} is not that of the state there: {value} of a step goes on with another one",
     "compute it from the equation of motion there; the order is one otherwise."},
    {"contact-compliant", Group::impacts, Effect::open, "s",
     "median duration of a contact",
     "Contacts last {value} s[ and penetrate {penetration} m], not rigid[ but those of a spring of {stiffness} N/m]",
     "a stiffer spring with smaller steps comes closer to rigid impacts."},
    {"contact-in-tension", Group::impacts, Effect::open, "1",
     "impulse in tension over impulse in compression",
     "The contact pulls[, with {share_percent} of its impulse in tension]",
     "let the contact force act only in compression."},
    {"step-without-effect", Group::ladder, Effect::no_ladder, "",
     "",
     "The {text} has no effect: all {files} histories agree to rounding at their common times",
     "let the solver use it; of one with a fixed tolerance judge several tolerances, by --tolerances."},
    {"fixed-internal-step", Group::ladder, Effect::no_ladder, "s",
     "step that is taken",
     "The solver takes steps of {value} s for every step asked: {files} histories show the states of such steps only",
     "give the step to the solver as its internal one."},
    {"steps-contradict-rows", Group::ladder, Effect::no_ladder, "",
     "",
     "The steps contradict the rows: the smaller the step of a history, the farther its rows are apart",
     "give the steps in the order of the files; they seem reversed."},
    {"odd-file", Group::ladder, Effect::open, "1",
     "error of the file over that of its neighbours",
     "One history of {files}, {level}, does not belong to the others: its error is {value} times theirs. The verdict is that of the others",
     "run that one again."},
    {"wrong-limit", Group::ladder, Effect::open, "1",
     "distance of the limit over the envelope",
     "The histories converge[ with order {order}] to another motion[, {value} of the envelope away][; they are right until impact {impact}, t = {time} s, and wrong from there]",
     "check parameters and equations; smaller steps will not help."},
    {"noise-floor", Group::ladder, Effect::noise, "1",
     "error of the floor over the envelope",
     "The error ends in a rough floor[ of {floor}]",
     "tighten tolerances of the solver; smaller steps will not help."},
    {"commensurate-steps", Group::ladder, Effect::method, "1",
     "part of the steps",
     "Small errors of some steps[, {share_percent} of all,] are coincidence: the steps divide the time between impacts[, {time} s]",
     "use steps that do not divide it."},
    {"numerical-damping", Group::method, Effect::method, "1",
     "part of the energy that is lost at the finest step",
     "The method takes {percent} of the energy[ at h = {step} s], less with smaller steps[ (order {order})]",
     "the error is the method's, not the model's; use smaller steps, or a method without dissipation."},
    {"period-error", Group::method, Effect::method, "%",
     "relative change of the frequency at the finest step",
     "The motion {runs}[ at h = {step} s], less with smaller steps[ (order {order})]",
     "the error is the method's, not the model's; use smaller steps."},
    {"force-step", Group::other, Effect::method, "1",
     "acceleration times h^2 in the displacement of a step; 1 in symplectic Euler, 0 in explicit Euler",
     "A step h moves masses by {value_pm} h^2 times their acceleration, where 1 keeps the energy bounded: it grows at every step size",
     "compute forces in each internal step, use one such step, or springs of the engine itself."},
    {"unstable-coarse-steps", Group::other, Effect::method, "s",
     "largest stable step",
     "Runs[ with h = {step} s and more] fail or grow without bound[; h = {value} s does not]",
     "start from a smaller step."},
});
// clang-format on

using Codes = std::vector<Code>;

Codes of_group(CauseGroup group) {
  Codes codes;
  for (const auto& cause : all_causes)
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

bool surely_has(const Diagnosis& found, Effect effect) {
  const auto* cause = find_cause(found.code);
  return cause != nullptr && cause->effect == effect && found.confidence >= sure;
}

}  // namespace

std::span<const Cause> causes() { return all_causes; }

const Cause* find_cause(std::string_view code) {
  const auto row =
      std::ranges::find(all_causes, code, [](const Cause& cause) { return cause.code.name(); });
  return row == all_causes.end() ? nullptr : &*row;
}

bool brings_about(const Diagnosis& cause, const Diagnosis& implied) {
  return cause.code != implied.code &&
         std::ranges::any_of(implications(), [&](const Implication& rule) {
           return contains(rule.causes, cause.code) && contains(rule.implied, implied.code) &&
                  (rule.other_than.empty() || cause.unit != rule.other_than) &&
                  cause.confidence >= implied.confidence + rule.least_lead;
         });
}

bool is_other_system(const Diagnosis& found) { return surely_has(found, Effect::other_system); }

bool is_noise(const Diagnosis& found) { return surely_has(found, Effect::noise); }

bool denies_ladder(const Diagnosis& found) { return surely_has(found, Effect::no_ladder); }

}  // namespace clackers::diagnose
