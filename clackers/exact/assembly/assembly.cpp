#include "clackers/exact/assembly/assembly.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "clackers/base/mixed_bits.hpp"
#include "clackers/exact/assembly/modal_shape.hpp"
#include "clackers/exact/assembly/shaped_parameters.hpp"
#include "clackers/exact/pair/high_precision.hpp"

namespace clackers::exact {
namespace {

using numerics::DoubleDouble;

// A whole number from 0 to count - 1, from 16 bits of `bits`.
double draw(std::uint64_t bits, int place, std::uint64_t count) {
  return double(((bits >> (16 * place)) & 0xffffu) % count);
}

// Solves S g = right by forward substitution in double-double; only as many of the last values are
// kept as a row can need.
std::vector<double> solve(const AssemblyData& data, std::size_t window, const auto& right) {
  std::vector<double> solution(data.dof());
  std::vector<DoubleDouble> last(window);
  for (std::size_t i = 0; i < data.dof(); ++i) {
    DoubleDouble value = right(i);
    for (std::size_t j = data.first_column(i); j < i; ++j)
      value = value - last[j % window] * data.entry(i, j);
    last[i % window] = value;
    solution[i] = value.hi;
  }
  return solution;
}

}  // namespace

AssemblyData::AssemblyData(const AssemblyParameters& p)
    : seed_(mixed_bits(static_cast<std::uint64_t>(p.seed))),
      coupling_(p.coupling),
      dof_(2 * static_cast<std::size_t>(p.pairs)) {
  const std::size_t width = coupling_ == Coupling::chain   ? 1
                            : coupling_ == Coupling::block ? 4
                                                           : dof_;
  unit_ = 0.0625 / double(std::bit_ceil(width));
}

AssemblyData::Pair AssemblyData::pair(std::size_t j) const {
  const auto bits = mixed_bits(seed_ ^ (2 * j + 1));
  return {0.5 + draw(bits, 0, 25) / 16.0, (1.0 + draw(bits, 1, 16)) / 8.0,
          0.5 + draw(bits, 2, 17) / 16.0};
}

std::size_t AssemblyData::first_column(std::size_t i) const {
  switch (coupling_) {
    case Coupling::chain:
      return i == 0 ? 0 : i - 1;
    case Coupling::block:
      return i - i % 4;
    case Coupling::dense:
      break;
  }
  return 0;
}

double AssemblyData::entry(std::size_t i, std::size_t j) const {
  if (i == j) return 1.0;
  return unit_ * (draw(mixed_bits(mixed_bits(seed_ + 2 * i) ^ j), 0, 17) - 8.0);
}

std::unique_ptr<const ShapedMotion> make_assembly(const AssemblyParameters& p,
                                                  std::string_view who) {
  constexpr double most_pairs = 1e9, largest_seed = 0x1p53;
  require_whole(who, "pairs", p.pairs, 1.0, most_pairs);
  require_whole(who, "seed", p.seed, 0.0, largest_seed);
  require_odd(who, p.X, "The fast mass of each pair is mass 2.");
  // One mass on its spring and dashpot has the phase, the decay and the frequency of all slow masses.
  auto flight = derive(who, RigidStopParameters{p.xi1, p.eta, p.t_end}).flight;
  const auto omega = -flight.masses.front().v_sin;
  flight.masses.clear();

  const AssemblyData data(p);
  const double s = quarter_sine(p.X);
  const std::size_t window = p.coupling == Coupling::chain   ? 2
                             : p.coupling == Coupling::block ? 4
                                                             : data.dof();
  std::vector<ModalColumn> columns(2);
  columns[0].amplitude = solve(data, window, [&](std::size_t i) {
    return i % 2 == 0 ? DoubleDouble{data.pair(i / 2).A, 0.0} : DoubleDouble{};
  });
  columns[1].multiple = p.X;
  columns[1].amplitude = solve(data, window, [&](std::size_t i) {
    const auto [m2, r, A] = data.pair(i / 2);
    return i % 2 == 0 ? DoubleDouble{} : DoubleDouble{-s * r * A, 0.0};
  });
  for (double& x : columns[1].amplitude) x /= p.X;

  ImpactPattern pattern;
  auto& contacts = pattern.contacts.emplace_back(data.dof() / 2);
  for (std::size_t j = 0; j < contacts.size(); ++j) {
    const auto [m2, r, A] = data.pair(j);
    const double speed = A * omega.hi;  // of the slow mass at an impact
    contacts[j] = {static_cast<int>(j), (1.0 + p.eta) * (r * m2) * speed};
    pattern.energy += 0.5 * (r * m2) * speed * speed * (1.0 + r);
  }
  auto shape = std::make_unique<ModalShape>(std::move(columns), omega, p.xi1);
  return std::make_unique<const ShapedMotion>(p, std::move(flight), std::move(shape),
                                              std::move(pattern), who);
}

void require_assembly_fits(std::string_view who, double pairs) {
  require_problem_fits(who, "pairs", pairs, 2.0 * pairs, pairs);
}

model::ImpactProblem<> assembly_problem(const AssemblyParameters& p, const model::Motion& motion,
                                        std::string_view who) {
  require_assembly_fits(who, p.pairs);
  const AssemblyData data(p);
  const auto n = static_cast<Eigen::Index>(data.dof());
  model::ImpactProblem<> problem;
  auto& [mass, damping, stiffness, load, nonlinear] = problem.system;
  mass = stiffness = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd row, above;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto first = static_cast<Eigen::Index>(data.first_column(static_cast<std::size_t>(i)));
    const Eigen::Index width = i - first + 1;
    above = row;
    row = Eigen::VectorXd::Zero(n);
    for (Eigen::Index j = first; j <= i; ++j)
      row[j] = data.entry(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
    const auto [m2, r, A] = data.pair(static_cast<std::size_t>(i) / 2);
    const bool is_slow = i % 2 == 0;
    const Eigen::MatrixXd product =
        row.segment(first, width) * row.segment(first, width).transpose();
    mass.block(first, first, width, width) += (is_slow ? r * m2 : m2) * product;
    // k1 = m1; k2 = m2 (X^2 Omega^2 + sigma^2) = m2 (1 + (X^2 - 1) Omega^2), Omega^2 = 1 - xi1^2.
    if (is_slow) continue;
    stiffness.block(first, first, width, width) += m2 * product;
    model::Contact<> contact;
    contact.direction = above - row;
    contact.restitution = p.eta;
    problem.contacts.push_back(std::move(contact));
  }
  damping = 2.0 * p.xi1 * mass;
  stiffness = mass + (p.X * p.X - 1.0) * ((1.0 - p.xi1) * (1.0 + p.xi1)) * stiffness;
  const auto start = motion.at(0.0, model::Side::right);
  problem.start = {0.0, start.u, start.v};
  problem.end = p.t_end;
  return problem;
}

}  // namespace clackers::exact
