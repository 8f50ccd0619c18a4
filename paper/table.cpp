#include "paper/catalogue.hpp"

#include "clackers/report/write.hpp"

namespace clackers::paper {

void write_csv(const Figure& figure, std::ostream& out) {
  record::Sheet sheet;
  for (const auto* name : {"panel", "series", "x_name", "x", "y_name", "y"})
    sheet.columns.push_back({name, "", ""});
  for (const auto& panel : figure.panels) {
    const bool several = figure.columns > 1 && !panel.note.empty();
    // Panels of one letter differ by their note.
    const auto name = several && !panel.label.empty() ? panel.label + " " + panel.note
                      : panel.label.empty()           ? panel.note
                                                      : panel.label;
    for (const auto& series : panel.series) {
      if (series.kind == Series::Kind::text) continue;
      for (std::size_t i = 0; i < series.x.size(); ++i)
        sheet.rows.push_back({name, series.name, panel.x.title, series.x[i], panel.y.title,
                              series.y.empty() ? record::Cell() : record::Cell(series.y[i])});
    }
  }
  record::SheetRows rows(sheet);
  report::write(rows, report::Format::csv, out);
}

const char* verdict_of(const Claim& claim) {
  return !claim.holds ? "differs" : claim.in_part ? "holds in part" : "holds";
}

record::Sheet claims_of(const std::vector<Figure>& figures) {
  record::Sheet sheet{"paper/1",
                      "The paper's claims and what was measured",
                      {{"figure", "", "name of the figure"},
                       {"verdict", "", "holds, holds in part, or differs"},
                       {"claim", "", "what the paper says, and where"},
                       {"measured", "", "what was found"}},
                      {}};
  for (const auto& figure : figures)
    for (const auto& claim : figure.claims)
      sheet.rows.push_back({figure.name, verdict_of(claim), claim.says, claim.measured});
  return sheet;
}

record::Sheet list_figures() {
  record::Sheet sheet{"clackers/figures/1",
                      "Figures that clackers paper draws",
                      {{"name", "", "for clackers paper NAME"}, {"title", "", "what it shows"}},
                      {}};
  for (const auto& entry : entries())
    sheet.rows.push_back({std::string(entry.name), std::string(entry.title)});
  return sheet;
}

}  // namespace clackers::paper
