#include "clackers/methods/contact/contact_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "clackers/base/constants.hpp"

namespace clackers::methods {
namespace {

// "contacts 1, 2 and 3", the numbers of `rows` and of `last`.
std::string contacts_named(std::vector<std::size_t> rows, std::size_t last) {
  rows.push_back(last);
  std::sort(rows.begin(), rows.end());
  std::string text = fmt::format("contacts {}", rows[0] + 1);
  for (std::size_t k = 1; k < rows.size(); ++k)
    text += fmt::format("{} {}", k + 1 < rows.size() ? "," : " and", rows[k] + 1);
  return text;
}

}  // namespace

template <int Dof>
ContactSet<Dof>::ContactSet(std::vector<model::Contact<Dof>> contacts,
                            const model::Matrix<Dof>& mass)
    : contacts_(std::move(contacts)),
      gaps_(contacts_),
      lcp_(contacts_.size()),
      factors_(contacts_.size()),
      q_(to_index(contacts_.size())) {
  numerics::SpdSolver<Dof> effective;
  effective.compute(mass);
  response_.velocity.resize(mass.rows(), q_.size());
  respond(effective, response_);
}

template <int Dof>
double ContactSet<Dof>::rounding(std::size_t i, const Vector& u) const {
  return 8.0 * epsilon * (row(i).cwiseAbs().dot(u.cwiseAbs()) + std::abs(contacts_[i].gap));
}

template <int Dof>
double ContactSet<Dof>::rate_rounding(std::size_t i, const Vector& v) const {
  return 8.0 * epsilon * row(i).cwiseAbs().dot(v.cwiseAbs());
}

template <int Dof>
void ContactSet<Dof>::respond(const numerics::SpdSolver<Dof>& effective,
                              ContactResponse<Dof>& to) const {
  const auto n = to_index(size());
  to.velocity.resize(response_.velocity.rows(), n);
  to.delassus.resize(n, n);
  for (std::size_t i = 0; i < size(); ++i) {
    auto column = to.velocity.col(to_index(i));
    column = row(i);
    effective.solve_in_place(column);
  }
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
      to.delassus(i, j) = to.delassus(j, i) =
          row(static_cast<std::size_t>(i)).dot(to.velocity.col(j));
}

template <int Dof>
double ContactSet<Dof>::inverse_effective_mass(std::size_t i) const {
  return response_.delassus(to_index(i), to_index(i));
}

template <int Dof>
bool ContactSet<Dof>::are_coupled(std::size_t i, std::size_t j) const {
  // Orthogonal rows leave n products' rounding; any real coupling is far larger.
  const double size = std::sqrt(inverse_effective_mass(i) * inverse_effective_mass(j));
  const double rounding = 16.0 * double(row(i).size()) * epsilon;
  return std::abs(response_.delassus(to_index(i), to_index(j))) > rounding * size;
}

template <int Dof>
std::optional<Objection> ContactSet<Dof>::redundancy(Rows rows) {
  const auto& w = response_.delassus;
  const std::size_t independent = factors_.compute(w, rows);
  if (independent == rows.size()) return std::nullopt;
  // The row that depends on those before it, as a combination of them.
  const auto last = rows[independent];
  Eigen::VectorXd combination(q_.size());
  for (std::size_t k = 0; k < independent; ++k)
    combination[to_index(k)] = w(to_index(rows[k]), to_index(last));
  factors_.solve_in_place(combination);
  std::vector<std::size_t> needed;
  for (std::size_t k = 0; k < independent; ++k)
    if (std::abs(combination[to_index(k)]) * std::sqrt(inverse_effective_mass(rows[k])) >
        1e-6 * std::sqrt(inverse_effective_mass(last)))
      needed.push_back(rows[k]);
  return Objection{
      fmt::format("{} are closed together and their directions depend linearly on each "
                  "other, so their impulses are not unique",
                  contacts_named(needed, last)),
      "redundant-contacts"};
}

template <int Dof>
std::optional<Objection> ContactSet<Dof>::solve(const ContactResponse<Dof>& response, Rows rows,
                                                const Eigen::VectorXd& q,
                                                Eigen::VectorXd& impulses) {
  if (rows.size() > 1)
    if (auto no = redundancy(rows)) return no;
  if (lcp_.solve(response.delassus, q, rows, impulses)) return std::nullopt;
  return Objection{
      "the impulses of contacts that are closed together were not found: rounding of "
      "their complementarity problem hides them",
      "complementarity-failed"};
}

template <int Dof>
std::optional<Objection> ContactSet<Dof>::impact(Rows rows, Vector& v, Eigen::VectorXd& impulses,
                                                 Rows plastic) {
  for (const auto i : rows) {
    const double eta = std::ranges::binary_search(plastic, i) ? 0.0 : restitution(i);
    q_[to_index(i)] = (1.0 + eta) * gap_rate(i, v);
  }
  auto no = solve(response_, rows, q_, impulses);
  if (!no)
    for (const auto i : rows) v += impulses[to_index(i)] * response_.velocity.col(to_index(i));
  return no;
}

std::optional<Objection> objection_to_closed_contacts(const std::string& who,
                                                      const model::ImpactProblem<>& problem) {
  ContactSet<model::any_dof> contacts(problem);
  std::vector<std::size_t> closed;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (contacts.gap(i, problem.start.u) <= contacts.rounding(i, problem.start.u))
      closed.push_back(i);
  auto no = contacts.redundancy(closed);
  if (no)
    no->sentence = fmt::format("{}: t = {} s: {}. Start with one of them open, or remove it.", who,
                               problem.start.t, no->sentence);
  return no;
}

template class ContactSet<1>;
template class ContactSet<2>;
template class ContactSet<model::any_dof>;

}  // namespace clackers::methods
