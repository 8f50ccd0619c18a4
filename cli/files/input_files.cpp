#include "cli/files/paths.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clackers/base/error.hpp"
#include "clackers/base/files/input_file.hpp"
#include "clackers/input/table.hpp"
#include "clackers/record/record_json.hpp"
#include "cli/interrupt.hpp"

namespace clackers::cli {

std::vector<double> read_times(const std::string& path, double end) {
  // Of a table of events a lone column without a name holds times.
  const auto table = input::open_table(path, {}, input::TableKind::events, &interrupt_flag());
  const auto& names = table->names();
  const auto column = std::size_t(std::ranges::find(names, "t") - names.begin());
  if (column == names.size())
    throw InputError(table->name() +
                         " has no column t; allowed: one time a line, in seconds, or "
                         "columns with a header that names t.",
                     "no-column");
  std::vector<double> times;
  Number t;
  while (table->next()) {
    table->read_number(column, t);
    if (!(t.value >= 0.0 && t.value <= end))
      refuse("clackers", table->place(), t.value, fmt::format("0 <= t <= {} s", end),
             "Set t_end or a_t of the case for a longer run.", "time-outside");
    // A history repeats the time of a jump; the response has both of its sides at one.
    if (names.size() == 1 || times.empty() || times.back() != t.value) times.push_back(t.value);
  }
  if (times.empty())
    throw InputError(table->name() + " has no times in it; allowed: one time a line, in seconds.",
                     "too-short");
  return times;
}

record::Record read_record(const std::string& path, const std::string& who) {
  const auto text = InputFile(path).rest(record::longest_record);
  try {
    return record::record_from_json(text, &interrupt_flag());
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} {}: {}", who, path, error.what()), error.code());
  }
}

}  // namespace clackers::cli
