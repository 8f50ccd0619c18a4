#include "clackers/base/error.hpp"
#include "clackers/input/results/result_reader.hpp"
#include "clackers/input/text/text_lines.hpp"

namespace clackers::input {

// "n o d a l   p r i n t   o u t ... ( at time 1.0000E-03 )", "nodal point x-disp ...", then a node and twelve
// numbers: displacements, velocities, accelerations, coordinates.
ResultRows read_nodout(InputFile file, const ResultChoice& choice) {
  constexpr std::string_view mark = "at time";
  constexpr std::size_t columns = 13;
  TextLines lines(std::move(file));
  NodeRows rows(lines.name(), choice);
  const auto direction = std::size_t(choice.direction);
  const auto place = choice.coordinates ? direction + 9 : direction;
  for (bool in_table = false; lines.next();) {
    const auto text = lines.text();
    const auto fields = fields_of(text);
    if (const auto at = text.find(mark); at != text.npos) {
      const auto behind = fields_of(text.substr(at + mark.size()));
      if (!behind.empty()) rows.begin(number_of(behind[0], lines.place()));
      in_table = false;
    } else if (text.find("nodal point") != text.npos) {
      in_table = text.find("x-disp") != text.npos;  // not that of rotations
    } else if (in_table && !fields.empty()) {
      if (fields.size() != columns)
        refuse(lines.place(), "numbers", double(fields.size()), "a node and 12 numbers", {},
               "ragged-row");
      rows.take(fields[0], 'u', fields[place], lines.place());
      rows.take(fields[0], 'v', fields[direction + 3], lines.place());
      rows.take(fields[0], 'a', fields[direction + 6], lines.place());
    }
  }
  return rows.finish();
}

}  // namespace clackers::input
