#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "clackers/model/impact_problem.hpp"

namespace clackers::methods {

/// The gaps of a problem, for many states at once.
struct Gaps {
  struct Entry {
    std::size_t mass;
    double factor;
  };
  std::vector<Entry> entries;     ///< of all rows b, without zeros
  std::vector<std::size_t> ends;  ///< of each row in `entries`
  std::vector<double> gaps;

  /// b . x of a row.
  double product(std::size_t row, const auto& x) const {
    double sum = 0.0;
    for (std::size_t k = row > 0 ? ends[row - 1] : 0; k < ends[row]; ++k)
      sum += entries[k].factor * x[static_cast<Eigen::Index>(entries[k].mass)];
    return sum;
  }

  template <int Dof>
  explicit Gaps(const std::vector<model::Contact<Dof>>& contacts) {
    for (const auto& contact : contacts) {
      for (Eigen::Index i = 0; i < contact.direction.size(); ++i)
        if (contact.direction[i] != 0.0)
          entries.push_back({static_cast<std::size_t>(i), contact.direction[i]});
      ends.push_back(entries.size());
      gaps.push_back(contact.gap);
    }
  }
};

/// Eight steps at once of an integrator whose step is a matrix P: the powers P, P², ..., P^8 act on the
/// state x = (u, v) or (u, v, a) before them. Each is kept as what it adds to u and v,
///
///     P^k = J + T_k,   J = 1 for u and v, 0 for a,   T_(k+1) = J T_k + T_1 J + T_1 T_k
///
/// so that its rounding is that of what changes. A multistep method has the differences of the states
/// before as further unknowns, u - u_-1 and v - v_-1, u_-1 - u_-2 and so on, which the states that
/// are made tell. Products and sums are rounded one by one in a fixed
/// order, so that vectors of all lengths have the same bits.
class StepPowers {
 public:
  static constexpr std::size_t steps = 8;
  /// With more unknowns the matrices take longer than sparse steps.
  static constexpr std::size_t most_unknowns = 64;

  bool exists() const { return size_ > 0; }
  void clear() { size_ = 0; }
  /// Takes T_1 for `dof` masses; the first `made` unknowns, 2 or 3 times as many, are made of each
  /// state, the others are differences.
  void assign(std::size_t dof, std::size_t made, const Eigen::MatrixXd& first);

  /// Goes on from x by steps of h while the cubics through gaps and gap rates of consecutive states
  /// stay open. `u` and `v`, row-major (step, mass), become the states after the steps. Returns how
  /// many were made, at most `most`; x becomes the state after them.
  std::size_t advance(std::span<double> x, const Gaps& gaps, double h, std::size_t most, double* u,
                      double* v);

 private:
  struct alignas(64) Eight {
    double powers[steps];
  };

  std::size_t dof_ = 0, rows_ = 0, size_ = 0;
  std::vector<Eight> table_, y_;
};

}  // namespace clackers::methods
