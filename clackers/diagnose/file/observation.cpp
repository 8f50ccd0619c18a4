#include "clackers/diagnose/observation.hpp"

#include <algorithm>
#include <cmath>

namespace clackers::diagnose {
namespace {

// No limit of a jump, or one of the two ends.
bool is_plain(const measure::Comparison& comparison, std::size_t row) {
  return row == 0 || row + 1 == comparison.rows() ||
         (!comparison.is_left_limit(row) && !comparison.is_right_limit(row));
}

std::vector<std::size_t> spread(std::size_t count, std::size_t most) {
  std::vector<std::size_t> chosen(std::min(count, most));
  const double stride = chosen.size() < 2 ? 0.0 : double(count - 1) / double(chosen.size() - 1);
  for (std::size_t i = 0; i < chosen.size(); ++i)
    chosen[i] = std::size_t(std::llround(double(i) * stride));
  return chosen;
}

void append(model::Trajectory& to, const model::Trajectory& from, std::size_t row) {
  const auto dof = std::ptrdiff_t(from.dof);
  to.t.push_back(from.t[row]);
  for (const auto part : {&model::Trajectory::u, &model::Trajectory::v, &model::Trajectory::a}) {
    if ((from.*part).empty()) continue;
    const auto at = (from.*part).begin() + std::ptrdiff_t(row) * dof;
    (to.*part).insert((to.*part).end(), at, at + dof);
  }
}

// The places of rows on a grid.
class Grid {
 public:
  Grid(double first, double spacing) : from_(first), spacing_(spacing) {}

  // The place of the next row, -1 between two places.
  long long place(double t) {
    // A time that is rounded to a quarter of the spacing still has its place.
    constexpr double tolerance = 0.25;
    const double parts = (t - from_) / spacing_;
    const double whole = std::round(parts);
    if (!(whole >= 1.0 && std::abs(parts - whole) < tolerance)) return -1;
    place_ += std::llround(whole);
    from_ = t;
    ++rows_;
    return place_;
  }
  long long rows() const { return rows_; }  // that have a place, the first among them

 private:
  double from_, spacing_;
  long long place_ = 0, rows_ = 1;
};

class Mismatch {
 public:
  explicit Mismatch(const measure::Comparison& comparison)
      : comparison_(comparison), history_(comparison.history()), h_(comparison.step()) {}

  // Largest |v - du/dt| over the envelope at this row; NaN where it cannot be told.
  double at(std::size_t row) const {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    if (row < 2 || row + 2 >= history_.t.size()) return unknown;
    const auto* t = &history_.t[row];
    for (int i = -2; i < 2; ++i)
      if (!(std::abs(t[i + 1] - t[i] - h_) < 1e-3 * h_)) return unknown;
    if (has_impact(t[-2], t[2])) return unknown;
    const auto dof = comparison_.dof();
    double largest = 0.0;
    for (std::size_t mass = 0; mass < dof; ++mass) {
      const auto u = [&](int offset) {
        return history_.u[std::size_t(std::ptrdiff_t(row) + offset) * dof + mass];
      };
      const double rate = (8.0 * (u(1) - u(-1)) - (u(2) - u(-2))) / (12.0 * h_);
      const double off = std::abs(history_.v[row * dof + mass] - rate);
      largest = std::max(largest, off / comparison_.v_envelope()[mass]);
    }
    return largest;
  }

 private:
  bool has_impact(double from, double to) const {
    const auto& reference = comparison_.reference();
    const double end = reference.end();
    if (reference.impact_count(std::min(to, end)) > reference.impact_count(std::min(from, end)))
      return true;
    const auto& impacts = comparison_.impacts();
    const auto next = std::ranges::lower_bound(impacts, from - h_, {}, &model::Impact::t);
    return next != impacts.end() && next->t <= to + h_;
  }

  const measure::Comparison& comparison_;
  const model::Trajectory& history_;
  double h_;
};

}  // namespace

Observation observe(const measure::Comparison& comparison, const FileFacts& facts) {
  const auto& history = comparison.history();
  Observation seen;
  seen.facts = facts;
  seen.rows = (long long)(comparison.rows());
  seen.first = history.t.front();
  seen.last = history.t.back();
  seen.impacts_reported = comparison.impact_source() == measure::ImpactSource::reported;
  seen.sample.dof = seen.opening.dof = history.dof;
  for (std::size_t row = 0; row < std::min(comparison.rows(), most_opening_rows); ++row)
    append(seen.opening, history, row);

  std::size_t count = 0, number = 0;
  for (std::size_t row = 0; row < comparison.rows(); ++row) count += is_plain(comparison, row);
  const auto chosen = spread(count, most_sample_rows);
  auto next = chosen.begin();
  Grid grid(seen.first, comparison.step());
  const Mismatch mismatch(comparison);
  for (std::size_t row = 0; row < comparison.rows(); ++row) {
    if (!is_plain(comparison, row)) continue;
    const auto place = row == 0 ? 0 : grid.place(history.t[row]);
    const auto here = number++;
    if (next == chosen.end() || *next != here) continue;
    ++next;
    append(seen.sample, history, row);
    seen.sample_steps.push_back(place);
    if (comparison.has_velocities())
      seen.velocity_mismatch = std::fmax(seen.velocity_mismatch, mismatch.at(row));
  }
  constexpr double least_share = 0.9;
  if (double(grid.rows()) < least_share * double(count)) seen.sample_steps.clear();
  for (double& t : seen.sample.t) t = std::min(t, comparison.reference().end());
  const auto& impacts = comparison.impacts();
  const auto kept = std::min(impacts.size(), most_sample_impacts);
  seen.sample.impacts.emplace(impacts.begin(), impacts.begin() + std::ptrdiff_t(kept));
  return seen;
}

}  // namespace clackers::diagnose
