#include "clackers/judge/convergence/fit/two_terms.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "clackers/numerics/golden_section.hpp"
#include "clackers/numerics/line_fit.hpp"

namespace clackers::judge {
namespace {

struct Point {
  double x = 0.0;      // ln h from the middle of the ladder
  double error = 0.0;  // signed: negative beyond a zero crossing
  double scale = 0.0;  // what deviations are measured by
};

constexpr double reach_of_scale = 0.75 * 0.6931471805599453;

std::vector<Point> points_of(std::span<const LevelView> levels, int first, int last,
                             double* centre) {
  std::vector<Point> points;
  for (int i = first; i <= last; ++i) {
    const auto& level = levels[std::size_t(i)];
    for (std::size_t j = 0; j < level.x.size(); ++j)
      points.push_back({level.x[j], std::exp(level.y[j]), std::exp(level.y[j])});
  }
  if (points.empty()) return points;
  *centre = 0.5 * (points.front().x + points.back().x);
  for (auto& point : points) point.x -= *centre;
  return points;
}

void scale_by_neighbours(std::vector<Point>& points) {
  for (auto& point : points)
    for (const auto& other : points)
      if (std::abs(other.x - point.x) <= reach_of_scale)
        point.scale = std::max(point.scale, std::abs(other.error));
}

// Errors from `place` on, in the order of falling steps, are those beyond the zero.
void turn_from(std::vector<Point>& points, std::size_t place) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double size = std::abs(points[i].error);
    points[i].error = i < place ? size : -size;
  }
}

struct Linear {
  double a = 0.0, b = 0.0, squares = std::numeric_limits<double>::infinity();
};

// The best a and b for given powers, in the scaled coordinates exp(x).
Linear solve(const std::vector<Point>& points, double p, double q) {
  double uu = 0.0, uw = 0.0, ww = 0.0, ur = 0.0, wr = 0.0;
  for (const auto& point : points) {
    const double u = std::exp(p * point.x) / point.scale, w = std::exp(q * point.x) / point.scale;
    const double r = point.error / point.scale;
    uu += u * u;
    uw += u * w;
    ww += w * w;
    ur += u * r;
    wr += w * r;
  }
  const double determinant = uu * ww - uw * uw;
  if (!(determinant > 0.0)) return {};
  Linear found{(ur * ww - wr * uw) / determinant, (wr * uu - ur * uw) / determinant, 0.0};
  for (const auto& point : points) {
    const double off =
        (found.a * std::exp(p * point.x) + found.b * std::exp(q * point.x) - point.error) /
        point.scale;
    found.squares += off * off;
  }
  return found;
}

// The power p with the least squares: a scan in ratios of 1.1 and a golden section about its best.
double best_power(const std::vector<Point>& points, double q) {
  const auto squares = [&](double p) { return solve(points, p, q).squares; };
  double best = lowest_free, least = std::numeric_limits<double>::infinity();
  const double from = std::max(lowest_free, q + 0.25);
  for (double p = from; p <= highest_free; p *= 1.1)
    if (const double here = squares(p); here < least) {
      least = here;
      best = p;
    }
  return numerics::golden_section(best / 1.1, best * 1.1, 30, squares).x;
}

// Standard errors of a, b and p at the optimum.
Eigen::Vector3d errors_of(const std::vector<Point>& points, const Linear& found, double p, double q,
                          bool free) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  for (const auto& point : points) {
    const double u = std::exp(p * point.x) / point.scale;
    const Eigen::Vector3d row(u, std::exp(q * point.x) / point.scale,
                              free ? found.a * u * point.x : 0.0);
    normal += row * row.transpose();
  }
  if (!free) normal(2, 2) = 1.0;
  const double freedom = double(points.size()) - (free ? 3.0 : 2.0);
  const Eigen::Matrix3d inverse = normal.inverse();
  return (inverse.diagonal() * (found.squares / freedom)).cwiseSqrt();
}

std::optional<TwoTerms> law(const std::vector<Point>& points, double centre, const Terms& terms) {
  const bool free = !(terms.p > 0.0);
  const double p = free ? best_power(points, terms.q) : terms.p;
  const auto found = solve(points, p, terms.q);
  if (!(found.a > 0.0) || (terms.cancels ? !(found.b < 0.0) : !(found.b > 0.0))) return {};
  TwoTerms fit{.p = p, .q = terms.q};
  const auto errors = errors_of(points, found, p, terms.q, free);
  fit.a = found.a * std::exp(-p * centre);
  fit.b = found.b * std::exp(-terms.q * centre);
  fit.b_error = errors[1] * std::exp(-terms.q * centre);
  fit.points = int(points.size());
  if (free) fit.p_spread = numerics::student_t95(fit.points - 3) * errors[2];
  fit.crossing = std::pow(std::abs(fit.b) / fit.a, 1.0 / (p - terms.q));
  fit.largest = std::exp(points.front().x + centre);
  fit.smallest = std::exp(points.back().x + centre);
  for (const auto& point : points) {
    const double model = found.a * std::exp(p * point.x) + found.b * std::exp(terms.q * point.x);
    const double off = std::abs(model - point.error) / point.scale;
    const double factor = terms.cancels || !(model > 0.0)
                              ? 1.0 + off
                              : std::exp(std::abs(std::log(model / point.error)));
    fit.scatter = std::max(fit.scatter, factor);
  }
  return fit;
}

}  // namespace

double TwoTerms::octaves_of_p() const { return std::log2(largest / std::max(crossing, smallest)); }
double TwoTerms::octaves_of_q() const { return std::log2(std::min(crossing, largest) / smallest); }
double TwoTerms::error_at(double step) const {
  return std::abs(a * std::pow(step, p) + b * std::pow(step, q));
}

std::optional<TwoTerms> fit_two_terms(std::span<const LevelView> levels, int first, int last,
                                      const Terms& terms) {
  double centre = 0.0;
  auto points = points_of(levels, first, last, &centre);
  if (std::ssize(points) < (terms.p > 0.0 ? 4 : 5)) return {};
  if (!terms.cancels) return law(points, centre, terms);
  scale_by_neighbours(points);
  const auto lowest =
      std::size_t(std::ranges::min_element(
                      points, {}, [](const Point& point) { return point.error / point.scale; }) -
                  points.begin());
  // Beyond a zero the errors rise again.
  constexpr double rises = 1.5;
  const bool dips =
      std::any_of(points.begin() + std::ptrdiff_t(lowest), points.end(),
                  [&](const Point& point) { return point.error > rises * points[lowest].error; });
  if (!dips) return {};
  std::optional<TwoTerms> best;
  for (const auto place : {lowest, lowest + 1}) {
    if (place == 0 || place >= points.size()) continue;
    turn_from(points, place);
    auto found = law(points, centre, terms);
    if (found && (!best || found->scatter < best->scatter)) best = found;
  }
  return best;
}

double order_above_floor(std::span<const LevelView> levels, int first, int last) {
  const auto law = fit_two_terms(levels, first, last, {});
  if (!law) return 0.0;
  const auto [x, y] = raw_points(levels, first, last);
  const auto line = numerics::fit_line(x, y);
  double of_line = 0.0, of_law = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    of_line += std::pow(y[i] - line.at(x[i]), 2);
    of_law += std::pow(y[i] - std::log(law->error_at(std::exp(x[i]))), 2);
  }
  constexpr double akaike = 2.0;
  return double(x.size()) * std::log(of_line / of_law) > akaike ? law->p + law->p_spread : 0.0;
}

}  // namespace clackers::judge
