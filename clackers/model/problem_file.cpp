#include "clackers/model/problem_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/base/files/files.hpp"
#include "clackers/base/files/toml_reader.hpp"
#include "clackers/base/text.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/model/nonlinear_springs.hpp"
#include "clackers/model/problem_formats.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::model {

const std::string_view example_problem =
    R"(# A frame of two storeys beside a tower; the roof strikes it. SI units.
M = [[2, 0, 0], [0, 2, 0], [0, 0, 1]]                  # kg: roof, floor, tower
K = [[8, -8, 0], [-8, 16, 0], [0, 0, 20]]              # N/m
C = [[0.08, -0.08, 0], [-0.08, 0.16, 0], [0, 0, 0.2]]  # N s/m
end = 20                                               # s

[start]
u = [0.5, 0.3, -0.1]  # m
v = [0, 0, 0]         # m/s

[[contacts]]           # u1 - u3 >= gap
direction = [1, 0, -1]
gap = -0.05            # m
restitution = 0.8

[[loads]]        # amplitude cos(frequency t + phase)
dof = 2
amplitude = 0.5  # N
frequency = 1.1  # rad/s
phase = 0        # rad
)";

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t most_masses = 1000;

// Reads vectors and matrices as well.
class Reader : public TomlReader {
 public:
  using TomlReader::TomlReader;

  VectorXd vector(const toml::node& node, const std::string& what, Index size) const {
    const auto* list = node.as_array();
    if (list == nullptr || (size >= 0 && Index(list->size()) != size))
      fail(node,
           fmt::format("{} {}; allowed: [ ] with {}.", what,
                       list == nullptr ? "is no list" : fmt::format("has {} numbers", list->size()),
                       size >= 0 ? fmt::format("{} numbers, as M has rows", size) : "numbers"),
           "wrong-size");
    VectorXd values(Index(list->size()));
    for (std::size_t i = 0; i < list->size(); ++i)
      values[Index(i)] = number(*list->get(i), fmt::format("{}[{}]", what, i + 1));
    return values;
  }
  MatrixXd matrix(const toml::node& node, const std::string& what, Index size) const {
    const auto* rows = node.as_array();
    const auto count = rows == nullptr ? 0 : rows->size();
    if (count == 0 || (size >= 0 && Index(count) != size))
      fail(node,
           fmt::format("{} has {} rows; allowed: {} in [[ ], [ ]].", what, count,
                       size >= 0 ? fmt::format("{} rows, as M has", size) : "one or more rows"),
           "wrong-size");
    if (count > most_masses)
      fail(node, fmt::format("{} has {} rows; allowed: up to {}.", what, count, most_masses),
           "out-of-memory");
    MatrixXd values{Index(count), Index(count)};
    for (std::size_t i = 0; i < count; ++i)
      values.row(Index(i)) =
          vector(*rows->get(i), fmt::format("row {} of {}", i + 1, what), Index(count)).transpose();
    if (const auto entry = asymmetric_entry(values))
      fail(node, text_of_asymmetry(what, values, *entry), "not-symmetric");
    // One matrix for all: the mean of both entries, rounded once.
    return values.binaryExpr(values.transpose(),
                             [](double a, double b) { return std::midpoint(a, b); });
  }
};

VectorXd direction_from(const Reader& reader, const toml::table& table, Index dof) {
  auto direction = reader.vector(
      reader.need(table, "direction", "a number for each degree of freedom"), "direction", dof);
  if (direction.isZero(0.0))
    reader.fail(table, "direction = 0; allowed: a number other than 0 in it.", "out-of-range");
  return direction;
}

// From 0, of the number from 1 that the file has.
std::size_t index_from(const Reader& reader, const toml::table& table, const char* key,
                       std::size_t count) {
  const double number = reader.number(table, key, "a number from 1");
  if (!(number >= 1.0 && number <= double(count) && number == std::floor(number)))
    reader.fail(*table.get(key),
                fmt::format("{} = {}; allowed: a whole number, 1 to {}.", key, number, count),
                "out-of-range");
  return std::size_t(number) - 1;
}

// Direction and gap of a contact or a spring.
model::Contact<> contact_from(const Reader& reader, const toml::table& table, Index dof) {
  return {direction_from(reader, table, dof), reader.number(table, "gap", 0.0)};
}

