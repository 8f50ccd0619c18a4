#pragma once

#include <string>
#include <vector>

// What is kept of a file, and of a case, beside numbers in tables.
namespace clackers {

/// A named number of a case.
struct Quantity {
  std::string name;  ///< "omega_D1"
  double value = 0.0;
  std::string unit;  ///< "rad/s", empty when dimensionless
  std::string meaning;
  std::string text{};  ///< of a parameter that is a word: "chain"; the value is NaN then
};

/// Something that reading or comparing a file showed.
struct Note {
  std::string code;               ///< "rows-beyond-end", "columns-not-used", ...
  std::vector<double> numbers{};  ///< in the order of the code's entry in record/notes.hpp
  std::string text{};
};

/// How a column of a history is printed.
struct PrintedColumn {
  std::string name;        ///< "t", "u1", "v2"
  int digits = 0;          ///< the most significant digits of any of its numbers
  bool single = false;     ///< more than nine digits, yet all are single-precision numbers
  double half_unit = 0.0;  ///< largest rounding error by printing, in the column's unit; 0: none
};

}  // namespace clackers
