#include "clackers/base/error.hpp"
#include "clackers/input/results/result_reader.hpp"
#include "clackers/input/text/text_lines.hpp"

namespace clackers::input {

// " displacements (vx,vy,vz) for set MASSES and time  0.1000000E-01", a blank line, then "node vx vy vz".
ResultRows read_calculix_dat(InputFile file, const ResultChoice& choice) {
  TextLines lines(std::move(file));
  NodeRows rows(lines.name(), choice);
  for (char quantity = 0; lines.next();) {
    const auto fields = fields_of(lines.text());
    if (fields.empty()) continue;
    if (lines.text().find(" for set ") != std::string_view::npos) {
      quantity = fields[0] == "displacements" ? 'u' : fields[0] == "velocities" ? 'v' : 0;
      if (quantity != 0) rows.begin(number_of(fields.back(), lines.place()));
    } else if (quantity != 0 && fields.size() == 4) {
      rows.take(fields[0], quantity, fields[std::size_t(choice.direction)], lines.place());
    }
  }
  return rows.finish();
}

// "  100CL  101 0.010000000 ..." has the time, " -4  DISP" names a block, " -1" begins a row of it, " -3" ends it.
ResultRows read_calculix_frd(InputFile file, const ResultChoice& choice) {
  constexpr std::size_t label = 3, node = 10,
                        value = 12;  // widths; a time has its 12 behind 12 characters
  TextLines lines(std::move(file));
  NodeRows rows(lines.name(), choice);
  for (char quantity = 0; lines.next();) {
    const auto text = lines.text();
    const auto fields = fields_of(text);
    if (text.starts_with("  100C") && text.size() >= 2 * value) {
      rows.begin(number_of(fields_of(text.substr(value, value)).at(0), lines.place()));
    } else if (text.starts_with(" -4") && fields.size() > 1) {
      quantity = fields[1] == "DISP" ? 'u' : fields[1] == "VELO" ? 'v' : 0;
    } else if (text.starts_with(" -3")) {
      quantity = 0;
    } else if (quantity != 0 && text.starts_with(" -1")) {
      const auto at = label + node + value * std::size_t(choice.direction - 1);
      const auto id = fields_of(text.substr(label, node));
      const auto number = fields_of(text.size() > at ? text.substr(at, value) : std::string_view{});
      if (id.size() != 1 || number.size() != 1)
        refuse(lines.place(), "row", text, "a node and its values", {}, "ragged-row");
      rows.take(id[0], quantity, number[0], lines.place());
    }
  }
  return rows.finish();
}

}  // namespace clackers::input