// A contact with a stiffness is a spring.
void add_contacts(const Reader& reader, const toml::table& root, model::ImpactProblem<>& problem) {
  std::vector<model::Contact<>> springs;
  std::vector<double> stiffnesses;
  const auto add = [&](const toml::table& table) {
    auto contact = contact_from(reader, table, problem.dof());
    contact.restitution = reader.number(table, "restitution", 1.0);
    if (!(contact.restitution >= 0.0 && contact.restitution <= 1.0))
      reader.fail(*table.get("restitution"),
                  fmt::format("restitution = {}; allowed: 0 to 1.", contact.restitution),
                  "out-of-range");
    if (table.get("stiffness") == nullptr) return problem.contacts.push_back(std::move(contact));
    if (contact.restitution != 1.0)
      reader.fail(*table.get("restitution"),
                  fmt::format("restitution = {}; allowed: 1, since a contact with a stiffness is "
                              "an elastic spring.",
                              contact.restitution),
                  "penalty-needs-elastic");
    const double stiffness = stiffnesses.emplace_back(reader.number(table, "stiffness", "in N/m"));
    if (!(stiffness > 0.0))
      reader.fail(*table.get("stiffness"),
                  fmt::format("stiffness = {}; allowed: above 0 N/m.", stiffness), "out-of-range");
    springs.push_back(std::move(contact));
  };
  if (const auto* list = reader.tables(root, "contacts"))
    for (const auto& node : *list) {
      reader.require_known(*node.as_table(), {"direction", "gap", "restitution", "stiffness"},
                           " of a contact");
      add(*node.as_table());
    }
  if (const auto* list = reader.tables(root, "springs"))
    for (const auto& node : *list) {
      reader.require_known(*node.as_table(), {"direction", "gap", "stiffness"}, " of a spring");
      reader.need(*node.as_table(), "stiffness", "in N/m");
      add(*node.as_table());
    }
  if (!springs.empty())
    problem.system.nonlinear =
        std::make_shared<model::OneSidedSprings>(std::move(springs), std::move(stiffnesses));
}

void add_nonlinear_springs(const Reader& reader, const toml::table& root,
                           model::ImpactProblem<>& problem) {
  const auto* list = reader.tables(root, "nonlinear_springs");
  if (list == nullptr || list->empty()) return;
  if (problem.system.nonlinear)
    reader.fail(*list, "one-sided and nonlinear springs; allowed: one kind.", "linear-only");
  using Springs = model::NonlinearSprings;
  std::vector<Springs::Row> rows;
  for (const auto& node : *list) {
    const auto& table = *node.as_table();
    reader.require_known(table, {"direction", "law", "stiffness", "length"}, " of a spring");
    const auto& law_node = reader.need(table, "law", "sine or cubic");
    const auto law = reader.word(law_node, "law");
    if (law != "sine" && law != "cubic")
      reader.fail(law_node, fmt::format("law = {}; allowed: sine, cubic.", printable(law)),
                  "unknown-name");
    rows.push_back({direction_from(reader, table, problem.dof()),
                    law == "sine" ? Springs::Law::sine : Springs::Law::cubic,
                    reader.number(table, "stiffness", "in N/m, of cubic in N/m^3"),
                    reader.number(table, "length", 0.0)});
    if (law == "sine" && !(rows.back().length > 0.0))
      reader.fail(table, fmt::format("length = {}; allowed: above 0 m.", rows.back().length),
                  "out-of-range");
  }
  problem.system.nonlinear = std::make_shared<Springs>(std::move(rows));
}

void add_frictions(const Reader& reader, const toml::table& root, model::ImpactProblem<>& problem) {
  const auto* list = reader.tables(root, "frictions");
  if (list == nullptr) return;
  for (const auto& node : *list) {
    const auto& table = *node.as_table();
    const bool is_of_contact = table.get("contact") != nullptr;
    if (is_of_contact)
      reader.require_known(table, {"direction", "coefficient", "velocity", "contact"},
                           " of the friction of a contact");
    else
      reader.require_known(table, {"direction", "limit", "kinetic", "velocity", "contact"},
                           " of a friction");
    model::Friction<> row{direction_from(reader, table, problem.dof()),
                          is_of_contact ? reader.number(table, "coefficient", "of friction")
                                        : reader.number(table, "limit", "in N"),
                          0.0, reader.number(table, "velocity", 0.0)};
    row.kinetic = is_of_contact ? row.limit : reader.number(table, "kinetic", row.limit);
    if (is_of_contact) row.contact = index_from(reader, table, "contact", problem.contacts.size());
    if (!(row.kinetic >= 0.0 && row.kinetic <= row.limit))
      reader.fail(
          table,
          is_of_contact
              ? fmt::format("coefficient = {}; allowed: 0 or more.", row.limit)
              : fmt::format("limit = {}, kinetic = {}; allowed: 0 <= kinetic <= limit, in N.",
                            row.limit, row.kinetic),
          "out-of-range");
    problem.frictions.push_back(std::move(row));
  }
}

