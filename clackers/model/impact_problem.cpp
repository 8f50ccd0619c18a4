#include "clackers/model/impact_problem.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::model {
namespace {

using Eigen::Index;

[[noreturn]] void refuse_size(std::string_view what, Index rows, Index columns, Index dof) {
  throw InputError(fmt::format("problem: {} has {} x {} entries; the mass matrix has {} degrees of "
                               "freedom. All sizes must fit together.",
                               what, rows, columns, dof),
                   "wrong-size");
}

void require_vector(std::string_view what, const Eigen::VectorXd& x, Index dof) {
  if (x.size() != dof) refuse_size(what, x.rows(), x.cols(), dof);
  for (Index i = 0; i < dof; ++i)
    require_finite("problem", fmt::format("{}[{}]", what, i + 1), x[i]);
}

void require_symmetric(std::string_view what, const Eigen::MatrixXd& x, Index dof, Code code) {
  if (x.rows() != dof || x.cols() != dof) refuse_size(what, x.rows(), x.cols(), dof);
  for (Index j = 0; j < dof; ++j)
    for (Index i = 0; i < dof; ++i)
      require_finite("problem", fmt::format("{}({},{})", what, i + 1, j + 1), x(i, j));
  if (const auto entry = asymmetric_entry(x))
    throw InputError("problem: " + text_of_asymmetry(what, x, *entry), code);
}

// A pivot that is no more than the rounding of its factorization, n units of its diagonal entry,
// says nothing of its sign.
bool is_positive_definite(const Eigen::MatrixXd& x) {
  return numerics::Cholesky(x).is_definite(
      x, double(x.rows()) * std::numeric_limits<double>::epsilon());
}

void require_direction(const std::string& who, const Eigen::VectorXd& direction, Index dof) {
  require_vector(who + " direction", direction, dof);
  if (direction.isZero(0.0))
    throw InputError(
        fmt::format("{}: direction = 0; allowed: a row with an entry other than 0.", who),
        "out-of-range");
}

void require_contact(const Contact<>& contact, std::size_t number, Index dof,
                     const State<any_dof>& start) {
  const auto who = fmt::format("contact {}", number);
  require_direction(who, contact.direction, dof);
  require_finite(who, "gap", contact.gap);
  require_within(who, "restitution", contact.restitution, 0.0, 1.0);
  const double g = contact.gap_at(start.u), rate = contact.gap_rate(start.v);
  if (g < 0.0 || (g == 0.0 && rate < 0.0))
    throw InputError(
        fmt::format("{}: at the start its gap is {} m, changing by {} m/s; allowed: gap > 0, "
                    "or 0 and not closing. Start before the impact or after it.",
                    who, g, rate),
        "starts-in-contact");
}

void require_friction(const Friction<>& friction, std::size_t number, Index dof,
                      std::size_t contacts) {
  const auto who = fmt::format("friction {}", number);
  require_direction(who, friction.direction, dof);
  require_finite(who, "limit", friction.limit);
  require_within(who, "kinetic", friction.kinetic, 0.0, friction.limit);
  require_finite(who, "velocity", friction.velocity);
  if (!friction.contact) return;
  if (*friction.contact >= contacts)
    refuse(who, "contact", double(*friction.contact + 1),
           fmt::format("the number of one of the {} contacts, from 1", contacts));
  if (friction.kinetic != friction.limit)
    refuse(who, "kinetic", friction.kinetic,
           fmt::format("limit = {}: at a contact there is one coefficient of friction",
                       friction.limit));
}

}  // namespace

// Two products such as S^T M S leave 2 n roundings of the terms, which these diagonal entries bound; 16 is for
// terms that cancel. A slip of the pen is many orders larger.
std::optional<std::pair<Index, Index>> asymmetric_entry(const Eigen::MatrixXd& x) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  for (Index j = 0; j < x.cols(); ++j)
    for (Index i = 0; i < j; ++i) {
      const double size = std::sqrt(std::abs(x(i, i))) * std::sqrt(std::abs(x(j, j)));
      const double allowed = epsilon * (32.0 * double(x.rows()) * size + 4.0 * std::abs(x(i, j)));
      if (!(std::abs(x(i, j) - x(j, i)) <= allowed)) return std::pair(i, j);
    }
  return std::nullopt;
}

std::string text_of_asymmetry(std::string_view name, const Eigen::MatrixXd& x,
                              const std::pair<Index, Index>& entry) {
  const auto [i, j] = entry;
  return fmt::format("{0}({1},{2}) = {3} and {0}({2},{1}) = {4}; allowed: a symmetric matrix.",
                     name, i + 1, j + 1, x(i, j), x(j, i));
}

