#include "clackers/exact/flights/forced_modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <utility>

#include "clackers/base/constants.hpp"
#include "clackers/base/error.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/numerics/linear_algebra.hpp"
#include "clackers/numerics/modes/tridiagonal_modes.hpp"
#include "clackers/numerics/spd_solver.hpp"

namespace clackers::exact {

using Eigen::Index;
using Matrix = ForcedModes::Matrix;
using Vector = ForcedModes::Vector;
using Complex = std::complex<double>;

namespace {

std::optional<numerics::TridiagonalModes> modes_without_defect(
    const model::ImpactProblem<>& problem, const Basis& onto, const Matrix& stiffness_rest) {
  const auto& s = problem.system;
  if (onto.columns() == 0 || !s.damping.isZero(0.0)) return std::nullopt;
  const auto mass = onto.tridiagonal(s.mass);
  const auto stiffness = mass ? onto.tridiagonal(s.stiffness, stiffness_rest) : std::nullopt;
  return stiffness ? numerics::tridiagonal_modes(*stiffness, *mass) : std::nullopt;
}

}  // namespace

ForcedModes::ForcedModes(const model::ImpactProblem<>& problem, std::string_view who,
                         const Matrix& basis, const Vector& offset, const Rest& rest, bool precise)
    : mass_(problem.system.mass.sparseView()),
      damping_(problem.system.damping.sparseView()),
      stiffness_(problem.system.stiffness.sparseView()),
      onto_(basis),
      offset_(offset),
      seconds_(problem.end) {
  const auto& system = problem.system;
  const auto* load = system.add_load.target<model::HarmonicLoad>();
  if (system.nonlinear || (system.add_load && load == nullptr))
    refuse(who, "system", "with a nonlinear force or any load", "linear, with harmonic loads", {},
           "linear-only");
  const Matrix reduced_mass = onto_.reduced(system.mass);
  const auto seen = [&](std::vector<numerics::Mode> modes, const Matrix& shapes) {
    Matrix of_structure = onto_.times(shapes);
    Matrix coordinates = of_structure.transpose() * mass_;
    return numerics::ModalSystem(std::move(modes), std::move(of_structure), std::move(coordinates));
  };
  const auto found = modes_without_defect(problem, onto_, rest.stiffness);
  if (found) {
    std::vector<numerics::Mode> modes;
    for (const double square : found->squares) modes.emplace_back(0.0, square);
    system_ = seen(std::move(modes), found->shapes);
    square_errors_ = found->square_errors;
  } else {
    auto made = numerics::ModalSystem::make(reduced_mass, onto_.reduced(system.damping),
                                            onto_.reduced(system.stiffness));
    if (!made)
      throw InputError(
          fmt::format("{}: two modes that the damping couples have the same eigenvalue and "
                      "the same shape, or nearly so; allowed: motions that are sums of "
                      "modes. Change a number of the damping matrix a little.",
                      who),
          "out-of-range");
    const bool is_whole = made->dof() == mass_.rows();
    if (made->is_coupled()) {
      const Matrix of_forces = numerics::solved(reduced_mass, basis.transpose());
      impulse_response_ = made->inverse().rightCols(made->dof()) * of_forces;
      system_ = is_whole ? *made : made->seen_through(basis, of_forces * mass_);
    } else {
      system_ = is_whole ? *made : seen(made->modes(), made->shapes());
    }
  }
  numerics::SpdSolver<Eigen::Dynamic> solver;
  if (dof() > 0) solver.compute(reduced_mass);
  const auto accelerations = [&](const Matrix& forces) {
    Matrix q = onto_.transposed(forces);
    if (dof() > 0) solver.solve_in_place(q);
    return onto_.times(q);
  };
  const Index n = mass_.rows();
  if (load != nullptr) {
    std::vector<std::pair<model::HarmonicForce, Eigen::VectorXcd>> loads;  // one of each frequency
    for (const auto& f : load->forces()) {
      auto all = std::ranges::find(loads, f.frequency,
                                   [](const auto& other) { return other.first.frequency; });
      if (all == loads.end()) all = loads.insert(all, {f, Eigen::VectorXcd::Zero(n)});
      all->second[f.dof] += std::polar(f.amplitude, f.phase);
    }
    for (const auto& [f, applied] : loads) add_force(applied, f.frequency, accelerations);
  }
  if (!offset.isZero(0.0)) {
    add_force((-(stiffness_ * offset)).cast<Complex>(), 0.0, accelerations);
    forces_.back().applied.setZero();  // the structure's own
  }
  find_residuals();
  if (found && precise) make_precise(*found, load, rest);
}

// z' = A z + g e^(i w t) mode by mode.
void ForcedModes::add_force(const Eigen::VectorXcd& applied, double frequency,
                            const Accelerations& accelerations) {
  const Index n = dof();
  const auto apart = [](const auto& function, const Eigen::VectorXcd& x) {
    Eigen::VectorXcd y = function(Vector(x.imag())).template cast<Complex>() * Complex(0.0, 1.0);
    y += function(Vector(x.real())).template cast<Complex>();
    return y;
  };
  Force force;
  force.frequency = frequency;
  force.applied = applied;
  force.acceleration = apart(accelerations, applied);
  const Eigen::VectorXcd g = apart([&](const Vector& x) { return impulse(x); }, applied);
  const Complex turn(0.0, frequency);
  force.steady = Eigen::VectorXcd::Zero(2 * n);
  for (Index j = 0; j < n; ++j) {
    const auto& mode = system_.modes()[std::size_t(j)];
    const Complex dynamic((mode.omega - frequency) * (mode.omega + frequency),
                          2.0 * mode.sigma * frequency);
    const Complex load_of_mode = g[n + j] + (2.0 * mode.sigma + turn) * g[j];
    if (load_of_mode == 0.0 && g[j] == 0.0) continue;
    if (frequency == 0.0 && mode.omega * seconds_ <= 1.0) {
      push_.resize(std::size_t(n));
      push_[std::size_t(j)].y += g[j].real();
      push_[std::size_t(j)].rate += g[n + j].real();
      continue;
    }
    if (std::abs(dynamic) < 1e-6 * (mode.omega_square + frequency * frequency)) {
      const numerics::Beat beat(mode, frequency);
      const numerics::BeatForm y{beat.scale * load_of_mode, 0.0};
      force.resonances.push_back({j, beat, y, y.derivative(beat)});
      force.steady[n + j] = -g[j];
      continue;
    }
    force.steady[j] = load_of_mode / dynamic;
    force.steady[n + j] = turn * force.steady[j] - g[j];
  }
  if (square_errors_.size() > 0) {
    force.defect_per_time = 2.0 * double(n + 4) * epsilon * impulse_sizes(applied.cwiseAbs());
    for (Index j = 0; j < n; ++j)
      force.defect_per_time[n + j] +=
          4.0 * epsilon * (system_.modes()[std::size_t(j)].omega_square + frequency * frequency) *
          std::abs(force.steady[j]);
  } else {
    const auto left = [&](const auto& part) {
      const Vector z = part(g), a = derived_states(1, z) - Vector(part(force.acceleration));
      return change(derived_states(0, z), a);
    };
    const Matrix real = left([](const auto&x) { return Vector(x.real()); }),
                 imaginary = left([](const auto&x) { return Vector(x.imag()); });
    force.defect_per_time = (real.cwiseAbs2() + imaginary.cwiseAbs2()).cwiseSqrt() +
                            epsilon * double(n + 4) * impulse_sizes(applied.cwiseAbs());
  }
  // What the force itself rounds, where it is that of an offset.
  if (frequency == 0.0)
    force.defect_per_time += 2.0 * double(n + 4) * epsilon *
                             impulse_sizes(Sparse(stiffness_.cwiseAbs()) * offset_.cwiseAbs());
  forces_.push_back(std::move(force));
}

Vector ForcedModes::derived(const Vector& row) const {
  const Index n = dof();
  Vector next(2 * n);
  for (Index j = 0; j < n; ++j) {
    const auto& mode = system_.modes()[std::size_t(j)];
    next[j] = -mode.omega_square * row[n + j];
    next[n + j] = row[j] - 2.0 * mode.sigma * row[n + j];
  }
  return next;
}

Matrix ForcedModes::derived_states(int order, const Matrix& z) const {
  const Index n = dof();
  Matrix y = z.topRows(n), rate = z.bottomRows(n);
  for (; order > 0; --order)
    for (Index j = 0; j < n; ++j) {
      const auto& mode = system_.modes()[std::size_t(j)];
      y.row(j) = -mode.omega_square * y.row(j) - 2.0 * mode.sigma * rate.row(j);
      y.row(j).swap(rate.row(j));
    }
  Matrix u = system_.shapes() * y;
  if (system_.is_coupled()) u += system_.rate_shapes() * rate;
  return u;
}

Vector ForcedModes::row(int order, const Vector& direction) const {
  const Index n = dof();
  Vector row = Vector::Zero(2 * n);
  if (direction.isZero(0.0)) return row;
  row.head(n) = system_.shapes().transpose() * direction;
  if (system_.is_coupled()) row.tail(n) = system_.rate_shapes().transpose() * direction;
  for (; order > 0; --order) row = derived(row);
  return row;
}

Matrix ForcedModes::change(const Matrix& u, const Matrix& v) const {
  Matrix z(2 * dof(), u.cols());
  if (system_.is_coupled()) {
    Matrix both(u.rows() + v.rows(), u.cols());
    both << u, v;
    z = system_.inverse() * both;
  } else {
    z << system_.coordinates() * u, system_.coordinates() * v;
  }
  return z;
}

Vector ForcedModes::impulse(const Vector& direction) const {
  if (system_.is_coupled()) return impulse_response_ * direction;
  Vector z = Vector::Zero(2 * dof());
  z.tail(dof()) = system_.shapes().transpose() * direction;
  return z;
}

Vector ForcedModes::steady(double t) const {
  Vector z = Vector::Zero(2 * dof());
  for (const auto& force : forces_) {
    z += (force.steady * std::polar(1.0, force.frequency * t)).real();
    for (const auto& [j, beat, y, rate] : force.resonances) {
      const auto now = beat.at(t);
      z[j] += y.value(now);
      z[dof() + j] += rate.value(now);
    }
  }
  return z;
}

Vector ForcedModes::advanced(const Vector& z, double s, double push) const {
  const Index n = dof();
  Vector later(2 * n);
  for (Index j = 0; j < n; ++j) {
    const auto& mode = system_.modes()[std::size_t(j)];
    const auto now = numerics::advance(mode, {z[j], z[n + j]}, s);
    later[j] = now.y;
    later[n + j] = now.rate;
    if (push == 0.0 || push_.empty()) continue;
    const auto more = numerics::pushed(mode, push_[std::size_t(j)], s);
    later[j] += push * more.y;
    later[n + j] += push * more.rate;
  }
  return later;
}

Vector ForcedModes::rate(const Vector& z) const {
  const Index n = dof();
  Vector rate(2 * n);
  for (Index j = 0; j < n; ++j) {
    rate[j] = z[n + j];
    rate[n + j] = system_.modes()[std::size_t(j)].acceleration(z[j], z[n + j]);
  }
  return rate;
}

Vector ForcedModes::acceleration(const Vector& z, double t) const {
  Vector a = derived_states(2, z);
  for (const auto& force : forces_)
    a += (force.acceleration * std::polar(1.0, force.frequency * t)).real();
  return a;
}

}  // namespace clackers::exact
