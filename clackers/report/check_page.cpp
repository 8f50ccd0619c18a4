#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "clackers/report/assets.hpp"
#include "clackers/report/check_html.hpp"
#include "clackers/report/check_report.hpp"
#include "clackers/report/check_study.hpp"
#include "clackers/report/digest.hpp"
#include "clackers/report/figure_data.hpp"
#include "clackers/report/html_frame.hpp"
#include "clackers/report/html_page.hpp"
#include "clackers/report/html_parts.hpp"
#include "clackers/report/markup.hpp"

namespace clackers::report {
namespace {

using Json = nlohmann::ordered_json;

bool has_convergence(const study::CheckRecord& record) {
  std::size_t drawable = 0;
  for (const auto& file : record.files)
    drawable += file.score.u_error > 0.0 && std::isfinite(file.score.u_error) ? 1 : 0;
  return drawable > 1;
}

bool has_errors(const study::CheckRecord& record) {
  return !record.files.back().error_history.t.empty();
}

// The rows of the finest history as the response is drawn: a series a mass.
Json history_rows(const study::CheckRecord& record) {
  study::Record rows;
  rows.response = record.files.back().history;
  return figure_data(rows)["response"];
}

Json specifications(const study::Record& study, const study::CheckRecord& record) {
  const auto all = figure_specifications(study);
  Json out;
  out["response"] = all["response"];
  out["response"]["layer"].push_back(Json::parse(assets::history_rows_vl_json));
  if (has_errors(record)) out["history"] = all["history"];
  if (has_convergence(record)) out["convergence"] = all["convergence"];
  return out;
}

std::string figures(const study::CheckRecord& record) {
  const auto& finest = record.files.back();
  int number = 1;
  auto out = figure(
      number++,
      {"response", "history_rows", "The history over the exact response",
       fmt::format("Displacement u of each mass in metres against time in seconds: exact motion as "
                   "lines, rows of {} as dots.",
                   escape(finest.file)),
       "Where dots leave their line the history is wrong; where they are late or early by the same "
       "amount, only its clock is. Triangles mark the exact collisions. Of a long history the "
       "lowest and highest row of every stretch are shown. Drag to move, pinch or hold Ctrl and "
       "turn the wheel to zoom.",
       response_legend(record.response.y.size(), !record.problem.impact_times.empty(), true)});
  if (has_errors(record))
    out +=
        figure(number++,
               {"history", "history", "Error against time",
                "Displacement error of the finest history divided by the initial envelope of the "
                "mass against time in seconds. The error axis is logarithmic.",
                "Steps up at collisions are errors that collisions bring in; the downward spikes "
                "are changes of sign; a level line may be the printed digits.",
                mass_choice(record.response.y.size())});
  if (has_convergence(record))
    out += figure(number++,
                  {"convergence",
                   "runs",
                   "Convergence",
                   "Largest displacement error over both masses and all rows of a history, divided "
                   "by the initial envelope of the mass, against the step h in seconds. Both axes "
                   "are logarithmic.",
                   "A method of order p follows a straight line as steep as the side of the "
                   "triangle with p beside it. A line that levels out is a floor.",
                   {}});
  return out;
}

std::string overall(const study::CheckRecord& record) {
  const auto code = record.reason.empty()
                        ? ""
                        : fmt::format(" <span class=\"code\">[{}]</span>", escape(record.reason));
  return fmt::format("<p class=\"overall\">{} <span>{}{}</span></p>\n",
                     badge(std::string(to_string(record.verdict))), escape(record.sentence), code);
}

}  // namespace

std::string check_html(const study::CheckRecord& record) {
  const auto study = as_study(record);
  Page page{
      .command = "check",
      .title = fmt::format("clackers: {}, {}", to_string(record.verdict), record.files.back().file),
      .heading = escape(case_text(record.problem, "\u00a0")),
      .lead = lead_html(record.problem),
      .overall = overall(record),
      .sections = {{"histories", "Histories", "Histories", histories_html(record)},
                   figures_section(figures(record)),
                   {"metrics", "Metrics", "Metrics of the finest history", metrics_html(record)},
                   {"case", "Case", "The case", case_html(record.problem)},
                   {"again", "Run again", "Run it again", again_html(record.provenance)}},
      .data = figure_data(study),
      .specifications = specifications(study, record),
  };
  page.data["history_rows"] = history_rows(record);
  return page_html(page, record.provenance);
}

}  // namespace clackers::report
