#include "clackers/exact/flights/idle_contacts.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <map>
#include <utility>

#include "clackers/model/harmonic_load.hpp"

namespace clackers::exact {
namespace {

using Eigen::Index;
using Fraction = boost::multiprecision::cpp_rational;
using Row = std::vector<Fraction>;
using Rows = std::vector<Row>;

constexpr Index most_masses = 16;

// Subtracts multiples of the row at `pivot` so that the column is 0 in all others.
void eliminate(Rows& rows, std::size_t pivot, std::size_t column) {
  const Fraction largest = rows[pivot][column];
  for (auto& entry : rows[pivot]) entry /= largest;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Fraction share = rows[i][column];
    if (i == pivot || share == 0) continue;
    for (std::size_t j = 0; j < rows[i].size(); ++j) rows[i][j] -= share * rows[pivot][j];
  }
}

Fraction product(const Row& a, const Row& b) {
  Fraction sum = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    if (a[i] != 0 && b[i] != 0) sum += a[i] * b[i];
  return sum;
}

// M a + C v + K u = loads + B' force with B a = 0.
class Dynamics {
 public:
  Dynamics(const model::ImpactProblem<>& problem, const std::vector<bool>& closed)
      : n_(std::size_t(problem.dof())), constant_(n_, 0) {
    const auto entries = [&](const Eigen::MatrixXd& x) {
      Rows rows(n_, Row(n_));
      for (std::size_t i = 0; i < n_; ++i)
        for (std::size_t j = 0; j < n_; ++j) rows[i][j] = x(Index(i), Index(j));
      return rows;
    };
    damping_ = entries(problem.system.damping);
    stiffness_ = entries(problem.system.stiffness);
    for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
      if (!closed[i]) continue;
      number_of_[i] = held_.size();
      held_.push_back(vector(problem.contacts[i].direction));
      held_.back().push_back(problem.contacts[i].gap);
    }
    if (const auto* springs = model::one_sided_springs(problem))
      for (std::size_t s = 0; s < springs->contacts().size(); ++s)
        if (closed[problem.contacts.size() + s])
          add_spring(springs->contacts()[s], springs->stiffnesses()[s]);
    if (const auto* load = problem.system.add_load.target<model::HarmonicLoad>()) add(*load);
    solve(entries(problem.system.mass));
  }

  bool has_solution() const { return !forces_.empty(); }
  bool is_never_pressed(std::size_t contact) const {
    const Row& force = forces_[number_of_.at(contact)];
    if (std::ranges::any_of(loads_,
                            [&](const auto& load) { return product(force, load.second) != 0; }))
      return false;
    Row of_u = times(force, stiffness_), of_v = times(force, damping_);
    of_u.push_back(0);
    of_v.push_back(0);
    // What the constraints make of them: their rows times u are the gaps, times v 0.
    Rows rows = held_;
    std::size_t done = 0;
    for (std::size_t column = 0; column < n_ && done < rows.size(); ++column) {
      const auto pivot = std::find_if(rows.begin() + std::ptrdiff_t(done), rows.end(),
                                      [&](const Row& row) { return row[column] != 0; });
      if (pivot == rows.end()) continue;
      std::swap(rows[done], *pivot);
      eliminate(rows, done, column);
      for (Row* row : {&of_u, &of_v}) {
        const Fraction share = (*row)[column];
        for (std::size_t j = 0; j <= n_; ++j) (*row)[j] -= share * rows[done][j];
      }
      ++done;
    }
    const auto is_zero = [&](const Row& row) {
      return std::all_of(row.begin(), row.begin() + std::ptrdiff_t(n_),
                         [](const Fraction& x) { return x == 0; });
    };
    return is_zero(of_u) && is_zero(of_v) && product(force, constant_) + of_u[n_] == 0;
  }

