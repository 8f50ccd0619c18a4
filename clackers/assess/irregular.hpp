#pragma once

#include <optional>
#include <span>

#include "clackers/assess/error_ladder.hpp"
#include "clackers/numerics/line_fit.hpp"

namespace clackers::assess {

/// Whether the raw points of the finest levels (four of them, or more until ten points are there)
/// zigzag: the bend at a point and the bend at the next have opposite signs and both exceed a
/// factor 1.1, at more than 0.4 of the places and at four of them at least. Independent scatter
/// does so at about 0.6; a smooth curve nowhere, and a curve that passes through zero at two.
bool zigzags(std::span<const LevelView> levels, int first, int last);

/// The line through the largest errors of the levels, ln against ln.
struct Envelope {
  int first = 0, last = 0;
  numerics::LineFit line;
  double scatter = 1.0;  ///< largest factor between a raw error and this line
};

/// Fits the envelope over [first, last], without those coarsest levels that lie more than a factor
/// 4 off the line of medians (four standard deviations of what the largest of eight errors within a
/// factor 30 scatters); at least four levels stay. Nothing for fewer than four.
std::optional<Envelope> envelope(std::span<const LevelView> levels, int first, int last);

}  // namespace clackers::assess
