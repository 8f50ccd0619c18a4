#pragma once

#include <vector>

#include "clackers/diagnose/system/fit_files.hpp"
#include "clackers/diagnose/system/hypotheses.hpp"

namespace clackers::diagnose {

/// A cause must explain the rows this many times better than the next one.
inline constexpr double least_race_lead = 10.0;

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
