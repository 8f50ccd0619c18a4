#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clackers/input/history.hpp"

namespace clackers::input {

/// Which column of a file holds what.
struct HistoryColumns {
  using Column = std::optional<std::size_t>;
  Column t, side;
  std::vector<Column> u, v, a;  ///< one entry a mass; v and a: for all masses or for none

  bool has_v() const { return !v.empty(); }
  bool has_a() const { return !a.empty(); }
};

/// Finds the columns by their names (lower case) and notes which are left out. Throws InputError
/// with `path` for one that stands twice, no u at all, and no t unless options.step is given.
HistoryColumns history_columns(const std::string& path, const std::vector<std::string>& names,
                               const HistoryOptions& options, std::vector<Note>& notes);

}  // namespace clackers::input
