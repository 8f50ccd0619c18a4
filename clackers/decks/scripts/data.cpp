#include "clackers/decks/scripts/data.hpp"

#include <fmt/format.h>

#include "clackers/base/number.hpp"
#include "clackers/decks/text.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/model/problem_file.hpp"

namespace clackers::decks {
namespace {

using Matrix = Eigen::MatrixXd;

class Writer {
 public:
  explicit Writer(const Syntax& syntax) : syntax_(syntax) {}

  void comment(std::string_view text) { text_ += fmt::format("{} {}\n", syntax_.comment, text); }
  void number(std::string_view name, double value) {
    text_ += filled(syntax_.number, {{"name", std::string(name)}, {"value", exact_number(value)}});
  }
  void list(std::string_view name, const Matrix& rows, std::string_view form) {
    std::string values;
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
      for (Eigen::Index j = 0; j < rows.cols(); ++j) {
        if (i + j > 0) values += j > 0 ? ", " : fmt::format(",{}\n    ", syntax_.line);
        values += exact_number(rows(i, j));
      }
    text_ += filled(form, {{"name", std::string(name)},
                           {"values", values.empty() ? std::string(syntax_.nothing) : values},
                           {"columns", fmt::format("{}", rows.cols())},
                           {"rows", fmt::format("{}", rows.rows())}});
  }
  void table(std::string_view name, const Matrix& rows) { list(name, rows, syntax_.table); }
  void vector(std::string_view name, const Eigen::VectorXd& values) {
    list(name, values.transpose(), syntax_.vector);
  }
  std::string text() const { return text_; }

 private:
  const Syntax& syntax_;
  std::string text_;
};

void set_row(Matrix& rows, std::size_t i, const model::Contact<>& contact, double last) {
  rows.row(Eigen::Index(i)) << contact.direction.transpose(), contact.gap, last;
}

}  // namespace

std::string list_of(std::string_view name, const Matrix& rows, const Syntax& syntax) {
  Writer writer(syntax);
  writer.table(name, rows);
  return writer.text();
}

std::string data(const model::ImpactProblem<>& problem, const Syntax& syntax) {
  model::problem_json(problem);  // refuses what is no numbers
  const auto n = problem.dof();
  Matrix contacts(Eigen::Index(problem.contacts.size()), n + 2), springs(0, n + 2), loads(0, 4);
  for (std::size_t i = 0; i < problem.contacts.size(); ++i)
    set_row(contacts, i, problem.contacts[i], problem.contacts[i].restitution);
  if (const auto* found = model::one_sided_springs(problem)) {
    springs.resize(Eigen::Index(found->contacts().size()), n + 2);
    for (std::size_t i = 0; i < found->contacts().size(); ++i)
      set_row(springs, i, found->contacts()[i], found->stiffnesses()[i]);
  }
  if (const auto* found = problem.system.add_load.target<model::HarmonicLoad>()) {
    loads.resize(Eigen::Index(found->forces().size()), 4);
    for (Eigen::Index i = 0; const auto& f : found->forces())
      loads.row(i++) << f.dof + 1, f.amplitude, f.frequency, f.phase;
  }
  Writer writer(syntax);
  writer.comment("M a + C v + K u = loads, by rows [kg, N s/m, N/m]");
  writer.table("M", problem.system.mass);
  writer.table("C", problem.system.damping);
  writer.table("K", problem.system.stiffness);
  writer.comment("displacements [m] and velocities [m/s] at t0 [s]; the run ends at last [s]");
  writer.vector("u0", problem.start.u);
  writer.vector("v0", problem.start.v);
  writer.number("t0", problem.start.t);
  writer.number("last", problem.end);
  writer.comment("a row a contact: b, gap [m], restitution; b . u >= gap");
  writer.table("contacts", contacts);
  writer.comment("a row a spring: b, gap [m], stiffness [N/m]; it acts where b . u < gap");
  writer.table("springs", springs);
  writer.comment("a row a load: mass, amplitude [N], frequency [rad/s], phase; times cosine");
  writer.table("loads", loads);
  return writer.text();
}

}  // namespace clackers::decks
