#include "cli/files/paths.hpp"

#include <fmt/format.h>

#include "clackers/base/error.hpp"
#include "clackers/base/input_file.hpp"
#include "clackers/input/text/text_lines.hpp"
#include "clackers/input/text/text_table.hpp"
#include "clackers/record/record_json.hpp"
#include "cli/interrupt.hpp"
#include "cli/values.hpp"

namespace clackers::cli {

std::vector<double> read_times(const std::string& path, double end) {
  input::TextLines lines(path, &interrupt_flag());
  std::vector<double> times;
  while (lines.next()) {
    const auto text = input::trimmed(lines.text());
    if (text.empty()) continue;
    const double t = read_number(lines.place(), text);
    if (!(t >= 0.0 && t <= end))
      refuse("clackers", lines.place(), t, fmt::format("0 <= t <= {} s", end),
             "Set t_end or a_t of the case for a longer run.", "time-outside");
    times.push_back(t);
  }
  if (times.empty())
    throw InputError(lines.name() + " has no times in it; allowed: one time a line, in seconds.",
                     "bad-syntax");
  return times;
}

record::Record read_baseline(const std::string& path) {
  const auto text = InputFile(path).rest(record::longest_record);
  try {
    return record::record_from_json(text, &interrupt_flag());
  } catch (const InputError& error) {
    throw InputError(fmt::format("baseline {}: {}", path, error.what()), error.code());
  }
}

}  // namespace clackers::cli
