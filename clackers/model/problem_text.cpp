#include "clackers/model/problem_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/base/json.hpp"
#include "clackers/model/harmonic_load.hpp"

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
      (problem.system.nonlinear && model::one_sided_springs(problem) == nullptr))
    throw InputError(
        "problem: its load or nonlinear force cannot be written as numbers; allowed: M, C and K, "
        "harmonic loads and one-sided springs.",
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

// Takes the lines of a text one by one.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  /// The numbers of the next line, which has this name.
  Eigen::VectorXd numbers(const std::string& name, Eigen::Index count) {
    const auto end = std::min(rest_.find('\n'), rest_.size());
    auto line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (!line.starts_with(name + '=')) refuse_line(line, name, count);
    auto values = line.substr(name.size() + 1);
    Eigen::VectorXd found(count);
    for (auto& value : found) {
      const auto [stop, error] =
          std::from_chars(values.data(), values.data() + values.size(), value);
      if (error != std::errc()) refuse_line(line, name, count);
      values.remove_prefix(static_cast<std::size_t>(stop - values.data()));
      if (values.starts_with(' ')) values.remove_prefix(1);
    }
    if (!values.empty()) refuse_line(line, name, count);
    return found;
  }
  double number(const std::string& name) { return numbers(name, 1)(0); }
  /// Whether the next line has this name.
  bool has(const std::string& name) const { return rest_.starts_with(name + '='); }
  Eigen::Index size(const std::string& name) {
    const double value = number(name);
    // Each number takes a digit and a blank or the end of its line.
    if (!(value >= 0.0 && value <= double(rest_.size()) && value == std::floor(value)))
      refuse("problem", name, value, "a whole number, not above those that follow", {},
             "bad-syntax");
    return static_cast<Eigen::Index>(value);
  }
  Eigen::MatrixXd matrix(const char* name, Eigen::Index size) {
    Eigen::MatrixXd matrix(size, size);
    for (Eigen::Index i = 0; i < size; ++i)
      matrix.row(i) = numbers(fmt::format("{}{}", name, i + 1), size);
    return matrix;
  }

 private:
  [[noreturn]] static void refuse_line(std::string_view line, std::string_view name,
                                       Eigen::Index count) {
    refuse("problem", "line", line, fmt::format("{}= and {} numbers", name, count), {},
           "bad-syntax");
  }

  std::string_view rest_;
};

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
  return fmt::format(
      "{{\"M\": {}, \"C\": {}, \"K\": {},\n \"contacts\": [{}],\n{}"
      " \"start\": {{\"t\": {}, \"u\": {}, \"v\": {}}}, \"end\": {}}}",
      nested(problem.system.mass), nested(problem.system.damping), nested(problem.system.stiffness),
      fmt::join(contacts, ", "), forces, problem.start.t, list(numbers(problem.start.u)),
      list(numbers(problem.start.v)), problem.end);
}

std::string problem_file_json(std::string_view case_name, const Problem& problem) {
  return fmt::format("{{\"schema\": \"clackers/problem/1\", \"case\": {},\n\"problem\": {}}}\n",
                     json_quoted(case_name), problem_json(problem));
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
  return text;
}

Problem problem_from_text(std::string_view text) {
  Lines lines(text);
  Problem problem;
  const auto dof = lines.size("dof"), contacts = lines.size("contacts");
  problem.start.t = lines.number("t");
  problem.end = lines.number("end");
  problem.start.u = lines.numbers("u", dof);
  problem.start.v = lines.numbers("v", dof);
  problem.system.mass = lines.matrix("M", dof);
  problem.system.damping = lines.matrix("C", dof);
  problem.system.stiffness = lines.matrix("K", dof);
  for (Eigen::Index i = 1; i <= contacts; ++i) {
    auto& contact = problem.contacts.emplace_back();
    contact.direction = lines.numbers(fmt::format("direction{}", i), dof);
    contact.gap = lines.number(fmt::format("gap{}", i));
    contact.restitution = lines.number(fmt::format("restitution{}", i));
  }
  std::vector<model::HarmonicForce> forces;
  for (std::string name = "load1"; lines.has(name);
       name = fmt::format("load{}", forces.size() + 1)) {
    const auto f = lines.numbers(name, 4);
    if (!(f[0] >= 1.0 && f[0] <= double(dof) && f[0] == std::floor(f[0])))
      refuse("problem", name, f[0], "a degree of freedom, from 1", {}, "bad-syntax");
    forces.push_back({int(f[0]) - 1, f[1], f[2], f[3]});
  }
  if (!forces.empty()) problem.system.add_load = model::HarmonicLoad(std::move(forces));
  std::vector<model::Contact<>> rows;
  std::vector<double> stiffnesses;
  for (std::string name = "spring1"; lines.has(name);
       name = fmt::format("spring{}", rows.size() + 1)) {
    const auto row = lines.numbers(name, dof + 2);
    rows.push_back({row.head(dof), row[dof], 1.0});
    stiffnesses.push_back(row[dof + 1]);
  }
  if (!rows.empty())
    problem.system.nonlinear =
        std::make_shared<model::OneSidedSprings>(std::move(rows), std::move(stiffnesses));
  return problem;
}

}  // namespace clackers::model
