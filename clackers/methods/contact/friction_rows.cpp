#include "clackers/methods/contact/friction_rows.hpp"

#include <fmt/format.h>

#include "clackers/base/constants.hpp"

namespace clackers::methods {
namespace {

// Whether the force that keeps contact j closed follows from the loads, whatever the motion.
bool is_pressed_by_loads(const ContactSet<model::any_dof>& rows,
                         const model::ImpactProblem<>& problem, std::size_t j) {
  for (std::size_t i = 0; i < problem.contacts.size(); ++i)
    if (i != j && rows.are_coupled(i, j)) return false;
  const auto& system = problem.system;
  const Eigen::VectorXd response = rows.response().velocity.col(to_index(j));
  const auto is_rounding = [&](const Eigen::MatrixXd& matrix) {
    const double unit = 16.0 * double(response.size()) * epsilon;
    return (matrix * response).cwiseAbs().maxCoeff() <=
           unit * (matrix.cwiseAbs() * response.cwiseAbs()).maxCoeff();
  };
  return !system.nonlinear && is_rounding(system.stiffness) && is_rounding(system.damping);
}

}  // namespace

std::optional<Objection> objection_to_stick_slip(const std::string& who,
                                                 const model::ImpactProblem<>& problem) {
  const auto rows = with_frictions(problem);
  if (!rows) return std::nullopt;
  const auto contacts = problem.contacts.size();
  const auto name = [&](std::size_t i) {
    return i < contacts ? fmt::format("contact {}", i + 1)
                        : fmt::format("row {} of friction", i + 1 - contacts);
  };
  for (std::size_t i = contacts; i < rows->size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      if (rows->are_coupled(i, j))
        return Objection{
            fmt::format("{}: {} and {} share a mass; allowed: friction that shares none. "
                        "Use moreau-jean.",
                        who, name(j), name(i)),
            "linear-only"};
    const auto& of = problem.frictions[i - contacts].contact;
    if (of && !is_pressed_by_loads(*rows, problem, *of))
      return Objection{fmt::format("{}: {} has friction, and its force is not that of loads only; "
                                   "allowed: no springs, dampers or other contacts that act there. "
                                   "Use moreau-jean.",
                                   who, name(*of)),
                       "linear-only"};
  }
  return std::nullopt;
}

}  // namespace clackers::methods
