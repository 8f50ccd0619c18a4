#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "clackers/report/assets.hpp"
#include "clackers/report/digest.hpp"
#include "clackers/report/figure_data.hpp"
#include "clackers/report/html_parts.hpp"
#include "clackers/report/markup.hpp"
#include "clackers/report/write.hpp"

namespace clackers::report {

std::string html(const study::Record& record, const study::BaselineComparison* changes) {
  const auto& problem = record.problem;
  const auto& from = record.provenance;
  const auto lead =
      fmt::format("{} {} s with {} collisions; fast period {} s. {}.", escape(problem.summary),
                  html_number(problem.end, 6), html_count(problem.impact_count),
                  html_number(problem.fast_period, 4), escape(ladder_text(record)));
  return fill(assets::page_html,
              {{"title", escape("clackers: " + closing(record).word + ", " + case_text(problem))},
               {"heading", escape(case_text(problem, "\u00a0"))},
               {"lead", lead},
               {"version", escape(from.version)},
               {"date", escape(from.date)},
               {"style", std::string(assets::page_css)},
               {"overall", overall_html(record)},
               {"verdicts", verdicts_html(record)},
               {"changes", changes == nullptr ? "" : changes_html(record, *changes)},
               {"changes_link", changes == nullptr ? "" : "<a href=\"#changes\">Changes</a>"},
               {"figures", figures_html(record)},
               {"methods", methods_html(record)},
               {"case", case_html(problem)},
               {"again", again_html(from)},
               {"licences", escape(assets::licences)},
               {"data", script_json(figure_data(record))},
               {"specifications", script_json(figure_specifications(record))},
               {"vega", std::string(assets::vega_min_js)},
               {"vega_lite", std::string(assets::vega_lite_min_js)},
               {"vega_embed", std::string(assets::vega_embed_min_js)},
               {"figures_script", std::string(assets::figures_js)},
               {"page_script", std::string(assets::page_js)}});
}

}  // namespace clackers::report
