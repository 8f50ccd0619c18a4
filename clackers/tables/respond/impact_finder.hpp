#pragma once

#include "clackers/model/motion.hpp"

namespace clackers::tables {

/// Answers whether a time is the double nearest to an impact. Remembers the two impacts around the
/// last time asked for, so that ascending times cost next to nothing.
class ImpactFinder {
 public:
  /// The motion must outlive the finder.
  explicit ImpactFinder(const model::Motion& motion);

  /// True where `t` [s], within [0, end of the motion], is the double nearest to an impact.
  bool is_impact(double t);

 private:
  double time_of(long long index) const;  // infinite outside 1 ... total_

  const model::Motion& motion_;
  long long total_;
  double before_, after_;  // neighbouring impacts, none between them
};

}  // namespace clackers::tables
