#include "clackers/study/program/problem_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "clackers/base/error.hpp"

namespace clackers::study {
namespace {

using Problem = model::ImpactProblem<>;
using Numbers = std::vector<double>;

Numbers numbers(const Eigen::VectorXd& vector) { return {vector.begin(), vector.end()}; }

std::vector<Numbers> rows(const Eigen::MatrixXd& matrix) {
  std::vector<Numbers> rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) rows.push_back(numbers(matrix.row(i)));
  return rows;
}

void require_linear(const Problem& problem) {
  if (problem.system.add_load || problem.system.nonlinear)
    throw InputError(
        "problem: a load or a nonlinear force cannot be written as numbers; allowed: M, C and K.",
        "linear-only");
}

std::string list(const Numbers& values) { return fmt::format("[{}]", fmt::join(values, ", ")); }

std::string nested(const Eigen::MatrixXd& matrix) {
  std::vector<std::string> lists;
  for (const auto& row : rows(matrix)) lists.push_back(list(row));
  return fmt::format("[{}]", fmt::join(lists, ", "));
}

void add_rows(std::string& text, char name, const Eigen::MatrixXd& matrix) {
  int row = 0;
  for (const auto& values : rows(matrix))
    text += fmt::format("{}{}={}\n", name, ++row, fmt::join(values, " "));
}

}  // namespace

std::string problem_json(const Problem& problem) {
  require_linear(problem);
  std::vector<std::string> contacts;
  for (const auto& contact : problem.contacts)
    contacts.push_back(fmt::format(R"({{"direction": {}, "gap": {}, "restitution": {}}})",
                                   list(numbers(contact.direction)), contact.gap,
                                   contact.restitution));
  return fmt::format(
      "{{\"M\": {}, \"C\": {}, \"K\": {},\n \"contacts\": [{}],\n"
      " \"start\": {{\"t\": {}, \"u\": {}, \"v\": {}}}, \"end\": {}}}",
      nested(problem.system.mass), nested(problem.system.damping), nested(problem.system.stiffness),
      fmt::join(contacts, ", "), problem.start.t, list(numbers(problem.start.u)),
      list(numbers(problem.start.v)), problem.end);
}

std::string problem_file_json(std::string_view case_name, const Problem& problem) {
  return fmt::format("{{\"schema\": \"clackers/problem/1\", \"case\": {},\n\"problem\": {}}}\n",
                     nlohmann::json(case_name).dump(), problem_json(problem));
}

std::string problem_file_text(const Problem& problem) {
  require_linear(problem);
  auto text = fmt::format("dof={}\ncontacts={}\nt={}\nend={}\nu={}\nv={}\n", problem.dof(),
                          problem.contacts.size(), problem.start.t, problem.end,
                          fmt::join(numbers(problem.start.u), " "),
                          fmt::join(numbers(problem.start.v), " "));
  add_rows(text, 'M', problem.system.mass);
  add_rows(text, 'C', problem.system.damping);
  add_rows(text, 'K', problem.system.stiffness);
  int number = 0;
  for (const auto& contact : problem.contacts) {
    ++number;
    text +=
        fmt::format("direction{0}={1}\ngap{0}={2}\nrestitution{0}={3}\n", number,
                    fmt::join(numbers(contact.direction), " "), contact.gap, contact.restitution);
  }
  return text;
}

}  // namespace clackers::study
