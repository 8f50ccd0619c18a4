#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "clackers/methods/contact/compliant_law.hpp"
#include "clackers/methods/contact/contact_set.hpp"
#include "clackers/methods/stepping/motion_equation.hpp"

namespace clackers::methods {

/// The compliant forces of closed contacts, in addition to the force that a system has already. Which
/// are closed is decided between steps, so that no force jumps within one. All are open at first.
template <int Dof>
class CompliantForce final : public SwitchedForce<Dof> {
 public:
  using Vector = model::Vector<Dof>;
  using Matrix = model::Matrix<Dof>;

  /// One stiffness a contact.
  CompliantForce(const CompliantLaw& law, const model::ImpactProblem<Dof>& problem,
                 std::span<const double> stiffnesses)
      : law_(law), other_(problem.system.nonlinear) {
    const ContactSet<Dof> set(problem);
    for (std::size_t j = 0; j < set.size(); ++j)
      contacts_.push_back(
          {problem.contacts[j],
           {stiffnesses[j], 1.0 / set.inverse_effective_mass(j), law.damping(set.restitution(j))}});
  }

  bool is_closed(std::size_t j) const { return contacts_[j].is_closed; }
  /// w0: approach speed at first touch [m/s]; negative ones count as 0.
  void close(std::size_t j, double w0) {
    contacts_[j].is_closed = true;
    contacts_[j].compliant.w0 = std::max(w0, 0.0);
  }
  void open(std::size_t j) { contacts_[j].is_closed = false; }
  void open_all() {
    for (auto& contact : contacts_) contact.is_closed = false;
  }
  bool vanishes() const override {
    return !other_ && std::ranges::none_of(contacts_, &Contact::is_closed);
  }

  bool add_tangent_rows(
      const Vector& u, const Vector& v,
      std::vector<typename model::NonlinearForce<Dof>::TangentRow>& rows) const override {
    for (const auto& contact : contacts_) {
      if (!contact.is_closed) continue;
      const auto f = force(contact, u, v);
      rows.push_back({&contact.rigid.direction, f.by_d, f.by_w});
    }
    return !other_ || other_->add_tangent_rows(u, v, rows);
  }

  void add(const Vector& u, const Vector& v, Vector& p) const override {
    if (other_) other_->add(u, v, p);
    for (const auto& contact : contacts_)
      if (contact.is_closed) p -= force(contact, u, v).value * contact.rigid.direction;
  }

  void add_tangent(const Vector& u, const Vector& v, Matrix& dp_du, Matrix& dp_dv) const override {
    if (other_) other_->add_tangent(u, v, dp_du, dp_dv);
    for (const auto& contact : contacts_) {
      if (!contact.is_closed) continue;
      const auto f = force(contact, u, v);
      const auto& b = contact.rigid.direction;
      dp_du += f.by_d * b * b.transpose();
      dp_dv += f.by_w * b * b.transpose();
    }
  }

 private:
  struct Contact {
    model::Contact<Dof> rigid;
    CompliantContact compliant;
    bool is_closed = false;
  };

  ContactForce force(const Contact& contact, const Vector& u, const Vector& v) const {
    return law_.force(contact.compliant, -contact.rigid.gap_at(u), -contact.rigid.gap_rate(v));
  }

  const CompliantLaw& law_;
  std::vector<Contact> contacts_;
  std::shared_ptr<const model::NonlinearForce<Dof>> other_;  // may be empty
};

}  // namespace clackers::methods
