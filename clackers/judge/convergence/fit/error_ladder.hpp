#pragma once

#include <span>
#include <vector>

namespace clackers::judge {

/// One measured error of a run with step h.
struct ErrorPoint {
  double step = 0.0;   ///< h > 0
  double error = 0.0;  ///< >= 0; NaN or infinite for a run that failed
  double floor = 0.0;  ///< what rounding alone may make of it, 0 when not known
};

/// The errors of neighbouring steps around one nominal step.
using ErrorLevel = std::vector<ErrorPoint>;

/// Errors within this factor of their rounding floor count as rounding: the estimate (steps times
/// 2^-52) leaves out how a motion magnifies a rounding error.
inline constexpr double rounding_slack = 10.0;

/// Rounding at its worst, `rounding_slack` floors, bends a line by less than a tenth only where
/// errors are this many floors. Between the two, levels that leave a line may do so by rounding.
inline constexpr double bending_slack = rounding_slack * rounding_slack;

/// A level as the fit sees it, in logarithmic axes.
struct LevelView {
  /// ln step descending, ln error; failed runs, zero errors and coincident
  /// errors left out.
  std::vector<double> x, y;
  double step = 0.0;        ///< of the largest error; of the first point when there is none
  double error = 0.0;       ///< the upper envelope: the largest error, NaN when not usable
  int coincident = 0;       ///< runs at the rounding floor by coincidence, see view()
  bool usable = false;      ///< at least half of its runs came to an end with a finite error
  bool at_floor = false;    ///< usable, and no error above rounding_slack times its floor
  bool near_floor = false;  ///< usable, and at least a quarter of the other errors is not above it
  bool may_bend = false;    ///< the same with bending_slack
};

/// Throws InputError unless every step is positive and finite, every error >= 0 or not finite,
/// every floor >= 0, and every step of a level is smaller than all steps of the levels before it. A
/// ladder given finest first is not reversed: its errors may belong to other steps. A step may
/// stand twice in one level.
///
/// A run lies at the floor by coincidence where a run with a smaller step has an error above `bending_slack`
/// times its floor, since rounding grows as steps get smaller but not by as much; and where others of
/// its level do while a level before it has such runs. So does a step that divides the
/// time between impacts, which no neighbouring step does.
std::vector<LevelView> view(std::span<const ErrorLevel> ladder);

/// Raw points of the levels [first, last], coarse to fine.
struct RawPoints {
  std::vector<double> x, y;
};
RawPoints raw_points(std::span<const LevelView> levels, int first, int last);

}  // namespace clackers::judge
