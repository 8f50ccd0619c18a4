#pragma once

#include <vector>

#include "clackers/diagnose/system/fit_files.hpp"
#include "clackers/diagnose/system/hypotheses.hpp"

namespace clackers::diagnose {

/// A cause must explain the rows this many times better than the next one.
inline constexpr double least_race_lead = 10.0;

/// Errors of right methods look like other systems with gains of up to 22.
inline constexpr double least_system_gain = 30.0;
/// Below this, one file cannot tell another model from the error of a method.
inline constexpr double least_gain_alone = 100.0;
/// A coarser file must show the cause as well, if less clearly: the method's error grows.
inline constexpr double least_gain_beside = 3.0;
/// A value that a method's error makes moves by 40 % at least from one file to the next, whose step
/// is 1.8 times as large, where it falls with the power 0.6 or more.
inline constexpr double constant_change = 0.15;

/// How sure a gain makes: 0.75 at twice the least one, towards 1.
inline double confidence_of(double gain, double least) { return 1.0 - 0.5 * least / gain; }

/// A hypothesis fitted to one file.
struct Trial {
  const Hypothesis* hypothesis = nullptr;
  double d = 0.0, uncertainty = 0.0, gain = 0.0;
  SystemFit beside{};  ///< of frequencies and damping fitted with it; empty without
};

/// The hypothesis alone.
Trial tried(const FitFile& file, const Hypothesis& hypothesis, const FitQuestion& question);
/// The same, beside what the method's own error does to frequencies and damping.
Trial tried_beside(const FitFile& file, const Hypothesis& hypothesis, const FitQuestion& question);
/// The same of a solver that applies impacts at the ends of its steps, over that fault alone.
Trial tried_at_step_ends(const FitFile& file, const Hypothesis& hypothesis,
                         const FitQuestion& question);

using Try = Trial (*)(const FitFile&, const Hypothesis&, const FitQuestion&);

/// Of the finest file; impossible values, as a restitution below 0, have no gain.
std::vector<Trial> all_tried(Try attempt, const std::vector<Hypothesis>& hypotheses,
                             const FitQuestion& question);

struct Race {
  Trial best, second;  ///< the second explains what the best one does not
};

Race race(const std::vector<Trial>& trials, Eigen::Index dof);

}  // namespace clackers::diagnose
