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
  constexpr const char* words[] = {"holds", "holds where", "does not hold", "not measurable"};
  return words[std::size_t(claim.verdict)];
}

record::Sheet claims_of(const std::vector<Figure>& figures, bool for_people) {
  record::Sheet sheet{"clackers/paper/1",
                      "The paper's claims and what was measured",
                      {{"claim", "", "name of the claim"},
                       {"section", "", "of the paper"},
                       {"figure", "", "name of the figure beside which it stands"},
                       {"verdict", "", "holds, holds where, does not hold, or not measurable"},
                       {"says", "", "what the paper says"},
                       {"condition", "", "where it holds, or because of what it is not measurable"},
                       {"measured", "", "what was found"}},
                      {}};
  for (const auto& figure : figures)
    for (const auto& claim : figure.claims)
      sheet.rows.push_back({claim.name, claim.section, figure.name, verdict_of(claim), claim.says,
                            claim.condition, claim.measured});
  if (!for_people) return sheet;
  // 80 columns hold the verdict, the sentence, and what was found under its condition.
  for (auto& row : sheet.rows) {
    auto &condition = std::get<std::string>(row[5]), &measured = std::get<std::string>(row[6]);
    const auto* word = row[3] == record::Cell("holds where") ? "Where " : "Because ";
    if (!condition.empty())
      measured = word + condition + (measured.empty() ? "." : ". ") + measured;
    row = {row[0], row[3], row[4], row[6]};
  }
  sheet.columns = {sheet.columns[0], sheet.columns[3], sheet.columns[4], sheet.columns[6]};
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