void validate(const ImpactProblem<>& problem) {
  const auto& [mass, damping, stiffness, load, nonlinear] = problem.system;
  const auto dof = mass.rows();
  if (dof < 1)
    throw InputError("problem: the mass matrix is empty; allowed: at least one degree of freedom.",
                     "wrong-size");
  require_symmetric("mass", mass, dof, "not-positive-definite");
  require_symmetric("damping", damping, dof, "not-symmetric");
  require_symmetric("stiffness", stiffness, dof, "not-symmetric");
  if (!is_positive_definite(mass))
    throw InputError(
        "problem: the mass matrix is not positive definite; allowed: every motion has positive "
        "kinetic energy. Remove degrees of freedom without mass.",
        "not-positive-definite");
  require_finite("problem", "start", problem.start.t);
  require_vector("start u", problem.start.u, dof);
  require_vector("start v", problem.start.v, dof);
  require_finite("problem", "end", problem.end);
  if (!(problem.end > problem.start.t))
    refuse("problem", "end", problem.end,
           fmt::format("end > start = {}, in seconds", problem.start.t));
  for (std::size_t i = 0; i < problem.contacts.size(); ++i)
    require_contact(problem.contacts[i], i + 1, dof, problem.start);
  for (std::size_t i = 0; i < problem.frictions.size(); ++i)
    require_friction(problem.frictions[i], i + 1, dof, problem.contacts.size());
}

namespace {

// A force for any number of degrees of freedom, for Dof of them. Its vectors are those of one call.
template <int Dof>
class SizedForce final : public NonlinearForce<Dof> {
 public:
  explicit SizedForce(std::shared_ptr<const NonlinearForce<any_dof>> force)
      : force_(std::move(force)), u_(Dof), v_(Dof), p_(Dof), dp_du_(Dof, Dof), dp_dv_(Dof, Dof) {}

  void add(const Vector<Dof>& u, const Vector<Dof>& v, Vector<Dof>& p) const override {
    u_ = u;
    v_ = v;
    p_ = p;
    force_->add(u_, v_, p_);
    p = p_;
  }
  void add_tangent(const Vector<Dof>& u, const Vector<Dof>& v, Matrix<Dof>& dp_du,
                   Matrix<Dof>& dp_dv) const override {
    u_ = u;
    v_ = v;
    dp_du_ = dp_du;
    dp_dv_ = dp_dv;
    force_->add_tangent(u_, v_, dp_du_, dp_dv_);
    dp_du = dp_du_;
    dp_dv = dp_dv_;
  }
  double potential(const Vector<Dof>& u) const override {
    u_ = u;
    return force_->potential(u_);
  }
  bool has_kinks() const override { return force_->has_kinks(); }

 private:
  std::shared_ptr<const NonlinearForce<any_dof>> force_;
  mutable Vector<any_dof> u_, v_, p_;
  mutable Matrix<any_dof> dp_du_, dp_dv_;
};

}  // namespace

template <int Dof>
ImpactProblem<Dof> with_dof(const ImpactProblem<>& problem) {
  if constexpr (Dof == any_dof) {
    return problem;
  } else {
    if (problem.dof() != Dof)
      throw InputError(fmt::format("problem: it has {} degrees of freedom; {} were expected.",
                                   problem.dof(), Dof),
                       "wrong-size");
    const auto& s = problem.system;
    std::shared_ptr<const NonlinearForce<Dof>> nonlinear;
    if (s.nonlinear) nonlinear = std::make_shared<SizedForce<Dof>>(s.nonlinear);
    ImpactProblem<Dof> fixed{{s.mass, s.damping, s.stiffness, s.add_load, std::move(nonlinear)},
                             {},
                             {problem.start.t, problem.start.u, problem.start.v},
                             problem.end,
                             {}};
    for (const auto& c : problem.contacts)
      fixed.contacts.push_back({c.direction, c.gap, c.restitution});
    for (const auto& f : problem.frictions)
      fixed.frictions.push_back({f.direction, f.limit, f.kinetic, f.velocity, f.contact});
    return fixed;
  }
}

template ImpactProblem<1> with_dof<1>(const ImpactProblem<>&);
template ImpactProblem<2> with_dof<2>(const ImpactProblem<>&);
template ImpactProblem<any_dof> with_dof<any_dof>(const ImpactProblem<>&);

}  // namespace clackers::model
