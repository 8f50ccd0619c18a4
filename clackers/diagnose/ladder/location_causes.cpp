#include <algorithm>
#include <cmath>
#include <optional>

#include "clackers/assess/errors/vectors.hpp"
#include "clackers/diagnose/ladder/impact_location.hpp"
#include "clackers/diagnose/ladder/ladder_families.hpp"
#include "clackers/numerics/line_fit.hpp"

namespace clackers::diagnose {
namespace {

// Impacts at mirrored positions of a motion have one delay, so equal ones count once.
std::vector<double> distinct(std::vector<double> values, double apart) {
  std::ranges::sort(values);
  std::vector<double> kept;
  for (const double value : values)
    if (kept.empty() || value - kept.back() > apart) kept.push_back(value);
  return kept;
}

// Slope of log y against log step; nothing for less than a factor 3 of the step.
template <class Measure>
std::optional<numerics::LineFit> power_of_step(const std::vector<LocatedImpacts>& files,
                                               const Measure& measure) {
  std::vector<double> x, y;
  for (const auto& file : files) {
    const double value = measure(file);
    if (!(value > 0.0)) continue;
    x.push_back(std::log(file.step));
    y.push_back(std::log(value));
  }
  if (x.size() < 3) return {};
  const auto [least, largest] = std::ranges::minmax(x);
  if (largest - least < std::log(3.0)) return {};
  return numerics::fit_line(x, y);
}

double rms_delay(const LocatedImpacts& file) { return file.rms_delay(); }

// Impacts applied at a step: delays between 0 and h, or -h and 0, spread over that range, in
// proportion to the step.
std::optional<Diagnosis> at_step(const std::vector<LocatedImpacts>& files) {
  std::vector<double> delays;  // in steps
  double sum = 0.0;
  for (const auto& file : files)
    for (const auto& impact : file.impacts) {
      delays.push_back(impact.delay / file.step);
      sum += delays.back();
    }
  const auto different = distinct(delays, 0.02);
  const double mean = sum / double(delays.size()), sign = mean > 0.0 ? 1.0 : -1.0;
  const auto outside =
      std::ranges::count_if(delays, [&](double x) { return sign * x < -0.05 || sign * x > 1.05; });
  if (20 * outside > std::ssize(delays) || !(std::abs(mean) > 0.1 && std::abs(mean) < 0.9))
    return {};
  const bool spread = different.size() >= 3 && different.back() - different.front() > 0.2;
  const auto power = power_of_step(files, rms_delay);
  // A uniform delay has a logarithm of standard deviation 1, the finest and coarsest file of a
  // range of 4 octaves then differ by less than an order of 0.5 in one case of 20.
  if (power && !(power->slope > 0.5 && power->slope < 1.6)) return {};
  if (!spread && files.size() > 1) return {};
  auto found = diagnosis_of(Code("impact-at-step-end"), mean, "steps");
  found.confidence = spread && power ? 0.95 : spread ? 0.8 : 0.6;
  found.evidence = {{"files", double(files.size())}, {"step", files.back().step}};
  if (power) found.evidence.insert(found.evidence.begin(), {"order", power->slope});
  found.text = mean > 0.0 ? "end" : "start";
  return found;
}

// Impacts that err by a lower power of the step than the flights between them.
std::optional<Diagnosis> interpolated(const std::vector<LocatedImpacts>& files) {
  // Below it the flight itself is followed no better.
  constexpr double resolved = 1e-7;
  const auto impacts = power_of_step(files, [](const LocatedImpacts& file) {
    return file.rms_defect() > 1e-8 ? file.rms_defect() : 0.0;
  });
  const auto flights = power_of_step(files, [](const LocatedImpacts& file) {
    return file.flight_defect > resolved ? file.flight_defect : 0.0;
  });
  if (!impacts || impacts->slope < 1.5 || impacts->slope > 3.5 || impacts->slope_spread > 0.5)
    return {};
  const bool exact_flights = std::ranges::all_of(
      files, [](const LocatedImpacts& file) { return file.flight_defect <= resolved; });
  if (!exact_flights && !(flights && flights->slope > impacts->slope + 0.7)) return {};
  auto found = diagnosis_of(Code("impact-interpolated"), impacts->slope, "1");
  found.confidence = 0.9;
  found.evidence = {{"order", impacts->slope},
                    {"uncertainty", impacts->slope_spread},
                    {"files", double(files.size())}};
  return found;
}

// Delays below a step that do not depend on it.
std::optional<Diagnosis> tolerance(const std::vector<LocatedImpacts>& files) {
  const auto power = power_of_step(files, rms_delay);
  if (!power || std::abs(power->slope) > 0.35) return {};
  std::vector<double> sizes;
  double largest = 0.0;
  for (const auto& file : files) {
    sizes.push_back(file.rms_delay());
    for (const auto& impact : file.impacts) largest = std::max(largest, std::abs(impact.delay));
  }
  const auto [least, most] = std::ranges::minmax(sizes);
  if (most > 10.0 * least || largest > 0.5 * files.back().step) return {};
  auto found = diagnosis_of(Code("impact-tolerance"), largest, "s");
  found.confidence = files.size() >= 5 ? 0.9 : 0.75;
  found.evidence = {{"steps", largest / files.back().step}, {"files", double(files.size())}};
  return found;
}

// Contacts of one duration in all files that hold several rows of it.
std::optional<Diagnosis> compliant(const Question& question,
                                   const std::vector<LocatedImpacts>& files) {
  std::vector<double> durations;
  double speed = 0.0;
  int resolving = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::vector<double> one;
    for (const auto& impact : files[i].impacts) {
      one.push_back(impact.duration);
      speed = std::max(speed, impact.closing);
    }
    if (one.empty() || assess::median(one) < 3.0 * question.histories[i].facts.spacing) continue;
    ++resolving;
    durations.push_back(assess::median(one));
  }
  if (resolving == 0) return {};
  const double duration = durations.back();
  const auto alike = std::ranges::count_if(
      durations, [&](double x) { return std::abs(x / duration - 1.0) < 0.2; });
  if (2 * alike < std::ssize(durations)) return {};
  const auto& contact = question.problem.contacts.front();
  const Eigen::VectorXd push = question.problem.system.mass.llt().solve(contact.direction);
  const double mass = 1.0 / contact.direction.dot(push), w = std::numbers::pi / duration;
  auto found = diagnosis_of(Code("contact-compliant"), duration, "s");
  found.confidence = resolving >= 2 ? 0.9 : 0.75;
  found.evidence = {
      {"penetration", speed / w}, {"stiffness", mass * w * w}, {"files", double(resolving)}};
  return found;
}

}  // namespace

std::vector<Diagnosis> location_causes(const Question& question) {
  std::vector<LocatedImpacts> all, delayed;
  for (const auto& seen : question.histories) {
    all.push_back(locate_impacts(seen, question.problem));
    if (all.back().is_resolved() && all.back().step > 0.0) delayed.push_back(all.back());
  }
  std::vector<Diagnosis> found;
  const auto add = [&](std::optional<Diagnosis> one) {
    if (one) found.push_back(std::move(*one));
    return !found.empty();
  };
  if (std::ranges::all_of(all, [](const auto& file) { return file.impacts.empty(); })) return {};
  if (add(compliant(question, all))) return found;
  // Delays of a tolerance ladder have no step to be measured in.
  if (!question.by_tolerance && !delayed.empty() && 2 * delayed.size() >= all.size()) {
    if (add(at_step(delayed))) return found;
    if (add(tolerance(delayed))) return found;
  }
  std::erase_if(all, [](const auto& file) { return file.impacts.empty(); });
  if (!question.by_tolerance) add(interpolated(all));
  return found;
}

}  // namespace clackers::diagnose