  bool is_idle_from(Row u, Row v, std::size_t contact) const {
    const auto moves = [&](const Row& x, const Fraction& gap) {
      return std::ranges::any_of(held_, [&](const Row& row) {
        return product(row, x) != (gap == 0 ? Fraction(0) : row[n_]);
      });
    };
    if (moves(u, 1) || moves(v, 0)) return false;
    for (const auto& [kind, load] : loads_)
      if (kind.second != 0.0) return false;
    const Row& force = forces_[number_of_.at(contact)];
    const std::size_t orders = 2 * n_ + 2 * loads_.size() + 1;
    for (std::size_t order = 0; order < orders; ++order) {
      Row pushing = order == 0 ? constant_ : Row(n_, 0);
      for (const auto& [kind, load] : loads_) {
        if (order % 2 == 1) continue;  // of a cosine at t = 0
        Fraction factor = order % 4 == 0 ? 1 : -1;
        for (std::size_t k = 0; k < order; ++k) factor *= Fraction(kind.first);
        for (std::size_t i = 0; i < n_; ++i) pushing[i] += factor * load[i];
      }
      for (std::size_t i = 0; i < n_; ++i)
        pushing[i] -= product(damping_[i], v) + product(stiffness_[i], u);
      if (product(force, pushing) != 0) return false;
      u = std::exchange(v, Row(n_));
      for (std::size_t i = 0; i < n_; ++i) v[i] = product(accelerations_[i], pushing);
    }
    return true;
  }

  Row vector(const Eigen::VectorXd& x) const {
    Row row(n_, 0);
    for (std::size_t i = 0; i < n_; ++i) row[i] = x[Index(i)];
    return row;
  }

 private:
  void add_spring(const model::Contact<>& contact, double stiffness) {
    const Row b = vector(contact.direction);
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) stiffness_[i][j] += stiffness * b[i] * b[j];
      constant_[i] += Fraction(stiffness) * contact.gap * b[i];
    }
  }
  void add(const model::HarmonicLoad& load) {
    for (const auto& f : load.forces()) {
      const bool is_constant = f.frequency == 0.0 && f.phase == 0.0;
      Row& to =
          is_constant ? constant_ : loads_.try_emplace({f.frequency, f.phase}, n_, 0).first->second;
      to[std::size_t(f.dof)] += f.amplitude;
    }
  }
  static Row times(const Row& row, const Rows& x) {
    Row result(x.size(), 0);
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t j = 0; j < x.size(); ++j) result[j] += row[i] * x[i][j];
    return result;
  }
  // Accelerations and forces by what pushes the masses.
  void solve(const Rows& mass) {
    const std::size_t all = n_ + held_.size();
    Rows rows(all, Row(all + n_, 0));
    for (std::size_t i = 0; i < n_; ++i) {
      std::ranges::copy(mass[i], rows[i].begin());
      rows[i][all + i] = 1;
    }
    for (std::size_t k = 0; k < held_.size(); ++k)
      for (std::size_t i = 0; i < n_; ++i) {
        rows[i][n_ + k] = -held_[k][i];
        rows[n_ + k][i] = held_[k][i];
      }
    for (std::size_t column = 0; column < all; ++column) {
      if (rows[column][column] == 0) return;  // directions that depend on each other
      eliminate(rows, column, column);
    }
    for (auto& row : rows) row.erase(row.begin(), row.begin() + std::ptrdiff_t(all));
    accelerations_.assign(rows.begin(), rows.begin() + std::ptrdiff_t(n_));
    forces_.assign(rows.begin() + std::ptrdiff_t(n_), rows.end());
  }

  std::size_t n_;
  Rows damping_, stiffness_;
  Rows held_;  // directions, then the gap
  std::map<std::size_t, std::size_t> number_of_;
  Row constant_;
  std::map<std::pair<double, double>, Row> loads_;  // by frequency and phase
  Rows accelerations_, forces_;
};

}  // namespace

bool is_never_pressed(const model::ImpactProblem<>& problem, const std::vector<bool>& closed,
                      std::size_t contact) {
  if (problem.dof() > most_masses) return false;
  const Dynamics dynamics(problem, closed);
  return dynamics.has_solution() && dynamics.is_never_pressed(contact);
}

bool is_idle_from_start(const model::ImpactProblem<>& problem, const std::vector<bool>& closed,
                        std::size_t contact) {
  if (problem.dof() > most_masses) return false;
  const Dynamics dynamics(problem, closed);
  return dynamics.has_solution() &&
         dynamics.is_idle_from(dynamics.vector(problem.start.u), dynamics.vector(problem.start.v),
                               contact);
}

}  // namespace clackers::exact
