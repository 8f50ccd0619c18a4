#include "clackers/cases/meshes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clackers/base/error.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"

namespace clackers::cases {
namespace {

using model::NodeMass;

const char* name_of(bool is_string) { return is_string ? "string" : "bar"; }

NodeMass node_mass(const ParameterValue& word) {
  return word.text() == "lumped"       ? NodeMass::lumped
         : word.text() == "consistent" ? NodeMass::consistent
                                       : NodeMass::massless;
}

// The largest difference of the displacements of mesh and bar, at 51 times and 17 nodes or fewer.
double space_error(const model::Motion& motion, const exact::BarMotion& bars,
                   const model::Mesh& mesh) {
  constexpr int times = 50;
  const auto nodes = mesh.nodes_with_dof();
  const std::size_t stride = (nodes.size() + 16) / 17;
  double worst = 0.0;
  for (int k = 0; k <= times; ++k) {
    const double t = std::min(bars.end(), bars.end() * k / times);
    const auto now = motion.at(t, model::Side::right);
    for (std::size_t i = 0; i < nodes.size(); i += stride) {
      const auto& [body, x, dof, is_fixed] = nodes[i];
      const double u = bars.at(body, std::abs(x), t, model::Side::right).u.nearest();
      worst = std::max(worst, std::abs(now.u[*dof] - u));
    }
  }
  return worst;
}

std::shared_ptr<const exact::PiecewiseMotion> motion_of(const Case& test_case) {
  try {
    return std::make_shared<const exact::PiecewiseMotion>(test_case.problem, test_case.entry->name);
  } catch (const InputError& error) {
    if (error.code() != Code("not-admissible")) throw;
    throw InputError(
        fmt::format(
            "{} Another number of elements or another eta may do; verify --path does without "
            "the exact motion of the mesh.",
            error.what()),
        error.code());
  }
}

}  // namespace

void use_mesh(Case& test_case, const Values& value, const exact::MeshedBars& meshed) {
  use_mesh(test_case, value,
           exact::bar_mesh(meshed, value("elements"), node_mass(value("mass")), value("eta"),
                           test_case.entry->name),
           most_exact_elements / double(meshed.bars.size()));
}

void use_mesh(Case& test_case, const Values& value, exact::BarMesh made, double most_exact) {
  const auto& who = test_case.entry->name;
  if (!test_case.is_mesh_only && !(value("elements") <= most_exact))
    refuse(who, "elements", value("elements"),
           fmt::format("2 <= elements <= {}, of which the exact motion is known", most_exact),
           "Finer meshes: verify --path, against the body itself.");
  test_case.most_exact_elements = most_exact;
  test_case.problem = std::move(made.problem);
  test_case.mesh = std::move(made.mesh);
  if (test_case.is_mesh_only) return;
  const auto motion = motion_of(test_case);
  test_case.motion = motion;
  // A rigid motion has no period; the run's length is what it has.
  for (const auto& mode : motion->modes().modes())
    test_case.damped_periods.push_back(
        mode.oscillates() && mode.w > 0.0 ? 2.0 * std::numbers::pi / mode.w : motion->end());
  const auto& bars = *test_case.bars;
  const auto* name = name_of(bars.is_string());
  auto& list = test_case.constants;
  list.push_back({"impulse", bars.impulse(bars.end(), model::Side::right).nearest(), "N s",
                  fmt::format("of the {}'s contact up to t_end", name)});
  list.push_back({"h", bars.lengths().front() / value("elements"), "m", "length of an element"});
  list.push_back(
      {"e_space", space_error(*motion, bars, *test_case.mesh), "m",
       fmt::format("largest difference between the displacements of mesh and {}, at 51 times: what "
                   "no integrator on this mesh can mend (verify --path: over the largest u)",
                   name)});
  list.push_back({"error_bound", motion->error_bound(motion->end()).u.maxCoeff(), "m",
                  "of the displacements of the mesh's reference solution at t_end"});
  list.push_back({"t_end", motion->end(), "s", "end of the run"});
  list.push_back({"impacts", double(motion->impact_count(motion->end())), "",
                  "number of impacts of the mesh up to t_end"});
}

void add_contact(Case& test_case, int number, const numerics::Bounded& t, bool closes) {
  const auto* name = name_of(test_case.bars->is_string());
  test_case.constants.push_back(
      {fmt::format("t_{}{}", closes ? "closes" : "opens", number), t.nearest(), "s",
       closes ? fmt::format("contact of the {} begins", name) : "and ends"});
}

std::vector<Parameter> mesh_parameters(bool is_string, double end, std::size_t bars) {
  std::vector<Parameter> list;
  list.push_back(
      {"elements", 16.0, "",
       fmt::format("a whole number, 2 <= elements <= {}", most_exact_elements / double(bars)),
       fmt::format("of the mesh, in each {}", is_string ? "half" : "bar")});
  list.push_back({"mass",
                  "massless",
                  "",
                  "lumped, consistent or massless",
                  "mass of the mesh's nodes",
                  {},
                  {{"lumped", "half an element's mass at each of its ends"},
                   {"consistent", "a sixth of an element's mass times [2 1; 1 2]"},
                   {"massless", "lumped, that of contact nodes moved to their neighbours"}}});
  list.push_back(
      {"eta", 0.0, "", "0 <= eta <= 1; 0 for massless",
       fmt::format("restitution of the mesh's contact node; the {} has none", name_of(is_string))});
  list.push_back(t_end(end));
  return list;
}

}  // namespace clackers::cases
