#pragma once

#include <string>
#include <vector>

#include "clackers/report/write.hpp"

namespace clackers::report {

/// Curves as a picture of characters, numbered 1, 2, ...
struct CharacterPlot {
  std::string title{};
  std::vector<double> x{};               ///< ascending
  std::vector<std::vector<double>> y{};  ///< a curve each; NaN: no point
  std::vector<double> marks{};           ///< on the axis of x
  std::string x_unit{}, y_unit{};        ///< behind numbers, " s"
  bool log_x = false, log_y = false;
  bool whole_x = false;  ///< the axis of x has only whole numbers
  int rows = 15;
  double least_height = 0.0;  ///< of the axis of y; curves within less are drawn flat
};

/// The picture, at most style.width characters a line and 30 at least. Throws InputError unless there
/// are two points at least and one to nine curves with a value for each.
std::string draw(CharacterPlot plot, const Style& style);

/// The picture of a sheet of curves.
std::string curves(const record::Sheet& sheet, const Style& style);

}  // namespace clackers::report
