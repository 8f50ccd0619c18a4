#include "clackers/base/error.hpp"
#include "clackers/input/results/result_reader.hpp"
#include "clackers/input/text/text_lines.hpp"

namespace clackers::input {

// "label x y z, three angles, vx vy vz, wx wy wz", a row a node and time; there are no times. The first
// label again begins the next one.
ResultRows read_mbdyn_mov(InputFile file, const ResultChoice& choice) {
  constexpr std::size_t rates = 6;
  TextLines lines(std::move(file));
  NodeRows rows(lines.name(), choice);
  std::string first;
  double count = 0.0;
  const auto direction = std::size_t(choice.direction);
  while (lines.next()) {
    const auto fields = fields_of(lines.text());
    if (fields.empty()) continue;
    if (fields.size() < direction + rates + 1)
      refuse(lines.place(), "numbers", double(fields.size()), "a label and 12 numbers", {},
             "ragged-row");
    if (first.empty()) first = fields[0];
    if (fields[0] == first) rows.begin({count++, 0});
    rows.take(fields[0], 'u', fields[direction], lines.place());
    rows.take(fields[0], 'v', fields[direction + rates], lines.place());
  }
  auto found = rows.finish();
  found.names.front() = "_";  // rows are counted
  return found;
}

}  // namespace clackers::input
