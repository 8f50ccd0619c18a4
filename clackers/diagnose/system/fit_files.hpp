#pragma once

#include <vector>

#include "clackers/diagnose/diagnose.hpp"
#include "clackers/diagnose/system/fit_rows.hpp"
#include "clackers/diagnose/system/least_squares.hpp"

namespace clackers::diagnose {

/// A history that changed systems are fitted to.
struct FitFile {
  double step = 0.0;  ///< [s], or a tolerance
  /// Of all rows that are kept, among them those of the first impacts: the least gap of the contact [m],
  /// and how far apart they are [s].
  double least_gap = 0.0, gap_spacing = 0.0;
  double late_start = 0.0;  ///< see late_start() [s]
  FitRows rows;
  SystemFit smooth{};  ///< of frequencies and damping; empty until fitted
};

/// What the fits share.
struct FitQuestion {
  const model::ImpactProblem<>& problem;
  const model::Motion& motion;
  bool by_tolerance = false;
  std::vector<FitFile> files;     ///< finest first, each step at least 1.8 times the one before
  std::vector<Parameter> smooth;  ///< see smooth_parameters(), and the ratio of masses
};

inline constexpr std::size_t most_fit_files = 4;

/// The finest histories of the question that say anything: none where masses are coupled, where the
/// finest is not farther from the reference than 30 times its floor, or farther away than the
/// motion is large.
FitQuestion fit_question(const DiagnosisInput& question);

}  // namespace clackers::diagnose
