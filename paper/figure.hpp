#pragma once

#include <limits>
#include <string>
#include <vector>

#include "paper/rendering/assets.hpp"

namespace clackers::paper {

/// How a line looks. Curves that meet differ in colour and in dash or width, so that each is known in grey too.
struct Stroke {
  std::string color;               ///< "#0b62a4"; of assets.hpp
  std::vector<double> dash{1, 0};  ///< lengths of strokes and gaps
  double width = 1.6;
};

/// Strokes that mean the same in every figure.
inline Stroke first_mass() { return {light::m1, {1, 0}, 2.0}; }
inline Stroke second_mass() { return {light::m2, {1, 0}, 0.9}; }

/// One curve, or what else is drawn into a panel.
struct Series {
  enum class Kind {
    line,    ///< through the points in their order
    points,  ///< a marker each
    rule,    ///< a vertical line at each x; y is empty
    shape,   ///< a polygon, filled
    text     ///< `name` at the one point; in no legend, in no csv
  };
  std::string name;          ///< in the legend and in the csv
  std::vector<double> x, y;  ///< in the units of the panel's axes
  Stroke stroke;
  Kind kind = Kind::line;
};

/// An axis of a panel.
struct Axis {
  std::string title;  ///< "displacement u [m]"; stands in the csv too
  double lowest = std::numeric_limits<double>::quiet_NaN();  ///< NaN: from the data
  double highest = std::numeric_limits<double>::quiet_NaN();
  bool logarithmic = false;  ///< with a range
};

struct Panel {
  std::string label;  ///< "a"; empty for the only panel of a figure
  std::string note;   ///< behind the label: "N = 1"
  Axis x, y;
  std::vector<Series> series;
};

enum class Verdict { holds, holds_where, does_not_hold, not_measurable };

/// One sentence of the paper beside what was measured.
struct Claim {
  std::string name;     ///< "eq13"; an anchor of the page and of the manual
  int order = 0;        ///< in the paper
  std::string section;  ///< of the paper: "Section 2.1, Main idea"
  std::string says;     ///< the paper's statement
  Verdict verdict = Verdict::does_not_hold;
  std::string measured;   ///< with the numbers and how they were found; empty where nothing can be
  std::string condition;  ///< where it holds, or because of what it is not measurable
};

/// A figure of the paper, or one it asks for: everything that picture, csv and page show.
struct Figure {
  std::string name;                      ///< "fig12"
  std::string title;                     ///< one line
  std::string caption;                   ///< the paper's, in our words, with the parameters
  int columns = 1;                       ///< panels side by side
  double width = 560.0, height = 170.0;  ///< of a panel [px]
  bool drawing = false;                  ///< a sketch: equal scales, no axes
  std::vector<Panel> panels;
  std::vector<Claim> claims;
  std::vector<std::string> choices;  ///< what the paper leaves open here, and what was taken
};

}  // namespace clackers::paper
