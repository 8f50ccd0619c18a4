#include "clackers/exact/bodies/bar_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/error.hpp"
#include "clackers/exact/pair/parameters.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::exact {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using model::NodeMass;

namespace {

constexpr double most_elements = 4000.0;

void require_elements(std::string_view who, double elements, double least) {
  if (!(elements >= least && elements <= most_elements))
    refuse(who, "elements", elements,
           fmt::format("a whole number, {} <= elements <= {}", least, most_elements));
  if (elements != std::floor(elements))
    refuse(who, "elements", elements, "a whole number", {}, "not-whole");
}

void require(std::string_view who, double elements, NodeMass mass, double eta) {
  require_elements(who, elements, mass == NodeMass::massless ? 2.0 : 1.0);
  require_restitution(who, eta);
  if (mass == NodeMass::massless && eta != 0.0)
    refuse(who, "eta", eta, "eta = 0 with mass = massless",
           "A contact node without mass has no impacts, so restitution has no meaning.");
}

}  // namespace

BarMesh bar_mesh(const MeshedBars& p, double elements, NodeMass mass, double eta,
                 std::string_view who) {
  require(who, elements, mass, eta);
  const bool massless = mass == NodeMass::massless, two = p.bars.size() == 2,
             is_struck = p.striker > 0.0, between = p.clearance > 0.0;
  // Massless nodes of the contact end and of the far end are left out, fixed ones as well.
  const auto n = Index(elements), out = Index(massless), far_out = Index(massless && between),
             nodes = n + 1 - out - far_out - Index(p.is_fixed), masses = Index(is_struck),
             dof = masses + nodes * Index(p.bars.size());
  BarMesh made;
  auto& [problem, mesh] = made;
  mesh.mass = mass;
  mesh.nodes.resize(std::size_t(n + 1) * p.bars.size());
  auto& system = problem.system;
  system.mass = system.damping = system.stiffness = MatrixXd::Zero(dof, dof);
  problem.start = {0.0, VectorXd::Zero(dof), VectorXd::Zero(dof)};
  problem.end = p.end;
  VectorXd weight = VectorXd::Zero(dof);
  // The element at the contact, where its node has no mass; of two bars both in series.
  double compliance = 0.0;
  std::vector<Index> contact_ends;
  for (std::size_t b = 0; b < p.bars.size(); ++b) {
    const auto& bar = p.bars[b];
    const double h = bar.L / elements, m = bar.rho * bar.A * h, k = bar.E * bar.A / h;
    const bool is_left = two && b == 0;
    // Of the node i from the contact end, 0 the end itself; the left bar comes first, backwards.
    const auto number = [&](Index i) {
      return std::size_t(is_left ? n - i : Index(b) * (n + 1) + i);
    };
    const auto place = [&](Index i) {
      i = std::max<Index>(std::min(i, n - far_out) - out, 0);
      return masses + (is_left ? nodes - 1 - i : Index(b) * nodes + i);
    };
    // A fixed node takes part of the elements beside it, and does not move.
    const auto moves = [&](Index i) { return i < dof; };
    contact_ends.push_back(place(0));
    compliance += 1.0 / k;
    for (Index i = 0; i < n; ++i) {
      mesh.elements.push_back({number(is_left ? i + 1 : i), number(is_left ? i : i + 1),
                               bar.E * bar.A, bar.rho * bar.A});
      const Index first = place(i), second = place(i + 1);
      if (mass == NodeMass::consistent) {
        for (const Index j : {first, second})
          if (moves(j)) system.mass(j, j) += m / 3.0;
        if (moves(second)) system.mass(first, second) += m / 6.0;
        if (moves(second)) system.mass(second, first) += m / 6.0;
      } else {
        for (const Index j : {first, second})
          if (moves(j)) system.mass(j, j) += 0.5 * m;
      }
      for (const Index j : {first, second})
        if (moves(j)) weight[j] -= 0.5 * m * p.g;
      if (first == second) continue;  // the element of a massless node
      for (const Index j : {first, second})
        if (moves(j)) system.stiffness(j, j) += k;
      if (!moves(second)) continue;
      system.stiffness(first, second) -= k;
      system.stiffness(second, first) -= k;
    }
    for (Index i = 0; i <= n; ++i) {
      auto& node = mesh.nodes[number(i)];
      node = {b, h * double(is_left ? -i : i), std::nullopt, !moves(place(i))};
      if (node.is_fixed || i < out || i > n - far_out) continue;
      node.dof = place(i);
      problem.start.u[place(i)] = p.pluck * double(n - i) / elements;
      problem.start.v[place(i)] = bar.v0;
    }
  }
  if (p.g > 0.0) {
    std::vector<model::HarmonicForce> forces;
    for (Index i = 0; i < dof; ++i) forces.push_back({int(i), weight[i], 0.0, 0.0});
    system.add_load = model::HarmonicLoad(std::move(forces));
  }
  std::vector<model::Contact<>> contacts{{VectorXd::Unit(dof, contact_ends.back()), -p.gap, eta}};
  auto& contact = contacts.front().direction;
  if (two) contact[contact_ends.front()] = -1.0;
  if (is_struck) {
    contact[0] = -1.0;
    system.mass(0, 0) = p.striker;
    problem.start.v[0] = p.speed;
  }
  if (between) contacts.push_back({-VectorXd::Unit(dof, dof - 1), p.gap - p.clearance, eta});
  if (massless) {
    for (auto& one : contacts) one.restitution = 1.0;  // without meaning
    const std::vector<double> stiffness(contacts.size(), 1.0 / compliance);
    system.nonlinear = std::make_shared<model::OneSidedSprings>(std::move(contacts), stiffness);
  } else {
    problem.contacts = std::move(contacts);
  }
  return made;
}

BarMesh string_mesh(const StringOnObstacleParameters& p, double elements, std::string_view who) {
  require_elements(who, elements, 2.0);
  const auto dof = Index(elements) - 1;
  const double h = p.L / elements;
  BarMesh made;
  auto& [problem, mesh] = made;
  auto& system = problem.system;
  system.mass = p.rho * h * MatrixXd::Identity(dof, dof);
  system.damping = MatrixXd::Zero(dof, dof);
  system.stiffness = 2.0 * p.T / h * MatrixXd::Identity(dof, dof);
  system.stiffness.diagonal(1).setConstant(-p.T / h);
  system.stiffness.diagonal(-1).setConstant(-p.T / h);
  problem.start = {0.0, VectorXd(dof), VectorXd::Zero(dof)};
  problem.end = p.end;
  for (Index i = 0; i < dof; ++i) {
    const double left = double(i + 1), right = elements - left;
    // A pluck in the middle is symmetric without rounding.
    problem.start.u[i] =
        p.H * std::min(left / (p.place * elements), right / ((1.0 - p.place) * elements));
    problem.contacts.push_back({VectorXd::Unit(dof, i), 0.0, 1.0});
  }
  for (Index i = 0; i <= dof + 1; ++i) {
    const bool is_fixed = i == 0 || i == dof + 1;
    mesh.nodes.push_back(
        {0, h * double(i), is_fixed ? std::nullopt : std::optional(i - 1), is_fixed});
    if (i > 0) mesh.elements.push_back({std::size_t(i - 1), std::size_t(i), p.T, p.rho});
  }
  return made;
}

}  // namespace clackers::exact
