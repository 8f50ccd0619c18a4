#include "clackers/study/check/check_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "clackers/base/error.hpp"

namespace clackers::study {
namespace {

// One number of a state beside the true one.
struct Difference {
  std::string name;
  double given = 0.0, expected = 0.0, envelope = 1.0;
  double relative() const { return std::abs(given - expected) / envelope; }
};

void add(std::vector<Difference>& all, const char* letter, const std::vector<double>& given,
         const Eigen::VectorXd& expected, const Eigen::VectorXd& envelope) {
  for (std::size_t j = 0; j < given.size(); ++j)
    if (!std::isnan(given[j]))
      all.push_back({fmt::format("{}{}", letter, j + 1), given[j], expected[Eigen::Index(j)],
                     envelope[Eigen::Index(j)]});
}

std::vector<Difference> differences(const FirstRow& row, const cases::Case& which) {
  const auto& motion = *which.motion;
  const auto reference = motion.at(std::clamp(row.t, 0.0, motion.end()), model::Side::right);
  const auto envelope = motion.envelope(0.0);
  std::vector<Difference> all;
  add(all, "u", row.u, reference.u, envelope.u);
  add(all, "v", row.v, reference.v, envelope.v);
  return all;
}

Difference worst(const std::vector<Difference>& all) {
  return *std::ranges::max_element(all, {}, &Difference::relative);
}

// The case with one parameter changed, or nothing where it does not exist.
std::optional<cases::Case> with(const cases::Case& which, std::size_t parameter, double value) {
  auto values = which.values;
  values[parameter].second = value;
  try {
    return cases::make(which.entry->name, values);
  } catch (const InputError&) {
    return {};
  }
}

// Values worth a try: whole numbers, one over odd ones, and a geometric progression.
std::vector<double> candidates(double present) {
  std::vector<double> values;
  for (int n = 0; n <= 20; ++n) values.push_back(n);
  for (int n = 3; n <= 15; n += 2) values.push_back(1.0 / n);
  const double size = present == 0.0 ? 1.0 : std::abs(present);
  for (int k = -8; k <= 8; ++k) values.push_back(size * std::exp2(k));
  return values;
}

class NearestParameter {
 public:
  NearestParameter(const FirstRow& row, const cases::Case& which) : row_(row), which_(which) {}

  /// The value of a parameter that brings the state nearest, with six digits.
  double value(std::size_t parameter) {
    double best = which_.values[parameter].second, reach = best == 0.0 ? 0.5 : 0.5 * std::abs(best);
    double least = error(parameter, best);
    const auto attempt = [&](double candidate) {
      const double there = error(parameter, candidate);
      if (!(there < least)) return false;
      least = there;
      best = candidate;
      return true;
    };
    for (const double candidate : candidates(best))
      if (attempt(candidate)) reach = 0.5 * std::abs(candidate);
    // To seven digits, one more than are told. The candidates are a factor of two apart, so a few
    // moves of each reach suffice; where more would help, the error falls towards infinity.
    for (int halvings = 0; halvings < 24 && least > 0.0; ++halvings, reach *= 0.5)
      for (int moves = 0; moves < 4 && (attempt(best + reach) || attempt(best - reach));) ++moves;
    const double rounded = std::stod(fmt::format("{:.6g}", best));
    return error(parameter, rounded) <= start_tolerance ? rounded : best;
  }

  double error(std::size_t parameter, double value) const {
    const auto changed = with(which_, parameter, value);
    return changed ? start_error(row_, *changed) : INFINITY;
  }

 private:
  const FirstRow& row_;
  const cases::Case& which_;
};

// Whether the parameter moves any number of the initial state.
bool sets(const cases::Case& which, std::size_t parameter, const FirstRow& row,
          const std::string& name) {
  const double present = which.values[parameter].second;
  for (const double value : {present * 1.01, present + 1.0, present + 2.0, present - 2.0,
                             present - 0.01, present + 0.01}) {
    const auto changed = with(which, parameter, value);
    if (!changed) continue;
    const auto before = differences(row, which), after = differences(row, *changed);
    for (std::size_t i = 0; i < before.size(); ++i)
      if (before[i].name == name && before[i].expected != after[i].expected) return true;
  }
  return false;
}

}  // namespace

double start_error(const FirstRow& row, const cases::Case& which) {
  const auto all = differences(row, which);
  return all.empty() ? 0.0 : worst(all).relative();
}

std::string other_start(const FirstRow& row, const cases::Case& which) {
  const auto most = worst(differences(row, which));
  auto text = fmt::format("{} starts at {:.6g}, and that of {} at {:.6g}.", most.name, most.given,
                          which.entry->name, most.expected);
  std::string setters, name;
  double value = 0.0, least_change = INFINITY;
  NearestParameter nearest(row, which);
  for (std::size_t p = 0; p < which.values.size(); ++p) {
    if (!sets(which, p, row, most.name)) continue;
    const auto& [parameter, present] = which.values[p];
    setters += (setters.empty() ? "" : ", ") + parameter;
    const double other = nearest.value(p);
    if (!(nearest.error(p, other) <= start_tolerance)) continue;
    // Of several ways the one that changes its parameter by the smallest factor; of equal factors,
    // which differ by the search's rounding, the first.
    const double change =
        present == 0.0 || other == 0.0 ? 1e9 : std::abs(std::log(std::abs(other / present)));
    if (change >= least_change * (1.0 - 1e-5)) continue;
    least_change = change;
    name = parameter;
    value = other;
  }
  if (!name.empty())
    return text +
           fmt::format(" With --set {}={:.6g} the case starts as the history does.", name, value);
  if (setters.empty()) return text + " No parameter of the case sets it; see: clackers list cases.";
  return text + fmt::format(
                    " It is set by {}, none of which alone gives this state; see: clackers "
                    "show {}.",
                    setters, which.entry->name);
}

}  // namespace clackers::study
