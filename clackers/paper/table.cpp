#include "clackers/paper/table.hpp"

#include <fmt/format.h>

#include "clackers/paper/catalogue.hpp"
#include "clackers/report/format.hpp"

namespace clackers::paper {
namespace {

// A text as RFC 4180 wants it.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

}  // namespace

void write_csv(const Figure& figure, std::ostream& out) {
  out << "panel,series,x_name,x,y_name,y\n";
  for (const auto& panel : figure.panels) {
    const bool rowed = figure.columns > 1 && !panel.note.empty();
    // Panels of one letter differ by their note.
    const auto name = quoted(rowed && !panel.label.empty() ? panel.label + " " + panel.note
                             : panel.label.empty()         ? panel.note
                                                           : panel.label);
    for (const auto& series : panel.series) {
      if (series.kind == Series::Kind::text) continue;
      const auto head = fmt::format("{},{},{}", name, quoted(series.name), quoted(panel.x.title));
      for (std::size_t i = 0; i < series.x.size(); ++i)
        out << head << ',' << report::exact_number(series.x[i]) << ',' << quoted(panel.y.title)
            << ',' << (series.y.empty() ? std::string() : report::exact_number(series.y[i]))
            << '\n';
    }
  }
}

const char* verdict_of(const Claim& claim) { return claim.holds ? "holds" : "differs"; }

study::Sheet claims_of(const std::vector<Figure>& figures) {
  study::Sheet sheet{"clackers/paper/1",
                     "The paper's claims and what was measured",
                     {{"figure", "", "name of the figure"},
                      {"verdict", "", "holds or differs"},
                      {"claim", "", "what the paper says, and where"},
                      {"measured", "", "what was found"}},
                     {}};
  for (const auto& figure : figures)
    for (const auto& claim : figure.claims)
      sheet.rows.push_back({figure.name, verdict_of(claim), claim.says, claim.measured});
  return sheet;
}

study::Sheet list_figures() {
  study::Sheet sheet{"clackers/figures/1",
                     "Figures that clackers paper draws",
                     {{"name", "", "for clackers paper NAME"}, {"title", "", "what it shows"}},
                     {}};
  for (const auto& entry : entries())
    sheet.rows.push_back({std::string(entry.name), std::string(entry.title)});
  return sheet;
}

}  // namespace clackers::paper
