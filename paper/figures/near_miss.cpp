// Figure A.3: the nearest miss before an impact.
#include <fmt/format.h>

#include "clackers/cases/case.hpp"
#include "paper/catalogue.hpp"
#include "paper/figures/curves.hpp"

namespace clackers::paper {

Figure near_miss() {
  const auto test_case = cases::make("three-parameter", {{"N", 5.0}, {"xi1", 0.05}});
  const double t1 = constant(test_case, "t_1"), omega2 = constant(test_case, "omega_D2");
  const double r_star = constant(test_case, "r*");
  const double from = t1 - 9.5 / omega2, to = t1 + 0.6 / omega2;
  Series first{"mass 1", {}, {}, first_mass()}, second{"mass 2, r = 3", {}, {}, second_mass()};
  Series grazing{
      fmt::format("mass 2, r = r* = {:.4f}", r_star), {}, {}, {light::muted, {2, 3}, 1.2}};
  Series near{"nearest miss", {}, {}, {light::impact}, Series::Kind::points};
  double least = 1.0;
  constexpr int points = 2000;
  for (int i = 0; i <= points; ++i) {
    const double t = from + (t1 - from) * i / points;
    const auto u = test_case.motion->at(t, model::Side::left).u;
    for (auto* series : {&first, &second, &grazing}) series->x.push_back(t);
    first.y.push_back(u[0]);
    second.y.push_back(u[1]);
    grazing.y.push_back(u[1] * r_star / 3.0);
    if (i == points || (u[0] - u[1]) / u[0] >= least) continue;
    least = (u[0] - u[1]) / u[0];
    near.x = {t, t};
    near.y = {u[0], u[1]};
  }
  Panel panel;
  panel.x = time_axis(from, to);
  panel.y = displacement_axis();
  panel.series = {first, second, grazing, near};
  panel.series.push_back({"impact", {t1}, {}, {light::impact}, Series::Kind::rule});
  panel.series.push_back({"t_C1", {t1 + 0.3 / omega2}, {0.3}, {light::impact}, Series::Kind::text});
  Figure figure;
  figure.width = 640.0;
  figure.height = 300.0;
  figure.caption =
      "Before an impact mass 2 comes nearest to mass 1 about three quarters of its period earlier; N = 5, ξ1 = 0.05. With r = r* instead of 3 the masses would graze there.";
  figure.choices = {
      "The parameters do not stand in the text; N = 5 and ξ1 = 0.05 show the detail. The grazing curve is ours."};
  figure.panels = {panel};
  return figure;
}

}  // namespace clackers::paper
