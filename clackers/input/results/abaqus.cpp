#include <fmt/format.h>

#include <algorithm>

#include "clackers/base/error.hpp"
#include "clackers/input/results/result_reader.hpp"
#include "clackers/input/text/text_lines.hpp"

namespace clackers::input {
namespace {

// The field of a row that a name such as U1 heads; 0: none.
std::size_t column_of(const std::vector<std::string_view>& names, std::string_view letter,
                      int direction) {
  const auto found = std::ranges::find(names, fmt::format("{}{}", letter, direction));
  return found == names.end() ? 0 : std::size_t(found - names.begin()) + 1;
}

}  // namespace

// "... TOTAL TIME COMPLETED  1.00E-02", then tables below "NODE FOOT-   U1   V1" and "NOTE".
ResultRows read_abaqus_dat(InputFile file, const ResultChoice& choice) {
  constexpr std::string_view mark = "TOTAL TIME COMPLETED";
  TextLines lines(std::move(file));
  NodeRows rows(lines.name(), choice);
  std::vector<std::pair<std::size_t, char>> columns;  // field of a row and its quantity
  while (lines.next()) {
    const auto fields = fields_of(lines.text());
    if (const auto at = lines.text().find(mark); at != std::string_view::npos) {
      const auto behind = fields_of(lines.text().substr(at + mark.size()));
      if (!behind.empty()) rows.begin(number_of(behind[0], lines.place()));
      columns.clear();
    } else if (fields.size() > 2 && fields[0] == "NODE" && fields[1].starts_with("FOOT")) {
      columns.clear();
      const std::vector names(fields.begin() + 2, fields.end());
      const auto place = column_of(names, choice.coordinates ? "COOR" : "U", choice.direction);
      for (const auto& [field, quantity] : {std::pair{place, 'u'},
                                            {column_of(names, "V", choice.direction), 'v'},
                                            {column_of(names, "A", choice.direction), 'a'}})
        if (field > 0) columns.emplace_back(field, quantity);
    } else if (!columns.empty() && !fields.empty() && whole_number(fields[0])) {
      for (const auto& [field, quantity] : columns) {
        if (field >= fields.size())
          refuse(lines.place(), "row", lines.text(), "a value for each heading", {}, "ragged-row");
        rows.take(fields[0], quantity, fields[field], lines.place());
      }
    } else if (!fields.empty() && fields[0] != "NOTE") {
      columns.clear();
    }
  }
  return rows.finish();
}

}  // namespace clackers::input
