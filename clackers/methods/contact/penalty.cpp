#include "clackers/methods/contact/penalty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "clackers/base/check.hpp"
#include "clackers/methods/rows.hpp"

namespace clackers::methods {
namespace {

constexpr double default_factor = 1e4;
constexpr double contacts_per_period = 40.0;

// The degree of freedom whose stiffness sets the default of a contact.
template <int Dof>
Eigen::Index first_touched(const model::Contact<Dof>& contact) {
  Eigen::Index i = 0;
  while (contact.direction[i] == 0.0) ++i;
  return i;
}

// The largest omega^2 of a mass in the row of the contact, alone on its springs.
template <int Dof>
double fastest_squared(const model::SmoothSystem<Dof>& system, const model::Contact<Dof>& contact) {
  double most = 0.0;
  for (Eigen::Index i = 0; i < contact.direction.size(); ++i)
    if (contact.direction[i] != 0.0)
      most = std::max(most, system.stiffness(i, i) / system.mass(i, i));
  return most;
}

// Linear one-sided springs at the contacts, p = sum_j stiffness_j min(g_j, 0) b_j, in addition to
// the force that a system has already.
template <int Dof>
class PenaltyForce final : public model::NonlinearForce<Dof> {
 public:
  using Vector = model::Vector<Dof>;
  using Matrix = model::Matrix<Dof>;

  // One stiffness a contact [N/m]. `other` may be empty.
  PenaltyForce(std::vector<model::Contact<Dof>> contacts, std::vector<double> stiffnesses,
               std::shared_ptr<const model::NonlinearForce<Dof>> other)
      : contacts_(std::move(contacts)),
        stiffnesses_(std::move(stiffnesses)),
        other_(std::move(other)) {}

  void add(const Vector& u, const Vector& v, Vector& p) const override {
    if (other_) other_->add(u, v, p);
    for (std::size_t j = 0; j < contacts_.size(); ++j)
      if (const double g = contacts_[j].gap_at(u); g < 0.0)
        p += stiffnesses_[j] * g * contacts_[j].direction;
  }

  void add_tangent(const Vector& u, const Vector& v, Matrix& dp_du, Matrix& dp_dv) const override {
    if (other_) other_->add_tangent(u, v, dp_du, dp_dv);
    for (std::size_t j = 0; j < contacts_.size(); ++j)
      if (contacts_[j].gap_at(u) < 0.0)
        dp_du += stiffnesses_[j] * contacts_[j].direction * contacts_[j].direction.transpose();
  }

 private:
  std::vector<model::Contact<Dof>> contacts_;
  std::vector<double> stiffnesses_;
  std::shared_ptr<const model::NonlinearForce<Dof>> other_;
};

}  // namespace

template <int Dof>
model::ImpactProblem<Dof> with_springs(model::ImpactProblem<Dof> problem,
                                       std::vector<double> stiffnesses) {
  problem.system.nonlinear = std::make_shared<PenaltyForce<Dof>>(
      problem.contacts, std::move(stiffnesses), std::move(problem.system.nonlinear));
  return problem;
}

template model::ImpactProblem<1> with_springs(model::ImpactProblem<1>, std::vector<double>);
template model::ImpactProblem<2> with_springs(model::ImpactProblem<2>, std::vector<double>);
template model::ImpactProblem<> with_springs(model::ImpactProblem<>, std::vector<double>);

const std::vector<Field<Penalty>>& Penalty::fields() {
  static const std::vector<Field<Penalty>> all = {{"stiffness", "0 < stiffness < infinity",
                                                   "of the contact spring [N/m]",
                                                   &Penalty::stiffness, "1e4 k1 or more"}};
  return all;
}

void Penalty::validate() const {
  if (!std::isnan(stiffness)) require_positive(name, "stiffness", stiffness);
}

Claim Penalty::claim(const Facts&) const {
  return {Behaviour::stagnating, 0.0, "contact-stiffness"};
}

template <int Dof>
std::vector<double> Penalty::stiffnesses(const model::ImpactProblem<Dof>& problem) const {
  std::vector<double> all;
  if (!std::isnan(stiffness)) {
    all.assign(problem.contacts.size(), stiffness);
    return all;
  }
  const auto laws = impact_laws(problem);
  for (const auto& law : laws) {
    const auto i = first_touched(law.contact);
    // pi sqrt(m_e / k) <= 2 pi / omega / contacts_per_period, solved for k.
    const double shortest = 0.25 * contacts_per_period * contacts_per_period *
                            fastest_squared(problem.system, law.contact) /
                            law.inverse_effective_mass;
    all.push_back(std::max(default_factor * problem.system.stiffness(i, i), shortest));
  }
  return all;
}

std::optional<Objection> Penalty::objection(const std::string& who,
                                            const model::ImpactProblem<>& problem) const {
  for (const auto& contact : problem.contacts) {
    if (contact.restitution != 1.0)
      return Objection{
          fmt::format("{} with eta = {}: a linear penalty spring gives back what it takes, "
                      "so it can only stand for eta = 1. Use event-driven.",
                      who, contact.restitution),
          "penalty-needs-elastic"};
  }
  const auto all = stiffnesses(problem);
  for (std::size_t j = 0; j < all.size(); ++j)
    if (!(all[j] > 0.0))
      return Objection{
          fmt::format("{}: contact {} has no default stiffness, since degree of freedom {}, "
                      "the first in its row, has none of its own. Give one: "
                      "penalty:stiffness=VALUE, in N/m.",
                      who, j + 1, first_touched(problem.contacts[j]) + 1),
          "no-default-stiffness"};
  return std::nullopt;
}

double Penalty::contact_time(const model::ImpactProblem<>& problem) const {
  const auto laws = impact_laws(problem);
  const auto all = stiffnesses(problem);
  double shortest = 0.0;
  for (std::size_t j = 0; j < laws.size(); ++j) {
    const double time = std::numbers::pi / std::sqrt(all[j] * laws[j].inverse_effective_mass);
    shortest = j == 0 ? time : std::min(shortest, time);
  }
  return shortest;
}

template std::vector<double> Penalty::stiffnesses(const model::ImpactProblem<1>&) const;
template std::vector<double> Penalty::stiffnesses(const model::ImpactProblem<2>&) const;
template std::vector<double> Penalty::stiffnesses(const model::ImpactProblem<>&) const;

template Row row<Penalty>();

}  // namespace clackers::methods
