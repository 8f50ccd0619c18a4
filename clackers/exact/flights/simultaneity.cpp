#include "clackers/exact/flights/simultaneity.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "clackers/model/harmonic_load.hpp"
#include "clackers/numerics/double_double.hpp"

namespace clackers::exact {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_trials = 100000;

/// A permutation of degrees of freedom with signs, found one after another.
class Symmetry {
 public:
  Symmetry(const model::ImpactProblem<>& problem, std::size_t from, std::size_t to)
      : problem_(problem),
        from_(problem.contacts[from]),
        to_(problem.contacts[to]),
        n_(problem.dof()),
        image_(std::size_t(n_)),
        sign_(std::size_t(n_)),
        is_taken_(std::size_t(n_), false) {}

  bool exists() { return has_equal_law(from_, to_) && extends(0); }

 private:
  static bool has_equal_law(const model::Contact<>& a, const model::Contact<>& b) {
    return a.gap == b.gap && a.restitution == b.restitution;
  }
  bool extends(Index k) {
    if (k == n_) return keeps_contacts();
    for (Index image = 0; image < n_; ++image)
      for (const double sign : {1.0, -1.0}) {
        if (is_taken_[std::size_t(image)] || ++trials_ > most_trials) continue;
        image_[std::size_t(k)] = image;
        sign_[std::size_t(k)] = sign;
        if (!fits(k)) continue;
        is_taken_[std::size_t(image)] = true;
        if (extends(k + 1)) return true;
        is_taken_[std::size_t(image)] = false;
      }
    return false;
  }
  bool fits(Index k) const {
    const Index image = image_[std::size_t(k)];
    const double sign = sign_[std::size_t(k)];
    const auto vector_fits = [&](const VectorXd& a, const VectorXd& b) {
      return b[image] == sign * a[k];
    };
    const auto& start = problem_.start;
    if (!vector_fits(start.u, start.u) || !vector_fits(start.v, start.v) ||
        !vector_fits(from_.direction, to_.direction) || !has_equal_forces(k, image, sign))
      return false;
    const auto& s = problem_.system;
    for (const MatrixXd* x : {&s.mass, &s.damping, &s.stiffness})
      for (Index l = 0; l <= k; ++l)
        if ((*x)(image, image_[std::size_t(l)]) != sign * sign_[std::size_t(l)] * (*x)(k, l))
          return false;
    return true;
  }
  bool has_equal_forces(Index k, Index image, double sign) const {
    const auto* load = problem_.system.add_load.target<model::HarmonicLoad>();
    if (load == nullptr) return true;
    const auto on = [&](Index dof, double factor) {
      std::vector<std::array<double, 3>> forces;
      for (const auto& f : load->forces())
        if (f.dof == int(dof)) forces.push_back({factor * f.amplitude, f.frequency, f.phase});
      std::ranges::sort(forces);
      return forces;
    };
    return on(k, sign) == on(image, 1.0);
  }
  bool keeps_contacts() const {
    return std::ranges::all_of(problem_.contacts, [&](const model::Contact<>& contact) {
      VectorXd moved(n_);
      for (Index k = 0; k < n_; ++k)
        moved[image_[std::size_t(k)]] = sign_[std::size_t(k)] * contact.direction[k];
      return std::ranges::any_of(problem_.contacts, [&](const model::Contact<>& other) {
        return has_equal_law(contact, other) && moved == other.direction;
      });
    });
  }

  const model::ImpactProblem<>& problem_;
  const model::Contact<>&from_, &to_;
  Index n_;
  std::vector<Index> image_;
  std::vector<double> sign_;
  std::vector<bool> is_taken_;
  int trials_ = 0;
};

// Without rounding.
bool is_multiple(const MatrixXd& x, const MatrixXd& mass) {
  const auto equal = [](double a, double b, double c, double d) {
    const auto left = numerics::two_product(a, b), right = numerics::two_product(c, d);
    return left.hi == right.hi && left.lo == right.lo;
  };
  for (Index i = 0; i < x.rows(); ++i)
    for (Index j = 0; j < x.cols(); ++j)
      if (!equal(x(i, j), mass(0, 0), mass(i, j), x(0, 0))) return false;
  return true;
}

bool has_one_frequency(const model::ImpactProblem<>& problem) {
  const auto& s = problem.system;
  return !s.add_load && is_multiple(s.stiffness, s.mass) && is_multiple(s.damping, s.mass) &&
         (problem.start.u.isZero(0.0) || problem.start.v.isZero(0.0)) &&
         std::ranges::all_of(problem.contacts, [](const auto& c) { return c.gap == 0.0; });
}

}  // namespace

bool close_together(const model::ImpactProblem<>& problem, std::size_t first, std::size_t second) {
  return has_one_frequency(problem) || Symmetry(problem, first, second).exists();
}

}  // namespace clackers::exact
