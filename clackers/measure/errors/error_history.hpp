#pragma once

#include <span>
#include <vector>

namespace clackers::measure {

/// Error against time, reduced to the largest in each of equal intervals: what a figure can show.
class ErrorHistory {
 public:
  /// `bins` intervals over [start, end] [s] for `dof` masses; 0 bins keep nothing.
  ErrorHistory(int bins, int dof, double start, double end);

  /// Takes the errors of all masses at time t [s]; times outside belong to the nearest interval.
  void take(double t, std::span<const double> errors) {
    if (bins_ > 0) put(t, errors);
  }

  /// Middles of the intervals in which the run had a time [s].
  std::vector<double> times() const;
  /// The largest error of one mass in each of them.
  std::vector<double> largest(int mass) const;

 private:
  void put(double t, std::span<const double> errors);

  int bins_, dof_;
  double start_, width_;
  std::vector<double> largest_;  ///< row-major (interval, mass)
  std::vector<bool> seen_;
};

}  // namespace clackers::measure
