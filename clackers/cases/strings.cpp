#include <fmt/format.h>

#include "clackers/base/error.hpp"
#include "clackers/cases/meshes.hpp"
#include "clackers/exact/bodies/string_on_obstacle.hpp"
#include "clackers/exact/bodies/string_over_point.hpp"

// Vibrating strings above obstacles, and their meshes: docs/manual/explanation/derivations/strings.md.
namespace clackers::cases {
namespace {

// Each node has an impact in each L/c, and each flight has its errors.
constexpr double most_exact_nodes = 400.0;

void build_over_point(Case& test_case, const Values& value, double) {
  const exact::StringOverPointParameters p{within(test_case, value, "L"),
                                           within(test_case, value, "T"),
                                           within(test_case, value, "rho"),
                                           within(test_case, value, "H"),
                                           value("share"),
                                           end_of(test_case, value)};
  if (!(p.share >= 0.0 && p.share < 1.0))
    refuse(test_case.entry->name, "share", p.share, "0 <= share < 1",
           "At 1 the string would rest on the point from the start.");
  const auto motion = std::make_shared<const exact::StringOverPoint>(p);
  test_case.bars = motion;
  auto& list = test_case.constants;
  list.push_back({"c", motion->speed().nearest(), "m/s", "speed of waves"});
  list.push_back({"tau", motion->transit().nearest(), "s", "L/(2 c), a wave's way through a half"});
  list.push_back({"m", p.rho * p.L, "kg", "mass"});
  list.push_back({"gap", (1.0 - p.share) * p.H, "m", "at t = 0"});
  add_contact(test_case, 1, motion->begins(), true);
  add_contact(test_case, 1, motion->ends(), false);
  list.push_back({"period", motion->period().nearest(), "s", "of the string, (3 - share) tau"});
  list.push_back({"force", motion->contact_force().nearest(), "N",
                  "of the point while it is touched, 4 T H/L"});
  // Both halves move as one: half a string of twice the tension and twice the mass.
  use_mesh(test_case, value,
           {.bars = {{0.5 * p.L, p.T, p.rho, 2.0}},
            .gap = -p.share * p.H,
            .end = p.end,
            .is_fixed = true,
            .pluck = p.H});
}

void build_on_obstacle(Case& test_case, const Values& value, double) {
  const exact::StringOnObstacleParameters p{within(test_case, value, "L"),
                                            within(test_case, value, "T"),
                                            within(test_case, value, "rho"),
                                            within(test_case, value, "H"),
                                            value("place"),
                                            end_of(test_case, value)};
  if (!(p.place > 0.0 && p.place < 1.0))
    refuse(test_case.entry->name, "place", p.place, "0 < place < 1",
           "The ends of the string are fixed.");
  const auto motion = std::make_shared<const exact::StringOnObstacle>(p);
  test_case.bars = motion;
  auto& list = test_case.constants;
  const double tau = motion->transit().nearest();
  list.push_back({"c", motion->speed().nearest(), "m/s", "speed of waves"});
  list.push_back({"tau", tau, "s", "L/c, a wave's way through the string"});
  list.push_back({"m", p.rho * p.L, "kg", "mass"});
  add_contact(test_case, 1, motion->begins(), true);
  add_contact(test_case, 1, motion->ends(), false);
  list.push_back({"period", p.place == 0.5 ? tau : 2.0 * tau, "s", "of the string"});
  list.push_back({"impulse1", motion->impulse_of_touch().nearest(), "N s",
                  "of all points in each tau, 4 T H/c"});
  use_mesh(test_case, value, exact::string_mesh(p, value("elements"), test_case.entry->name),
           most_exact_nodes);
}

}  // namespace

std::vector<CaseRow> string_rows() {
  const auto length = positive("L", 1.0, "m", "length"),
             tension = positive("T", 1.0, "N", "tension"),
             density = positive("rho", 1.0, "kg/m", "mass per length");
  std::vector<Parameter> over_point{length,
                                    tension,
                                    density,
                                    positive("H", 1.0, "m", "displacement of the middle at t = 0"),
                                    {"share", 0.25, "", "0 <= share < 1",
                                     "height of the point above the string at rest, over H"}};
  for (auto& p : mesh_parameters(true, 2.5)) over_point.push_back(std::move(p));
  return {
      {{"string-over-point",
        "A string, plucked in its middle, that strikes a point below again and again, and its mesh.",
        "none; H. Cabannes (1984)", std::move(over_point)},
       build_over_point},
      {{"string-on-obstacle",
        "A plucked string above a straight obstacle that all its points strike, and its mesh with a contact at each node.",
        "none; L. Amerio and G. Prouse (1975), A. Haraux and H. Cabannes (1983)",
        {length,
         tension,
         density,
         positive("H", 1.0, "m", "displacement at the pluck at t = 0"),
         {"place", 0.375, "", "0 < place < 1", "of the pluck, over L"},
         {"elements", 16.0, "",
          fmt::format("a whole number, 2 <= elements <= {}", most_exact_nodes), "of the mesh"},
         t_end(2.5)}},
       build_on_obstacle}};
}

}  // namespace clackers::cases
