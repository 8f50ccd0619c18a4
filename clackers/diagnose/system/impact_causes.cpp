#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "clackers/diagnose/ladder/impact_location.hpp"
#include "clackers/diagnose/system/measured_causes.hpp"
#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/numerics/line_fit.hpp"

namespace clackers::diagnose {
namespace {

constexpr double most_other_step = 4.2;
/// A restitution whose error is larger says nothing.
constexpr double precise = 0.02;

using ImpactFiles = std::vector<LocatedImpacts>;
using Impacts = std::vector<LocatedImpact>;

// The impacts of one contact whose restitution is known, faster than a speed.
Impacts bounces_of(const LocatedImpacts& file, int contact, double slowest) {
  Impacts all;
  for (const auto& impact : file.impacts)
    if (impact.contact == contact && impact.restitution_error < precise && impact.closing > slowest)
      all.push_back(impact);
  return all;
}

// Of some impacts: the median of a measure of the third whose restitution is known best, and half the
// width of what holds 2/3 of all, but for their own errors.
struct Measured {
  double value = 0.0, spread = 0.0, error = 0.0;
  std::size_t count = 0;
};

Measured measured(Impacts impacts, const auto& measure_of) {
  constexpr std::size_t least_precise = 4;
  std::vector<double> values, errors, apart;
  std::ranges::sort(impacts, {}, &LocatedImpact::restitution_error);
  Measured found;
  found.count = impacts.size();
  if (impacts.empty()) return found;
  const auto precise_ones = std::min(std::max(least_precise, found.count / 3), found.count);
  for (const auto& impact : std::span(impacts).first(precise_ones)) {
    values.push_back(measure_of(impact));
    errors.push_back(impact.restitution_error);
  }
  found.value = measure::median(values);
  found.error = measure::median(errors);
  for (const auto& impact : impacts)
    apart.push_back(
        std::max(0.0, std::abs(measure_of(impact) - found.value) - impact.restitution_error));
  found.spread = measure::median(std::move(apart));
  return found;
}

// Half way from the fastest impact without a bounce to the slowest one with it, and half their distance.
struct Threshold {
  double speed = 0.0, uncertainty = 0.0;
  int files = 0;
};

std::optional<Threshold> threshold_of(const ImpactFiles& files, int contact) {
  constexpr double least_speed = 0.01, bounces = 0.1;
  double fastest = 0.0, stuck = 0.0, bounced = INFINITY;
  for (const auto& file : files)
    for (const auto& impact : bounces_of(file, contact, 0.0))
      fastest = std::max(fastest, impact.closing);
  Threshold found;
  for (const auto& file : files) {
    double here = 0.0;
    for (const auto& impact : file.sticking)
      if (impact.contact == contact) here = std::max(here, impact.closing);
    const auto above = bounces_of(file, contact, least_speed * fastest);
    bool has_bounce = false;
    for (const auto& impact : above)
      if (impact.restitution > bounces) {
        has_bounce = true;
        bounced = std::min(bounced, impact.closing);
      }
    if (!has_bounce || here < least_speed * fastest) continue;
    stuck = std::max(stuck, here);
    ++found.files;
  }
  if (found.files < 2 || !(stuck < bounced)) return {};
  found.speed = 0.5 * (stuck + bounced);
  found.uncertainty = 0.5 * (bounced - stuck);
  return found;
}

// How restitution grows with the time that an impact comes late, in steps, as with the penetration that
// is pushed out; nothing where no line through the impacts of all files shows it, or that falls with
// the step.
std::optional<double> gain_by_delay(const ImpactFiles& files, int contact, double slowest) {
  constexpr std::size_t least_impacts = 4;
  constexpr double least_range = 0.3, least_slope = 0.02, most_rest = 0.2, same_slope = 0.25;
  constexpr double most_error = 0.005;
  const auto slope_of = [&](std::size_t first) -> std::optional<double> {
    std::vector<double> x, y;
    for (auto i = first; i < files.size(); ++i)
      for (const auto& impact : bounces_of(files[i], contact, slowest)) {
        if (impact.restitution_error > most_error) continue;
        x.push_back(impact.delay_steps);
        y.push_back(impact.restitution);
      }
    if (x.size() < least_impacts) return {};
    const auto [least, most] = std::ranges::minmax(x);
    if (most - least < least_range) return {};
    const auto line = numerics::fit_line(x, y);
    const double rest = std::max(line.largest_above, line.largest_below);
    if (line.slope < least_slope || rest > most_rest * line.slope * (most - least)) return {};
    return line.slope;
  };
  const auto all = slope_of(0), fine = slope_of(files.size() / 2);
  if (!all || !fine || std::abs(*fine - *all) > same_slope * *all) return {};
  return fine;
}

// How restitution changes with the closing speed [s/m]; nothing where a line does not show it.
std::optional<double> slope_over_speed(const Impacts& impacts) {
  constexpr std::size_t enough = 4;
  constexpr double least_range = 0.01, largest_rest = 0.2, times_as_fast = 1.2;
  std::vector<double> speeds, values;
  for (const auto& impact : impacts) {
    speeds.push_back(impact.closing);
    values.push_back(impact.restitution);
  }
  if (speeds.size() < enough) return {};
  const auto [slowest, fastest] = std::ranges::minmax(speeds);
  const auto [least, most] = std::ranges::minmax(values);
  if (most - least < least_range || fastest < times_as_fast * slowest) return {};
  const auto line = numerics::fit_line(speeds, values);
  const double rest = std::max(line.largest_above, line.largest_below);
  if (rest > largest_rest * (most - least)) return {};
  return line.slope;
}

// The largest distance between restitutions of one history, where those of another are others; 0 for
// none. An impact that is wrong in all of them is wrong, but does not scatter.
double scatter_of(const ImpactFiles& files, int contact, double slowest) {
  constexpr std::size_t enough = 3;
  constexpr double noticeable = 0.02, above_error = 10.0;
  double largest = 0.0, least_of_all = INFINITY, most_of_least = 0.0;
  int scattering = 0;
  for (const auto& file : files) {
    const auto impacts = bounces_of(file, contact, slowest);
    if (impacts.size() < enough) continue;
    double least = INFINITY, most = 0.0, error = 0.0;
    for (const auto& impact : impacts) {
      least = std::min(least, impact.restitution);
      most = std::max(most, impact.restitution);
      error = std::max(error, impact.restitution_error);
    }
    least_of_all = std::min(least_of_all, least);
    most_of_least = std::max(most_of_least, least);
    if (most - least < std::max(noticeable, above_error * error)) continue;
    largest = std::max(largest, most - least);
    ++scattering;
  }
  return scattering >= 2 && most_of_least - least_of_all > noticeable ? largest : 0.0;
}

}  // namespace

std::vector<Diagnosis> impact_causes(const DiagnosisInput& question) {
  const auto& problem = question.problem;
  const bool elsewhere = is_elsewhere(question);
  const bool falls = question.displacement.has_line && !elsewhere;
  if (problem.contacts.empty()) return {};
  // Contacts that close together are struck as one or in turn.
  const bool may_be_in_turn = problem.contacts.size() > 1 && !elsewhere;
  const bool is_alone = question.histories.size() == 1;
  // Of one history the method's own error is not known; one of first order makes 0.24 w h with a damping
  // ratio of a quarter.
  const double least_alone =
      is_alone ? std::max(precise, 0.5 * measure::highest_frequency(problem.system) *
                                       question.histories.front().facts.step)
               : 0.0;
  ImpactFiles files;
  for (const auto& seen : question.histories)
    files.push_back(locate_impacts(seen, problem, question.by_tolerance));
  const double finest = files.back().step;
  // The other history, and those near it; of tolerances the next one is ten times as large.
  double most_other = most_other_step * finest;
  const auto other = std::ranges::find_if(files.rbegin(), files.rend(), [&](const auto& file) {
    return file.step >= least_other_step * finest;
  });
  if (other != files.rend()) most_other = std::max(most_other, other->step);
  std::vector<Diagnosis> found;
  for (int contact = 0; contact < std::ssize(problem.contacts); ++contact) {
    const auto add = [&](Code code, double value, std::string unit = "1") -> Diagnosis& {
      found.push_back(diagnosis_of(code, value, std::move(unit)));
      found.back().confidence = 0.95;
      if (problem.contacts.size() > 1) found.back().evidence.push_back({"contact", contact + 1.0});
      return found.back();
    };
    const auto threshold = may_be_in_turn ? std::nullopt : threshold_of(files, contact);
    const double slowest = threshold ? threshold->speed : 0.0;
    if (threshold)
      add(Code("restitution-threshold"), threshold->speed, "m/s").evidence = {
          {"uncertainty", threshold->uncertainty}, {"files", double(threshold->files)}};
    const auto gained = question.by_tolerance || is_alone || may_be_in_turn
                            ? std::nullopt
                            : gain_by_delay(files, contact, slowest);
    if (gained)
      add(Code("energy-gained-at-impacts"), *gained)
          .evidence.push_back({"files", double(files.size())});
    Impacts fine, coarse;
    for (const auto& file : files) {
      if (file.step > most_other) continue;
      const auto impacts = bounces_of(file, contact, slowest);
      auto& to = file.step < least_other_step * finest ? fine : coarse;
      to.insert(to.end(), impacts.begin(), impacts.end());
    }
    const double eta = problem.contacts[std::size_t(contact)].restitution;
    const auto in_time = [&](const LocatedImpact& impact) {
      return impact.restitution - gained.value_or(0.0) * impact.delay_steps;
    };
    const auto defect = [](const LocatedImpact& impact) { return impact.momentum_defect; };
    const auto now = measured(fine, in_time), again = is_alone ? now : measured(coarse, in_time);
    if (now.count < 2 || again.count < 2 || (may_be_in_turn && is_alone)) continue;
    constexpr double above_error = 10.0, far_above_error = 100.0;
    constexpr double noticeable = 1e-4, noticeable_beside = 1e-3;
    const double off = now.value - eta, off_again = again.value - eta;
    if (std::abs(off) > std::max({elsewhere ? noticeable : noticeable_beside,
                                  (may_be_in_turn ? far_above_error : above_error) *
                                      std::max(now.error, may_be_in_turn ? again.error : 0.0),
                                  gained ? precise : least_alone}) &&
        now.spread < same_share * std::abs(off) &&
        std::abs(off_again - off) < same_share * std::abs(off)) {
      auto& cause = add(Code("restitution-differs"), now.value);
      cause.evidence.push_back({"expected", eta});
      cause.evidence.push_back({"uncertainty", std::abs(off - off_again) + now.error + now.spread});
      cause.evidence.push_back({"files", double(files.size())});
    } else if (const auto slope = slope_over_speed(fine);
               elsewhere && slope && slope_over_speed(coarse)) {
      add(Code("restitution-varies"), *slope, "s/m").evidence.push_back({"files", 2.0});
    } else if (const double scatter = scatter_of(files, contact, slowest);
               problem.contacts.size() == 1 && !gained && !falls && scatter > 0.0) {
      add(Code("restitution-scatters"), scatter)
          .evidence.push_back({"files", double(files.size())});
    }
    const auto momentum = measured(fine, defect), repeated = measured(coarse, defect);
    if (elsewhere && momentum.value > std::max(noticeable, above_error * momentum.error) &&
        std::abs(repeated.value - momentum.value) < same_share * momentum.value)
      add(Code("momentum-not-kept"), momentum.value).evidence.push_back({"files", 2.0});
  }
  std::stable_partition(found.begin(), found.end(), [](const Diagnosis& each) {
    return each.code == Code("restitution-differs").name();
  });
  return found;
}

}  // namespace clackers::diagnose
