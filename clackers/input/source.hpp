#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace clackers::input {

/// A column of doubles in memory.
struct NumberColumn {
  std::string name;               ///< as a header would have it: "t", "u1"
  const double* first = nullptr;  ///< none: a column without numbers, which may only be left out
  std::ptrdiff_t stride = 1;      ///< from one row to the next, in doubles
};

/// A table in memory that belongs to the caller; it must outlive the reading.
struct NumberColumns {
  std::string name;  ///< in messages and records, where a file has its path: "history 1"
  std::size_t rows = 0;
  std::vector<NumberColumn> columns;
};

/// Where a history or a list of impacts comes from: the path of a file, "-" for standard input,
/// or columns in memory.
using Source = std::variant<std::string, NumberColumns>;

/// What is asked of a result file of another program.
struct ResultChoice {
  std::string reader{};  ///< its name, or "table" for a plain one; empty: by the first bytes
  std::vector<std::string> nodes{};  ///< of the masses, in their order; empty: as they first appear
  int direction = 1;                 ///< 1, 2 or 3
  bool coordinates = false;          ///< u is the coordinate, not the displacement
  int most_nodes = 0;                ///< 0: one a mass
};

/// Reads what is asked in words: `component` is 1, 2, 3, coor1, coor2 or coor3, empty for 1. Throws InputError
/// (out-of-range), which calls it `name`.
ResultChoice result_choice(const std::string& reader, std::vector<std::string> nodes,
                           const std::string& component, std::string_view name);

/// What messages call a source: its path, "standard input", or the name of its columns.
std::string name_of(const Source& source);
/// The path of a file, empty for columns in memory.
std::string path_of(const Source& source);
/// As the caller gave it: the path, "-" among them, or the name of the columns.
std::string given_name(const Source& source);
/// False for an empty path, which stands for no source.
bool is_given(const Source& source);

}  // namespace clackers::input
