#include "clackers/tables/respond/timed_rows.hpp"

#include <limits>

namespace clackers::tables {

ImpactFinder::ImpactFinder(const model::Motion& motion)
    : motion_(motion),
      total_(motion.impact_count(motion.end())),
      before_(-std::numeric_limits<double>::infinity()),
      after_(time_of(1)) {}

double ImpactFinder::time_of(long long index) const {
  if (index < 1) return -std::numeric_limits<double>::infinity();
  if (index > total_) return std::numeric_limits<double>::infinity();
  return motion_.impact(index).t;
}

bool ImpactFinder::is_impact(double t) {
  if (before_ < t && t < after_) return false;
  // The nearest double may lie on either side of the true instant, so that the count at t may or
  // may not hold an impact rounded to t: both neighbours are looked at.
  const auto count = motion_.impact_count(t);
  before_ = time_of(count);
  after_ = time_of(count + 1);
  return t == before_ || t == after_;
}

}  // namespace clackers::tables
