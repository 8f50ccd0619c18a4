#include "clackers/record/schematic.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "clackers/model/harmonic_load.hpp"
#include "clackers/model/nonlinear_springs.hpp"

namespace clackers::record {
namespace {

using Eigen::Index;

// What is below this share of the diagonal is no spring between masses, or not one to the ground: a
// building whose stiffness has the part sigma^2 M of its decay stands on its lowest storey.
constexpr double rounding_share = 1e-12, least_ground_share = 0.05;

bool is_coupled(const Eigen::MatrixXd& k, Index i, Index j) {
  return std::abs(k(i, j)) > rounding_share * std::sqrt(std::abs(k(i, i) * k(j, j)));
}

bool is_grounded(const Eigen::MatrixXd& k, Index i) {
  return std::abs(k.row(i).sum()) > least_ground_share * std::abs(k(i, i));
}

std::vector<Schematic::Spring> springs_of(const Eigen::MatrixXd& k) {
  std::vector<Schematic::Spring> springs;
  for (Index i = 0; i < k.rows(); ++i) {
    if (is_grounded(k, i)) springs.push_back({int(i), -1});
    for (Index j = i + 1; j < k.rows(); ++j)
      if (is_coupled(k, i, j)) springs.push_back({int(i), int(j)});
  }
  return springs;
}

// Both -1 where the contact has no place of its own.
Schematic::Touch touch_of(const model::Contact<>& contact) {
  Schematic::Touch touch;
  int masses = 0;
  for (Index i = 0; i < contact.direction.size(); ++i) {
    if (contact.direction[i] == 0.0) continue;
    ++masses;
    (contact.direction[i] > 0.0 ? touch.right : touch.left) = int(i);
  }
  // A mass that closes by moving to the right meets a wall there, and the other way round.
  const bool is_drawn = masses == 1 || (masses == 2 && touch.left >= 0 && touch.right >= 0);
  if (!is_drawn) return {};
  touch.gap = -contact.gap / contact.direction.cwiseAbs().maxCoeff();
  return touch;
}

// The masses of one structure, layer by layer from the ground.
using Layers = std::vector<std::vector<int>>;

Layers layers_from(const Eigen::MatrixXd& k, std::vector<int> members) {
  std::vector<int> layer;
  for (const int i : members)
    if (is_grounded(k, i)) layer.push_back(i);
  // Where all are grounded, or none is, no layer is above another.
  if (layer.empty()) layer = members;
  Layers layers;
  while (!layer.empty()) {
    std::vector<int> next;
    for (const int i : layer) std::erase(members, i);
    for (const int j : members)
      if (std::ranges::any_of(layer, [&](int i) { return is_coupled(k, i, j); })) next.push_back(j);
    layers.push_back(std::move(layer));
    layer = std::move(next);
  }
  return layers;
}

std::vector<std::vector<int>> structures_of(const Eigen::MatrixXd& k) {
  std::vector<std::vector<int>> structures;
  std::vector<bool> seen(std::size_t(k.rows()), false);
  for (int first = 0; first < int(k.rows()); ++first) {
    if (seen[std::size_t(first)]) continue;
    std::vector<int> members{first};
    seen[std::size_t(first)] = true;
    for (std::size_t next = 0; next < members.size(); ++next)
      for (int j = 0; j < int(k.rows()); ++j)
        if (!seen[std::size_t(j)] && is_coupled(k, members[next], j)) {
          seen[std::size_t(j)] = true;
          members.push_back(j);
        }
    std::ranges::sort(members);
    structures.push_back(std::move(members));
  }
  return structures;
}

// Structures from left to right: before each those that contacts put at its left; where contacts
// close a circle the next in order.
std::vector<std::size_t> from_left(const std::vector<std::vector<int>>& structures,
                                   const std::vector<Schematic::Touch>& contacts) {
  const auto owner = [&](int mass) {
    const auto at = std::ranges::find_if(structures, [&](const auto& members) {
      return std::ranges::find(members, mass) != members.end();
    });
    return std::size_t(at - structures.begin());
  };
  std::vector<std::size_t> order, open(structures.size());
  for (std::size_t i = 0; i < open.size(); ++i) open[i] = i;
  const auto waits = [&](std::size_t structure) {
    return std::ranges::any_of(contacts, [&](const Schematic::Touch& touch) {
      if (touch.left < 0 || touch.right < 0) return false;
      const auto left = owner(touch.left);
      return owner(touch.right) == structure && left != structure &&
             std::ranges::find(open, left) != open.end();
    });
  };
  while (!open.empty()) {
    auto next = std::ranges::find_if_not(open, waits);
    if (next == open.end()) next = open.begin();
    order.push_back(*next);
    open.erase(next);
  }
  return order;
}

// Empty unless every mass hangs at one, and none on other springs.
std::vector<double> lengths_of(const model::ImpactProblem<>& problem) {
  const auto* springs = model::nonlinear_springs(problem);
  if (springs == nullptr || !problem.system.stiffness.isZero(0.0)) return {};
  std::vector<double> lengths(std::size_t(problem.dof()), 0.0);
  for (const auto& row : springs->rows()) {
    Index mass = 0;
    const bool is_of_one = row.direction.cwiseAbs().maxCoeff(&mass) == row.direction.lpNorm<1>();
    if (row.law != model::NonlinearSprings::Law::sine || !is_of_one) return {};
    lengths[std::size_t(mass)] = row.length / std::abs(row.direction[mass]);
  }
  if (std::ranges::find(lengths, 0.0) != lengths.end()) return {};
  return lengths;
}

}  // namespace

Schematic schematic(const model::ImpactProblem<>& problem) {
  Schematic drawing;
  if (problem.dof() > most_blocks) return drawing;
  const auto& k = problem.system.stiffness;
  drawing.springs = springs_of(k);
  const auto* springs = model::one_sided_springs(problem);
  for (const auto& contact : springs == nullptr ? problem.contacts : springs->contacts())
    drawing.contacts.push_back(touch_of(contact));
  const auto has_no_place = [](const auto& touch) { return touch.left < 0 && touch.right < 0; };
  if (std::ranges::any_of(drawing.contacts, has_no_place)) return {};
  drawing.lengths = lengths_of(problem);
  drawing.blocks.resize(std::size_t(problem.dof()));
  const auto structures = structures_of(k);
  auto order = from_left(structures, drawing.contacts);
  drawing.leftward = order.front() > order.back();
  if (drawing.leftward) {
    std::ranges::reverse(order);
    for (auto& touch : drawing.contacts) std::swap(touch.left, touch.right);
  }
  int column = 0;
  for (const auto structure : order) {
    const auto layers = layers_from(k, structures[structure]);
    std::size_t columns = 0;
    for (std::size_t layer = 0; layer < layers.size(); ++layer) {
      for (std::size_t i = 0; i < layers[layer].size(); ++i)
        drawing.blocks[std::size_t(layers[layer][i])] = {column + int(i),
                                                         double(layer + 1) / double(layers.size())};
      columns = std::max(columns, layers[layer].size());
    }
    column += int(columns);
  }
  return drawing;
}

std::vector<Schematic::Node> string_nodes(const model::Mesh& mesh) {
  std::vector<Schematic::Node> nodes;
  const bool is_half = !mesh.nodes.front().is_fixed;
  for (const auto& node : mesh.nodes) {
    if (!node.dof && !node.is_fixed) continue;
    const int mass = node.dof ? int(*node.dof) : -1;
    nodes.push_back({node.x, mass});
    if (is_half && node.x > 0.0) nodes.push_back({-node.x, mass});
  }
  std::ranges::sort(nodes, {}, &Schematic::Node::x);
  return nodes;
}

}  // namespace clackers::record
