#include "clackers/report/html_metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "clackers/assess/metrics/metric.hpp"
#include "clackers/report/html_parts.hpp"
#include "clackers/report/markup.hpp"
#include "clackers/study/cause_metrics.hpp"

namespace clackers::report {
namespace {

// A record of another version may know metrics that this one does not.
std::string definition_of(const std::string& name) {
  const auto told = [&](const auto& row) {
    const auto source =
        row.source == "common" ? "" : fmt::format(" <small>{}</small>", escape(row.source));
    return escape(row.definition) + source;
  };
  for (const auto& row : assess::metrics())
    if (row.name == name) return told(row);
  for (const auto& row : study::cause_metrics())
    if (row.name == name) return told(row);
  return "–";
}

std::string row_of(const study::MetricResult& metric) {
  std::string masses;
  for (const double value : metric.masses)
    masses += (masses.empty() ? "" : ", ") + html_scientific(value, 2);
  return fmt::format(
      "<tr><th scope=\"row\"><code>{}</code>{}</th><td class=\"number\">{}</td><td "
      "class=\"number\">{}</td><td>{}</td><td>{}</td></tr>\n",
      escape(metric.name), metric.across_jumps ? "" : " *", html_scientific(metric.value, 2),
      masses.empty() ? "–" : masses, escape(metric.unit), definition_of(metric.name));
}

// Each reason once, with the metrics it holds for.
std::string not_measured(std::span<const study::MetricResult> metrics) {
  std::vector<std::pair<std::string, std::string>> reasons;
  for (const auto& metric : metrics) {
    if (metric.reason.empty()) continue;
    const auto name = fmt::format("<code>{}</code>", escape(metric.name));
    const auto known =
        std::ranges::find(reasons, metric.reason, &std::pair<std::string, std::string>::first);
    if (known == reasons.end())
      reasons.emplace_back(metric.reason, name);
    else
      known->second += ", " + name;
  }
  std::string out;
  for (const auto& [reason, names] : reasons)
    out += fmt::format("<p>{} Not measured: {}.</p>\n", escape(reason), names);
  return out;
}

}  // namespace

std::string metrics_table(std::span<const study::MetricResult> metrics, std::string_view of) {
  const auto label = of.empty() ? "Metrics" : fmt::format("Metrics of {}", escape(of));
  std::string out = fmt::format(
      "<div class=\"scroll\" role=\"region\" aria-label=\"{}\" tabindex=\"0\"><table>\n"
      "<caption>In definitions an asterisk marks the exact motion; U and V are the initial "
      "envelopes. A metric marked * need not vanish as a method converges, since velocities "
      "jump.</caption>\n<thead><tr><th scope=\"col\">Metric</th><th scope=\"col\" "
      "class=\"number\">Value</th><th scope=\"col\" class=\"number\">Mass by mass</th><th "
      "scope=\"col\">Unit</th><th scope=\"col\">Definition</th></tr></thead>\n<tbody>\n",
      label);
  for (const auto& metric : metrics)
    if (metric.reason.empty()) out += row_of(metric);
  return out + "</tbody>\n</table></div>\n" + not_measured(metrics);
}

std::string metrics_html(const study::MethodResult& method) {
  if (method.ladder.empty()) return {};
  if (method.metrics.empty())
    return fmt::format(
        "<p>Metrics were not measured: the run of the finest level with fewer than {} steps did "
        "not reach its end, or there is none.</p>\n",
        html_count(study::most_metric_rows));
  return fmt::format("<details class=\"metrics\"><summary>All {} metrics at h = {} s</summary>\n",
                     method.metrics.size(), html_number(method.metrics_step, 4)) +
         metrics_table(method.metrics, method.name) + "</details>\n";
}

}  // namespace clackers::report
