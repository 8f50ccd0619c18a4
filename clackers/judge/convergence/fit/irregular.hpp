#pragma once

#include <optional>
#include <span>

#include "clackers/judge/convergence/fit/error_ladder.hpp"
#include "clackers/numerics/line_fit.hpp"

namespace clackers::judge {

/// A bend of raw points by less than this factor is no zigzag: points within 1.05 of a line, as
/// methods that locate impacts leave them, bend by at most 1.05^2.
inline constexpr double zigzag_bend = 1.1;
/// Rough points zigzag at more than this share of their places. Independent scatter does so at
/// about 0.6; a smooth curve nowhere.
inline constexpr double zigzag_share = 0.25;
/// And at this many places at least; a curve that passes through zero does so at two. Swings about
/// a line are counted alike.
inline constexpr int least_turns = 4;
/// Fewer raw points than this may lie in any way by chance.
inline constexpr int enough_points = 10;
/// A leading level further than this factor from the line of medians is no part of an envelope:
/// four standard deviations of what the largest of eight errors within a factor 30 scatters.
inline constexpr double leading_level = 4.0;

/// Whether the raw points of the finest levels (four of them, or more until `enough_points` are
/// there) zigzag: the bend at a point and the bend at the next have opposite signs and both exceed
/// `zigzag_bend`, at more than `zigzag_share` of the places and at `least_turns` at least.
bool zigzags(std::span<const LevelView> levels, int first, int last);

/// Whether the raw points of these levels swing about their common line: `least_turns` times from
/// more than a factor 1.22 (the root of `straight_scatter`) on one side to as much on the other. A
/// bend or one passage through zero lies on three sides of its line and turns twice; stairs and
/// errors that oscillate with the logarithm of the step turn with every level. Never for fewer than
/// `enough_points`.
bool swings(std::span<const LevelView> levels, int first, int last);

/// The line through the largest errors of the levels, ln against ln.
struct Envelope {
  int first = 0, last = 0;
  numerics::LineFit line;
  double order = 0.0, spread = 0.0;  ///< of the envelope, with half its 95 % interval
  double scatter = 1.0;              ///< largest factor between a raw error and this line
};

/// Fits the envelope over [first, last], without those coarsest levels that lie more than a factor
/// `leading_level` off the line of medians; at least four levels stay. Where a blend of two adjacent
/// whole orders follows it better than a line, the order is the lower one, which is left as the step
/// goes to zero, and the spread reaches to the slope. Nothing for fewer than four levels.
std::optional<Envelope> envelope(std::span<const LevelView> levels, int first, int last);

}  // namespace clackers::judge
