// Figures 11 and 12: an impact mirrors the response; two impacts restore it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "paper/catalogue.hpp"
#include "paper/figures/curves.hpp"

namespace clackers::paper {
namespace {

constexpr double xi1 = 0.1;
const Stroke dotted{light::muted, {3, 3}, 1.2};

cases::Case paper_case() {
  return cases::make("three-parameter", {{"N", 1.0}, {"xi1", xi1}, {"a_t", 1.0}});
}

// The part of a curve in [from, to].
Series part(const Series& whole, double from, double to) {
  Series out = whole;
  out.x.clear();
  out.y.clear();
  for (std::size_t i = 0; i < whole.x.size(); ++i)
    if (whole.x[i] >= from && whole.x[i] <= to) {
      out.x.push_back(whole.x[i]);
      out.y.push_back(whole.y[i]);
    }
  return out;
}

}  // namespace

Figure mirrored_response() {
  const auto test_case = paper_case();
  const double t1 = test_case.motion->impact(1).t, t2 = test_case.motion->impact(2).t;
  Panel panel;
  panel.x = time_axis(0.0, t2);
  panel.y = displacement_axis();
  for (int mass = 1; mass <= 2; ++mass) {
    const auto whole = part(curve(test_case, mass, Quantity::displacement, 40), 0.0, t2);
    const auto after = part(whole, t1, t2);
    auto alone = without_contact(test_case, mass, after);
    alone.name = fmt::format("mass {} without the impact", mass);
    alone.stroke.dash = {2, 3};
    alone.stroke.width = 1.0;
    panel.series.push_back(whole);
    panel.series.push_back(alone);
  }
  panel.series.push_back({"impact", {t1}, {}, {light::impact}, Series::Kind::rule});
  Figure figure;
  figure.width = 640.0;
  figure.height = 260.0;
  figure.caption =
      "From the impact at t_C1 (vertical line) on, each response is the mirror image, with respect to the time axis, of the response without impact. Drawn for N = 1, ξ1 = 0.1 up to t_C2.";
  figure.choices = {
      "Figure 11 is a typical sketch without parameters; those of Fig. 12 are taken."};
  figure.panels = {panel};
  return figure;
}

Figure coincidence() {
  const auto test_case = paper_case();
  const auto& motion = *test_case.motion;
  const double period = 2.0 * std::numbers::pi / std::sqrt(1.0 - xi1 * xi1);
  Figure figure;
  figure.width = 640.0;
  figure.height = 190.0;
  figure.caption =
      "The actual responses and those without any impact coincide at t_C***, 2 t_C***, 3 t_C*** (points); N = 1, ξ1 = 0.1, a_t = 1: (a) the first mass, (b) the second mass.";
  for (int mass = 1; mass <= 2; ++mass) {
    auto actual = curve(test_case, mass, Quantity::displacement, 40);
    auto free = without_contact(test_case, mass, actual);
    free.name = "without impacts";
    free.stroke = dotted;
    Series points{"coincidence", {}, {}, {light::impact}, Series::Kind::points};
    for (int n = 1; n * period <= motion.end(); ++n) {
      points.x.push_back(n * period);
      points.y.push_back(motion.at(n * period, model::Side::right).u[mass - 1]);
    }
    Panel panel{mass == 1 ? "a" : "b",
                mass == 1 ? "the first mass" : "the second mass",
                time_axis(0.0, motion.end()),
                displacement_axis(),
                {free, actual, points}};
    figure.panels.push_back(panel);
  }
  return figure;
}

}  // namespace clackers::paper
