#include "clackers/diagnose/file/interpolation.hpp"

#include <algorithm>
#include <cmath>

namespace clackers::diagnose {
namespace {

constexpr double least_share = 0.25, least_jump = 1000.0;

// Equally spaced rows of one displacement.
struct Column {
  std::vector<double> u;
  double spacing = 0.0, rounding = 0.0, scale = 1.0;
};

double difference(const std::vector<double>& u, std::size_t i, int degree) {
  if (degree == 1) return u[i + 1] - 2.0 * u[i] + u[i - 1];
  return u[i + 2] - 4.0 * u[i + 1] + 6.0 * u[i] - 4.0 * u[i - 1] + u[i - 2];
}

std::optional<Interpolation> pieces_of(const Column& column, int degree, std::size_t impacts) {
  const auto& u = column.u;
  const std::size_t reach = degree == 1 ? 1 : 2;
  if (u.size() < 50) return {};
  // The weights of the differences sum up to 4 and 16.
  const double tolerance = (degree == 1 ? 4.0 : 16.0) * column.rounding;
  std::size_t vanishing = 0, counted = 0, nodes = 0, first = 0, last = 0, quiet = reach;
  double jump = 0.0, most = 0.0, largest = 0.0;
  for (std::size_t i = reach; i + reach < u.size(); ++i) {
    const double d = difference(u, i, degree);
    largest = std::max(largest, std::abs(d));
    ++counted;
    if (std::abs(d) <= tolerance) {
      vanishing += std::abs(u[i + 1] - u[i - 1]) > 100.0 * tolerance;
      ++quiet;
      continue;
    }
    if (quiet >= reach) {  // another node
      most = std::max(most, std::abs(jump));
      jump = 0.0;
      if (nodes == 0) first = i;
      last = i;
      ++nodes;
    }
    quiet = 0;
    jump += d;
  }
  most = std::max(most, std::abs(jump));
  if (double(vanishing) < least_share * double(counted) || largest < least_jump * tolerance)
    return {};
  if (nodes < 10 + 3 * impacts) return {};
  Interpolation found;
  found.degree = degree;
  found.spacing = double(last - first) * column.spacing / double(nodes - 1);
  // A sum of differences over a node is the jump times spacing^degree.
  const double parts = found.spacing / column.spacing;
  found.error = most / column.scale * (degree == 1 ? parts / 8.0 : parts * parts * parts / 384.0);
  return found;
}

}  // namespace

std::optional<Interpolation> interpolation_of(const Observation& history,
                                              const model::Kinematics& scale) {
  const auto& rows = history.opening;
  const auto masses = std::size_t(rows.dof);
  std::size_t end = 1;
  const double spacing = rows.t.size() > 1 ? rows.t[1] - rows.t[0] : 0.0;
  const double slack = 1e-6 * spacing + 2.0 * history.facts.time_half_unit;
  while (end < rows.t.size() && std::abs(rows.t[end] - rows.t[end - 1] - spacing) <= slack) ++end;
  const auto impacts = std::size_t(std::ranges::count_if(
      *history.sample.impacts, [&](const auto& impact) { return impact.t <= rows.t[end - 1]; }));
  std::optional<Interpolation> found;
  for (std::size_t mass = 0; mass < masses; ++mass) {
    Column column;
    column.spacing = spacing;
    column.scale = scale.u[Eigen::Index(mass)];
    for (std::size_t row = 0; row < end; ++row) column.u.push_back(rows.u[row * masses + mass]);
    double largest = 0.0;
    for (const double u : column.u) largest = std::max(largest, std::abs(u));
    column.rounding = 4.0 * std::numeric_limits<double>::epsilon() * largest;
    for (const auto& printed : history.facts.columns)
      if (printed.name == "u" + std::to_string(mass + 1) || printed.name == "u")
        column.rounding = std::max(column.rounding, printed.half_unit);
    for (const int degree : {1, 3}) {
      const auto pieces = pieces_of(column, degree, impacts);
      if (!pieces) continue;
      if (!found || pieces->error > found->error) found = pieces;
      break;
    }
  }
  return found;
}

}  // namespace clackers::diagnose
