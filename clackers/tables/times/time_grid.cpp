#include "clackers/tables/times/time_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"

namespace clackers::tables {
namespace {

constexpr long long most_rows = 1'000'000'000;

void require_few(std::string_view name, double given, double count) {
  if (!(count <= double(most_rows)))
    refuse("respond", name, given, "at most 1e9 rows",
           "Ask for fewer samples or a larger step; times of interest can be given one by one.",
           "too-many-rows");
}

}  // namespace

double TimeGrid::at(long long k) const {
  if (!times.empty()) return times[static_cast<std::size_t>(k)];
  if (last > 0.0 && k == count - 1) return last;
  return double(k) * step;
}

long long TimeGrid::size() const {
  return times.empty() ? count : static_cast<long long>(times.size());
}

double TimeGrid::latest() const {
  if (times.empty()) return count > 0 ? at(count - 1) : 0.0;
  return *std::ranges::max_element(times);
}

TimeGrid grid_of(long long n, double end) {
  require_positive("respond", "end", end);
  if (n < 2)
    refuse("respond", "samples", fmt::format("{}", n), "a whole number, 2 <= samples <= 1e9",
           "Both ends of the run are among them.");
  require_few("samples", double(n), double(n));
  return {end / double(n - 1), n, end, {}};
}

TimeGrid grid_every(double step, double end) {
  require_positive("respond", "end", end);
  if (!(step > 0.0 && step <= end))
    refuse("respond", "step", step, fmt::format("0 < step <= {} s, the end of the run", end), {},
           step > 0.0 ? Code("out-of-range") : Code("step-not-positive"));
  require_few("step", step, end / step);
  // end / step carries at most half a unit of rounding, and the end as typed another: a whole
  // number within two units of the quotient is meant to reach the end.
  const double quotient = end / step, whole = std::round(quotient);
  const double slack = 2.0 * std::numeric_limits<double>::epsilon() * quotient;
  const bool reaches_end = std::abs(quotient - whole) <= slack;
  const auto count = static_cast<long long>(reaches_end ? whole : std::floor(quotient)) + 1;
  return {step, count, reaches_end ? end : 0.0, {}};
}

}  // namespace clackers::tables