void add_loads(const Reader& reader, const toml::table& root, model::ImpactProblem<>& problem) {
  const auto* list = reader.tables(root, "loads");
  if (list == nullptr) return;
  std::vector<model::HarmonicForce> forces;
  for (const auto& node : *list) {
    const auto& table = *node.as_table();
    reader.require_known(table, {"dof", "amplitude", "frequency", "phase"}, " of a load");
    const auto dof = index_from(reader, table, "dof", std::size_t(problem.dof()));
    const double frequency = reader.number(table, "frequency", "rad/s; 0 for a constant force");
    if (!(frequency >= 0.0))
      reader.fail(*table.get("frequency"),
                  fmt::format("frequency = {}; allowed: 0 rad/s or more.", frequency),
                  "out-of-range");
    forces.push_back({int(dof), reader.number(table, "amplitude", "in N"), frequency,
                      reader.number(table, "phase", 0.0)});
  }
  if (!forces.empty()) problem.system.add_load = model::HarmonicLoad(std::move(forces));
}

// How far start velocities and loads take a mass up to the end, about.
double way_without_springs(const model::ImpactProblem<>& problem) {
  double way = problem.start.v.cwiseAbs().maxCoeff() * problem.end;
  if (const auto* load = problem.system.add_load.target<model::HarmonicLoad>())
    for (const auto& f : load->forces())
      way += 0.5 * std::abs(f.amplitude) / problem.system.mass(f.dof, f.dof) * problem.end *
             problem.end;
  return way;
}

// Numbers that come from tonnes, millimetres or milliseconds.
void require_plausible(const std::string& name, const model::ImpactProblem<>& problem) {
  const auto fail = [&](const std::string& sentence) {
    throw InputError(
        fmt::format("{}: {} Numbers are in kg, m, s and N; did you write others?", name, sentence),
        "out-of-range");
  };
  constexpr double light = 3e8, most_phase = 1e7, least_phase = 1e-4;
  if (const double v = problem.start.v.cwiseAbs().maxCoeff(); v > light)
    fail(fmt::format("a start velocity of {:.3g} m/s is above that of light.", v));
  const double square = numerics::highest_square(problem.system.stiffness, problem.system.mass);
  const double highest = std::sqrt(std::max(0.0, square));
  if (const double phase = highest * problem.end; phase > most_phase)
    fail(fmt::format(
        "the highest natural frequency, {:.3g} rad/s, oscillates {:.3g} times up to end = "
        "{} s; allowed: 1e6.",
        highest, phase / 6.283185307179586, problem.end));
  else if (highest > 0.0 && phase < least_phase &&
           way_without_springs(problem) < least_phase * problem.start.u.cwiseAbs().maxCoeff())
    fail(fmt::format(
        "up to end = {} s the highest natural frequency, {:.3g} rad/s, turns by {:.3g} rad "
        "and nothing moves; allowed: 1e-4 or more.",
        problem.end, highest, phase));
}

}  // namespace

model::ImpactProblem<> problem_from_text(std::string_view text, const std::string& name) {
  const auto root = table_from(text, name);
  const Reader reader(name);
  reader.require_known(root,
                       {"M", "C", "K", "end", "start", "contacts", "loads", "springs",
                        "nonlinear_springs", "frictions"},
                       "");
  model::ImpactProblem<> problem;
  auto& system = problem.system;
  system.mass = reader.matrix(reader.need(root, "M", "the mass matrix in kg"), "M", -1);
  const auto n = problem.dof();
  system.stiffness = reader.matrix(reader.need(root, "K", "the stiffness matrix in N/m"), "K", n);
  const auto* damping = root.get("C");
  system.damping =
      damping == nullptr ? MatrixXd(MatrixXd::Zero(n, n)) : reader.matrix(*damping, "C", n);
  problem.end = reader.number(root, "end", "the end of the run in s");
  if (!(problem.end > 0.0))
    reader.fail(*root.get("end"), fmt::format("end = {}; allowed: above 0 s.", problem.end),
                "out-of-range");

  const auto& start_node = reader.need(root, "start", "a table [start] with u and v");
  const auto* start = start_node.as_table();
  if (start == nullptr)
    reader.fail(start_node, "start is no table; allowed: [start] with u and v below it.",
                "bad-syntax");
  reader.require_known(*start, {"t", "u", "v"}, " of start");
  problem.start.t = reader.number(*start, "t", 0.0);
  problem.start.u = reader.vector(reader.need(*start, "u", "displacements in m"), "u", n);
  const auto* v = start->get("v");
  problem.start.v = v == nullptr ? VectorXd(VectorXd::Zero(n)) : reader.vector(*v, "v", n);
  add_contacts(reader, root, problem);
  add_loads(reader, root, problem);
  add_nonlinear_springs(reader, root, problem);
  add_frictions(reader, root, problem);
  try {
    validate(problem);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", name, error.what()), error.code());
  }
  require_plausible(name, problem);
  return problem;
}

model::ImpactProblem<> read_problem(const std::string& path) {
  constexpr auto hint = "A problem is a TOML or JSON file; its format: clackers show piecewise";
  return problem_from_text(read_file(path, hint), path);
}

}  // namespace clackers::model
