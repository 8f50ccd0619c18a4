// Figure 2: a drawing.
#include <cmath>

#include "paper/catalogue.hpp"

namespace clackers::paper {
namespace {

using Kind = Series::Kind;

const Stroke ink{light::ink, {1, 0}, 1.6}, thin{light::muted, {1, 0}, 1.0};

Series line(const std::string& name, std::vector<double> x, std::vector<double> y,
            const Stroke& stroke = ink) {
  return {name, std::move(x), std::move(y), stroke, Kind::line};
}

Series text(const std::string& words, double x, double y) {
  return {words, {x}, {y}, ink, Kind::text};
}

void add_hatched_wall(Panel& panel, double x, double low, double high, double lean) {
  panel.series.push_back(line("wall", {x, x}, {low, high}));
  for (double y = low + 0.2; y <= high + 1e-9; y += 0.3)
    panel.series.push_back(line("hatching", {x, x + lean}, {y, y - 0.2}, thin));
}

Series spring(double from, double to, double y) {
  constexpr int teeth = 6;
  const double lead = 0.35, pitch = (to - from - 2.0 * lead) / teeth;
  Series out = line("spring", {from, from + lead}, {y, y});
  for (int i = 0; i < teeth; ++i) {
    out.x.insert(out.x.end(), {from + lead + (i + 0.25) * pitch, from + lead + (i + 0.75) * pitch});
    out.y.insert(out.y.end(), {y + 0.22, y - 0.22});
  }
  out.x.insert(out.x.end(), {to - lead, to});
  out.y.insert(out.y.end(), {y, y});
  return out;
}

void add_dashpot(Panel& panel, double from, double to, double y) {
  const double middle = 0.5 * (from + to);
  panel.series.push_back(line("dashpot", {from, middle + 0.05}, {y, y}));
  panel.series.push_back(line("piston", {middle + 0.05, middle + 0.05}, {y - 0.16, y + 0.16}));
  panel.series.push_back(line("cylinder",
                              {middle - 0.35, middle + 0.35, middle + 0.35, middle - 0.35},
                              {y + 0.24, y + 0.24, y - 0.24, y - 0.24}));
  panel.series.push_back(line("dashpot", {middle + 0.35, to}, {y, y}));
}

Series disc(double x, double y, double radius) {
  Series out{"mass", {}, {}, {light::m1, {1, 0}, 1.4}, Kind::shape};
  constexpr int corners = 48;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::acos(-1.0) * i / corners;
    out.x.push_back(x + radius * std::cos(angle));
    out.y.push_back(y + radius * std::sin(angle));
  }
  return out;
}

}  // namespace

Figure mass_and_stop() {
  // The stop touches the mass at equilibrium, x = 3.8 for its left edge.
  Panel panel;
  panel.x = {.title = "x", .lowest = -0.6, .highest = 9.6};
  panel.y = {.title = "y", .lowest = -0.9, .highest = 2.7};
  add_hatched_wall(panel, 9.0, 0.0, 2.0, 0.25);
  panel.series.push_back(spring(5.3, 9.0, 1.5));
  add_dashpot(panel, 5.3, 9.0, 0.5);
  panel.series.push_back(line("frame", {5.3, 5.3}, {0.5, 1.5}));
  panel.series.push_back(line("rod", {5.0, 5.3}, {1.0, 1.0}));
  panel.series.push_back(disc(4.4, 1.0, 0.6));
  // The obstacle.
  panel.series.push_back({"obstacle",
                          {2.6, 3.8, 3.8, 2.6},
                          {0.0, 0.0, 2.0, 2.0},
                          {light::grid, {1, 0}, 1.4},
                          Kind::shape});
  add_hatched_wall(panel, 2.6, 0.0, 2.0, -0.25);
  // Equilibrium and the direction of u.
  panel.series.push_back(line("equilibrium", {3.8, 3.8}, {-0.55, 2.35}, thin));
  panel.series.push_back(
      line("arrow", {3.8, 5.2, 5.02, 5.2, 5.02}, {-0.3, -0.3, -0.2, -0.3, -0.4}));
  panel.series.push_back(text("u ≥ 0", 5.65, -0.3));
  panel.series.push_back(text("static equilibrium, u = 0", 3.8, 2.52));
  panel.series.push_back(text("rigid stop, η", 1.35, 1.0));
  panel.series.push_back({"m", {4.4}, {1.0}, {light::paper}, Kind::text});
  panel.series.push_back(text("k", 7.15, 1.95));
  panel.series.push_back(text("c", 7.15, 0.05));
  Figure figure;
  figure.drawing = true;
  figure.width = 612.0;
  figure.height = 216.0;
  figure.caption =
      "Schematic: a mass on spring and dashpot, free to move away from a rigid stop that stands where the mass rests at static equilibrium; restitution η.";
  figure.panels = {panel};
  return figure;
}

}  // namespace clackers::paper
