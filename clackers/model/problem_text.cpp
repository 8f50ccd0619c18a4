#include "clackers/model/problem_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/base/files/json.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/model/nonlinear_springs.hpp"

namespace clackers::model {
namespace {

using Problem = model::ImpactProblem<>;
using Numbers = std::vector<double>;

Numbers numbers(const Eigen::VectorXd& vector) { return {vector.begin(), vector.end()}; }

std::vector<Numbers> rows(const Eigen::MatrixXd& matrix) {
  std::vector<Numbers> rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) rows.push_back(numbers(matrix.row(i)));
  return rows;
}

const model::HarmonicLoad* harmonic(const Problem& problem) {
  return problem.system.add_load.target<model::HarmonicLoad>();
}
void require_numbers(const Problem& problem) {
  if ((problem.system.add_load && harmonic(problem) == nullptr) ||
      (problem.system.nonlinear && model::one_sided_springs(problem) == nullptr &&
       model::nonlinear_springs(problem) == nullptr))
    throw InputError(
        "problem: its load or nonlinear force cannot be written as numbers; allowed: M, C and K, "
        "harmonic loads, one-sided, sine and cubic springs.",
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
  require_numbers(problem);
  std::vector<std::string> contacts;
  for (const auto& contact : problem.contacts)
    contacts.push_back(fmt::format(R"({{"direction": {}, "gap": {}, "restitution": {}}})",
                                   list(numbers(contact.direction)), contact.gap,
                                   contact.restitution));
  std::string forces;
  if (const auto* load = harmonic(problem)) {
    std::vector<std::string> loads;
    for (const auto& f : load->forces())
      loads.push_back(fmt::format(R"({{"dof": {}, "amplitude": {}, "frequency": {}, "phase": {}}})",
                                  f.dof + 1, f.amplitude, f.frequency, f.phase));
    forces += fmt::format(" \"loads\": [{}],\n", fmt::join(loads, ", "));
  }
  if (const auto* one_sided = model::one_sided_springs(problem)) {
    std::vector<std::string> rows;
    for (std::size_t i = 0; i < one_sided->contacts().size(); ++i)
      rows.push_back(fmt::format(R"({{"direction": {}, "gap": {}, "stiffness": {}}})",
                                 list(numbers(one_sided->contacts()[i].direction)),
                                 one_sided->contacts()[i].gap, one_sided->stiffnesses()[i]));
    forces += fmt::format(" \"springs\": [{}],\n", fmt::join(rows, ", "));
  }
  if (const auto* springs = model::nonlinear_springs(problem)) {
    std::vector<std::string> rows;
    for (const auto& row : springs->rows())
      rows.push_back(
          fmt::format(R"({{"direction": {}, "law": "{}", "stiffness": {}, "length": {}}})",
                      list(numbers(row.direction)), row.name(), row.stiffness, row.length));
    forces += fmt::format(" \"nonlinear_springs\": [{}],\n", fmt::join(rows, ", "));
  }
  if (!problem.frictions.empty()) {
    std::vector<std::string> rows;
    for (const auto& f : problem.frictions) {
      const auto direction = list(numbers(f.direction));
      rows.push_back(
          f.contact
              ? fmt::format(
                    R"({{"direction": {}, "coefficient": {}, "velocity": {}, "contact": {}}})",
                    direction, f.limit, f.velocity, *f.contact + 1)
              : fmt::format(R"({{"direction": {}, "limit": {}, "kinetic": {}, "velocity": {}}})",
                            direction, f.limit, f.kinetic, f.velocity));
    }
    forces += fmt::format(" \"frictions\": [{}],\n", fmt::join(rows, ", "));
  }
  if (!problem.unstated.empty())
    forces += fmt::format(" \"unstated\": {},\n", json_quoted(problem.unstated));
  return fmt::format(
      "{{\"M\": {}, \"C\": {}, \"K\": {},\n \"contacts\": [{}],\n{}"
      " \"start\": {{\"t\": {}, \"u\": {}, \"v\": {}}}, \"end\": {}}}",
      nested(problem.system.mass), nested(problem.system.damping), nested(problem.system.stiffness),
      fmt::join(contacts, ", "), forces, problem.start.t, list(numbers(problem.start.u)),
      list(numbers(problem.start.v)), problem.end);
}

std::string mesh_json(const Mesh& mesh) {
  std::vector<std::string> nodes, elements;
  for (const auto& node : mesh.nodes)
    nodes.push_back(fmt::format(R"({{"body": {}, "x": {}, "dof": {}, "fixed": {}}})", node.body + 1,
                                node.x, node.dof ? std::to_string(*node.dof + 1) : "null",
                                node.is_fixed));
  for (const auto& e : mesh.elements)
    elements.push_back(fmt::format(R"({{"nodes": [{}, {}], "stiffness": {}, "density": {}}})",
                                   e.left + 1, e.right + 1, e.stiffness, e.density));
  const char* const names[] = {"lumped", "consistent", "massless"};
  return fmt::format(R"({{"mass": "{}", "nodes": [{}], "elements": [{}]}})", names[int(mesh.mass)],
                     fmt::join(nodes, ", "), fmt::join(elements, ", "));
}

std::string problem_members(const Problem& problem, const std::optional<Mesh>& mesh) {
  return "\"problem\": " + problem_json(problem) + (mesh ? ",\n\"mesh\": " + mesh_json(*mesh) : "");
}

std::string problem_file_json(std::string_view case_name, const Problem& problem,
                              const std::optional<Mesh>& mesh) {
  return fmt::format("{{\"schema\": \"clackers/problem/1\", \"case\": {},\n{}}}\n",
                     json_quoted(case_name), problem_members(problem, mesh));
}

std::string problem_file_text(const Problem& problem) {
  require_numbers(problem);
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
  if (const auto* load = harmonic(problem)) {
    number = 0;
    for (const auto& f : load->forces())
      text += fmt::format("load{}={} {} {} {}\n", ++number, f.dof + 1, f.amplitude, f.frequency,
                          f.phase);
  }
  if (const auto* one_sided = model::one_sided_springs(problem))
    for (std::size_t i = 0; i < one_sided->contacts().size(); ++i)
      text += fmt::format("spring{}={} {} {}\n", i + 1,
                          fmt::join(numbers(one_sided->contacts()[i].direction), " "),
                          one_sided->contacts()[i].gap, one_sided->stiffnesses()[i]);
  number = 0;
  if (const auto* springs = model::nonlinear_springs(problem))
    for (const auto& row : springs->rows())
      text += fmt::format("{}{}={} {} {}\n", row.name(), ++number,
                          fmt::join(numbers(row.direction), " "), row.stiffness, row.length);
  number = 0;
  for (const auto& f : problem.frictions) {
    const auto direction = fmt::format("{}", fmt::join(numbers(f.direction), " "));
    ++number;
    text += f.contact ? fmt::format("rubbing{}={} {} {} {}\n", number, direction, f.limit,
                                    f.velocity, *f.contact + 1)
                      : fmt::format("friction{}={} {} {} {}\n", number, direction, f.limit,
                                    f.kinetic, f.velocity);
  }
  if (!problem.unstated.empty()) text += fmt::format("unstated={}\n", problem.unstated);
  return text;
}

}  // namespace clackers::model
