#pragma once

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "clackers/input/source.hpp"
#include "clackers/input/testing/npy_bytes.hpp"

// For tests that read the same numbers from several sources.
namespace clackers::input {

using Numbers = std::vector<double>;

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A table of numbers, row by row.
struct Data {
  std::vector<std::string> names;
  std::vector<Numbers> rows;
};

/// The columns one after the other; they stay where they are when the object is moved.
struct Memory {
  Numbers numbers;
  NumberColumns columns;
};

inline Memory memory_of(const Data& data, bool reversed = false) {
  Memory memory;
  const auto rows = data.rows.size();
  memory.numbers.resize(rows * data.names.size());
  memory.columns = {"history 1", rows, {}};
  for (std::size_t c = 0; c < data.names.size(); ++c) {
    double* first = memory.numbers.data() + c * rows;
    for (std::size_t r = 0; r < rows; ++r) first[reversed ? rows - 1 - r : r] = data.rows[r][c];
    if (reversed) first += rows - 1;
    memory.columns.columns.push_back({data.names[c], first, reversed ? -1 : 1});
  }
  return memory;
}

inline std::string text_of(const Data& data) {
  std::string text = fmt::format("{}\n", fmt::join(data.names, ","));
  for (const auto& row : data.rows) text += fmt::format("{}\n", fmt::join(row, ","));
  return text;
}

inline Numbers by_rows(const Data& data) {
  Numbers numbers;
  for (const auto& row : data.rows) numbers.insert(numbers.end(), row.begin(), row.end());
  return numbers;
}

inline std::string structured_of(const Data& data) {
  std::string fields;
  for (const auto& name : data.names) fields += fmt::format("('{}', '<f8'), ", name);
  return npy("[" + fields + "]", fmt::format("({},)", data.rows.size()), bytes_of(by_rows(data)));
}

inline std::string plain_of(const Data& data) {
  return npy("'<f8'", fmt::format("({}, {})", data.rows.size(), data.names.size()),
             bytes_of(by_rows(data)));
}

}  // namespace clackers::input
