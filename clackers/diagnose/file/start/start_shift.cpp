#include <algorithm>
#include <cmath>

#include "clackers/diagnose/file/start/start_readings.hpp"

namespace clackers::diagnose {
namespace {

// The numbers of the first row lie this many times nearer to the state at another time.
constexpr double least_shift_gain = 100.0;

Diagnosis shift_by(const FirstRow& row, double shift, double left) {
  Diagnosis cause;
  cause.code = "time-shifted";
  const double steps = row.step() > 0.0 ? shift / row.step() : 0.0;
  const bool whole = std::abs(steps) > 0.5 && std::abs(steps - std::round(steps)) < 1e-3;
  cause.value = whole ? std::round(steps) : shift;
  cause.unit = whole ? "steps" : "s";
  cause.confidence = 0.9;
  cause.evidence.push_back({"gain", row.distance() / std::max(left, 1e-16)});
  return cause;
}

// Times of the motion at which its state may be the first row: local minima of their distance on a
// grid of a twentieth of the fastest rate of change.
std::vector<double> candidates(const FirstRow& row) {
  constexpr double most = 200'000.0;
  const auto masses = row.masses();
  double rate = 0.0;
  for (std::size_t mass = 0; mass < masses && row.has_v(); ++mass)
    rate = std::max(rate, row.scale(masses + mass) / row.scale(mass));
  if (rate == 0.0) return {};
  const double end = row.motion().end();
  const double spacing = std::max(0.05 / rate, end / most);
  std::vector<double> times;
  for (double t = 0.0; t <= end; t += spacing) times.push_back(t);
  const auto rows = reference_rows(row.motion(), times);
  std::vector<double> distances;
  for (std::size_t i = 0; i < times.size(); ++i) {
    std::vector<double> state(rows.u.begin() + std::ptrdiff_t(i * masses),
                              rows.u.begin() + std::ptrdiff_t((i + 1) * masses));
    state.insert(state.end(), rows.v.begin() + std::ptrdiff_t(i * masses),
                 rows.v.begin() + std::ptrdiff_t((i + 1) * masses));
    distances.push_back(row.distance(row.given(), state));
  }
  std::vector<double> near;
  for (std::size_t i = 0; i < times.size(); ++i)
    if (distances[i] < 0.2 && (i == 0 || distances[i] <= distances[i - 1]) &&
        (i + 1 == times.size() || distances[i] <= distances[i + 1]))
      near.push_back(times[i]);
  return near;
}

// Gauss-Newton steps from t to the state nearest to the row.
double refine(const FirstRow& row, double t) {
  for (int step = 0; step < 8; ++step) {
    const auto now = row.motion().at(std::clamp(t, 0.0, row.motion().end()), model::Side::right);
    double slope = 0.0, square = 0.0;
    for (std::size_t q = 0; q < row.given().size(); ++q) {
      if (std::isnan(row.given()[q])) continue;
      const auto mass = Eigen::Index(q % row.masses());
      const double state = q < row.masses() ? now.u[mass] : now.v[mass];
      const double rate = (q < row.masses() ? now.v[mass] : now.a[mass]) / row.scale(q);
      slope += rate * (row.given()[q] - state) / row.scale(q);
      square += rate * rate;
    }
    if (square == 0.0) break;
    t = std::clamp(t + slope / square, 0.0, row.motion().end());
  }
  return t;
}

}  // namespace

std::optional<Diagnosis> start_as_shift(const FirstRow& row) {
  const auto left_at = [&](double t) { return row.distance(row.given(), row.state_at(t)); };
  const double start = row.time(), h = row.step();
  // Rows a whole number of steps late or early may carry the error of these steps.
  for (const double steps : {1.0, -1.0, 2.0, -2.0}) {
    const double t = start - steps * h;
    if (h == 0.0 || t < -1e-9 * h || t > row.motion().end()) continue;
    const double left = left_at(t);
    if (row.distance() > least_shift_gain * left && row.distance() > 3.0 * row.tolerance())
      return shift_by(row, steps * h, left);
  }
  if (start > 0.0 && left_at(0.0) <= row.tolerance()) return shift_by(row, start, left_at(0.0));
  std::optional<Diagnosis> best;
  double least = row.tolerance();
  for (const double near : candidates(row)) {
    const double t = refine(row, near), left = left_at(t);
    if (left >= least || row.distance() < least_shift_gain * left) continue;
    least = left;
    best = shift_by(row, start - t, left);
  }
  return best;
}

}  // namespace clackers::diagnose
