#include "clackers/diagnose/file/interpolation.hpp"

#include <algorithm>
#include <cmath>

namespace clackers::diagnose {
namespace {

constexpr double least_share = 0.25, least_jump = 30.0;

// Equally spaced rows of one displacement.
struct Column {
  std::vector<double> u;
  double spacing = 0.0, rounding = 0.0, scale = 1.0;
};

double difference(const std::vector<double>& u, std::size_t i, int degree) {
  if (degree == 1) return u[i + 1] - 2.0 * u[i] + u[i - 1];
  return u[i + 2] - 4.0 * u[i + 1] + 6.0 * u[i] - 4.0 * u[i - 1] + u[i - 2];
}

// Differences that do not vanish, around one node.
struct Node {
  double at = 0.0;       ///< row in the middle
  double largest = 0.0;  ///< of the differences
  double jump = 0.0;     ///< their sum: that of the derivative times spacing^degree
};

double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

std::vector<Node> nodes_of(const std::vector<double>& u, int degree, double tolerance) {
  const std::size_t reach = degree == 1 ? 1 : 2;
  std::vector<Node> nodes;
  std::size_t quiet = reach, first = 0;
  for (std::size_t i = reach; i + reach < u.size(); ++i) {
    const double d = difference(u, i, degree);
    if (std::abs(d) <= tolerance) {
      ++quiet;
      continue;
    }
    if (quiet >= reach) {
      nodes.emplace_back();
      first = i;
    }
    quiet = 0;
    auto& node = nodes.back();
    node.at = 0.5 * double(first + i);
    node.largest = std::max(node.largest, std::abs(d));
    node.jump += d;
  }
  return nodes;
}

double vanishing_share(const std::vector<double>& u, int degree, double tolerance) {
  const std::size_t reach = degree == 1 ? 1 : 2;
  std::size_t vanishing = 0;
  for (std::size_t i = reach; i + reach < u.size(); ++i)
    vanishing += std::abs(difference(u, i, degree)) <= tolerance &&
                 std::abs(u[i + 1] - u[i - 1]) > 10.0 * tolerance;
  return double(vanishing) / double(u.size());
}

std::optional<Interpolation> pieces_of(const Column& column, int degree, std::size_t impacts) {
  if (column.u.size() < 50) return {};
  // The weights of the differences sum up to 4 and 16.
  const double tolerance = (degree == 1 ? 4.0 : 16.0) * column.rounding;
  if (vanishing_share(column.u, degree, tolerance) < least_share) return {};
  auto nodes = nodes_of(column.u, degree, tolerance);
  if (nodes.size() < 10) return {};
  // Nodes where the derivative hardly jumps, and rounding, do not count.
  std::vector<double> sizes;
  for (const auto& node : nodes) sizes.push_back(node.largest);
  const double typical = quantile(sizes, 0.5);
  if (typical < least_jump * tolerance) return {};
  std::erase_if(nodes, [&](const Node& node) { return node.largest < 0.1 * typical; });
  if (nodes.size() < 10 + 3 * impacts) return {};
  std::vector<double> apart, jumps;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i > 0) apart.push_back(nodes[i].at - nodes[i - 1].at);
    jumps.push_back(std::abs(nodes[i].jump));
  }
  // Whole rows lie between nodes: the mean of those near the median.
  const double median = quantile(apart, 0.5);
  double sum = 0.0, count = 0.0;
  for (const double one : apart)
    if (std::abs(one - median) <= 1.5) {
      sum += one;
      ++count;
    }
  const double parts = sum / count;
  Interpolation found;
  found.degree = degree;
  found.spacing = parts * column.spacing;
  // Impacts are among the largest jumps.
  found.error = quantile(jumps, 0.9) / column.scale *
                (degree == 1 ? parts / 8.0 : parts * parts * parts / 384.0);
  for (const auto& node : nodes) found.nodes.push_back(std::size_t(std::llround(node.at)));
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
    // Of u, and of the times at which the polynomials were taken.
    column.rounding = 4.0 * std::numeric_limits<double>::epsilon() *
                      (largest + rows.t[end - 1] * scale.v[Eigen::Index(mass)]);
    for (const auto& printed : history.facts.columns)
      if (printed.name == "u" + std::to_string(mass + 1) || printed.name == "u")
        column.rounding = std::max(column.rounding, printed.half_unit);
    for (const int degree : {1, 3}) {
      const auto pieces = pieces_of(column, degree, impacts);
      if (!pieces) continue;
      if (!found || pieces->error > found->error) {
        found = pieces;
        found->mass = int(mass);
      }
      break;
    }
  }
  return found;
}

}  // namespace clackers::diagnose
