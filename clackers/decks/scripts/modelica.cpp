#include <fmt/format.h>
#include <fmt/ranges.h>

#include "clackers/base/number.hpp"
#include "clackers/decks/rows.hpp"
#include "clackers/decks/text.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/model/problem_file.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::decks {
namespace {

std::string braces(const Eigen::VectorXd& values) {
  std::vector<std::string> numbers;
  for (const double value : values) numbers.push_back(exact_number(value));
  return fmt::format("{{{}}}", fmt::join(numbers, ", "));
}

std::string braces(const Eigen::MatrixXd& matrix) {
  std::vector<std::string> rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    rows.push_back(braces(Eigen::VectorXd(matrix.row(i))));
  return fmt::format("{{{}}}", fmt::join(rows, ",\n    "));
}

// Sums of loads and springs on the right of the equation of motion.
std::string forces(const model::ImpactProblem<>& problem) {
  std::string text;
  if (const auto* found = problem.system.add_load.target<model::HarmonicLoad>())
    for (const auto& f : found->forces())
      text += fmt::format(
          "\n    + {} * cos({} * time + {})",
          braces(Eigen::VectorXd(f.amplitude * Eigen::VectorXd::Unit(problem.dof(), f.dof))),
          exact_number(f.frequency), exact_number(f.phase));
  if (const auto* found = model::one_sided_springs(problem))
    for (std::size_t i = 0; i < found->contacts().size(); ++i) {
      const auto b = braces(found->contacts()[i].direction);
      text += fmt::format("\n    - {} * min({} * u - ({}), 0) * {}",
                          exact_number(found->stiffnesses()[i]), b,
                          exact_number(found->contacts()[i].gap), b);
    }
  return text.empty() ? " zeros(n)" : text;
}

// A branch a contact: reinit may stand in one when-equation only.
std::string impacts(const model::ImpactProblem<>& problem) {
  std::string text;
  for (const auto& contact : problem.contacts) {
    const Eigen::VectorXd jump = numerics::solved(problem.system.mass, contact.direction);
    const auto b = braces(contact.direction);
    text += fmt::format("  {} {} * u < {} then\n    reinit(v, pre(v) - {} * ({} * pre(v)) * {});\n",
                        text.empty() ? "when" : "elsewhen", b, exact_number(contact.gap),
                        exact_number((1.0 + contact.restitution) / contact.direction.dot(jump)), b,
                        braces(jump));
  }
  return text.empty() ? text : text + "  end when;\n";
}

}  // namespace

std::vector<DeckFile> modelica(const Subject& subject) {
  const auto& problem = subject.problem;
  model::problem_json(problem);  // refuses what is no numbers
  auto text = head(subject, "modelica", "//") + "model Model\n";
  text += fmt::format("  constant Integer n = {};\n", problem.dof());
  for (const auto& [name, matrix] : {std::pair{'M', &problem.system.mass},
                                     {'C', &problem.system.damping},
                                     {'K', &problem.system.stiffness}})
    text += fmt::format("  constant Real {}[n, n] = {};\n", name, braces(*matrix));
  text += fmt::format(
      "  Real u[n](start = {}, each fixed = true);\n  Real v[n](start = {}, each fixed = true);\n",
      braces(Eigen::VectorXd(problem.start.u)), braces(Eigen::VectorXd(problem.start.v)));
  text += fmt::format("equation\n  der(u) = v;\n  M * der(v) + C * v + K * u ={};\n{}end Model;\n",
                      forces(problem), impacts(problem));
  const auto solve = fmt::format(
      "printf 'loadFile(\"Model.mo\");\\nsimulate(Model, startTime=%s, stopTime=%s, tolerance=%s, "
      "numberOfIntervals=4000, outputFormat=\"mat\", fileNamePrefix=\"%s\");\\ngetErrorString();\\n' "
      "{} {} \"$2\" \"$1\" > \"$1.mos\"\n  omc \"$1.mos\"",
      exact_number(problem.start.t), exact_number(problem.end));
  return {{"Model.mo", text},
          run_script(subject, tolerances(), solve, "_res.mat", "--expect proper:1")};
}

}  // namespace clackers::decks
