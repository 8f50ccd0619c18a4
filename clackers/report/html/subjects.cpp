#include "clackers/report/html/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/codes.hpp"
#include "clackers/measure/metrics/metric.hpp"
#include "clackers/report/assets.hpp"
#include "clackers/report/html/plot_style.hpp"
#include "clackers/report/markup.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

std::string order_html(const judge::LadderFit& fit) {
  if (!fit.has_line) return {};
  return fmt::format("{}{}, levels {} to {}", escape(order_text(fit, "\u202f")),
                     fit.on_envelope ? " of the upper envelope" : "", fit.first_level + 1,
                     fit.last_level + 1);
}

// The failed runs, with the sentence of the first.
std::string failures_html(const record::Subject& subject) {
  Finding first;
  long long count = 0;
  for (const auto& level : subject.levels)
    for (const auto& run : level.runs)
      if (!run.score.finished && count++ == 0) first = {run.score.failure, run.score.failure_code};
  return count == 0 ? ""
                    : fmt::format("{}; the first: {}", counted(count, "run"), finding_html(first));
}

std::string facts_html(const record::Subject& subject) {
  const auto& assessment = subject.assessment;
  const auto& displacement = assessment.displacement;
  std::string out = fact("Claimed", escape(claim_text(subject.claim)));
  if (!subject.labels.empty()) out += fact("Labels", escape(record::labels_text(subject.labels)));
  if (subject.tolerance) out += fact("Allowed error in u", html_number(*subject.tolerance, 3));
  if (subject.refusal.empty() && !subject.levels.empty()) {
    out += fact("Found", escape(to_string(displacement.behaviour)));
    out += fact("Order in u", order_html(displacement));
    out += fact("Order in v", order_html(assessment.velocity));
    out += fact("Order in impact time", order_html(assessment.impact_time));
    if (displacement.has_line && displacement.scatter > 1.0)
      out += fact("Scatter", fmt::format("factor {} between runs and line",
                                         html_number(displacement.scatter, 3)));
    if (displacement.floor > 0.0) out += fact("Floor in u", html_scientific(displacement.floor, 2));
  }
  if (subject.contact_time > 0.0)
    out += fact("Contact time", html_number(subject.contact_time, 3) + " s");
  return out + fact("Failed runs", failures_html(subject));
}

std::string levels_html(const record::CaseRecord& problem, const record::Subject& subject) {
  if (subject.levels.empty()) return {};
  const auto text = "Levels of " + subject.name;
  return html_table(text, text + "; of each the worst of its runs.", level_table(problem, subject),
                    [](const Row& row) { return fmt::format("{}", row.level); });
}

std::string extrapolation_html(const record::SelfResult& result) {
  const auto& found = result.extrapolation;
  if (!found.bounded) {
    const auto* code = find_code(found.reason);
    return "no bound. " +
           finding_html({code == nullptr ? "" : std::string(code->meaning), found.reason});
  }
  std::string values;
  for (const double value : found.value)
    values += (values.empty() ? "" : ", ") + html_number(value, 10);
  return fmt::format(
      "u / largest envelope at the end = {}, within {} of the limit of the runs; the error is {}{}",
      values, html_scientific(found.bound), html_scientific(result.extrapolation_error),
      result.extrapolation_error > found.bound ? ": the limit is not the reference solution" : "");
}

std::string self_html(const record::Subject& subject) {
  if (subject.levels.empty() || subject.kind == record::SubjectKind::histories) return {};
  std::string warning, findings, facts;
  if (subject.self_convergence) {
    const auto& result = *subject.self_convergence;
    if (const auto found = false_convergence(subject))
      warning = fmt::format("<p class=\"notice\" role=\"note\">{}</p>\n", finding_html(*found));
    findings = escape(self_convergence_text(result));
    facts = fact("Order claimed", html_number(result.order, 3));
    const double ratio = result.against_reference.error_ratio;
    if (!std::isnan(ratio))
      facts +=
          fact("Error over its estimate", html_number(ratio, 3) + " at the finest pair of runs");
    facts += fact("Extrapolated", extrapolation_html(result));
  } else {
    findings = "Not assessed: the method claims no order to compare differences between runs with.";
  }
  return fill(assets::self_html, {{"warning", warning}, {"findings", findings}, {"facts", facts}});
}

// A record of another version may have metrics that this one does not know.
std::string definition_html(std::string_view name) {
  for (const auto& row : measure::metrics())
    if (row.name == name)
      return escape(row.definition) +
             (row.source == "common" ? "" : fmt::format(" <small>{}</small>", escape(row.source)));
  return "–";
}

// Each reason once, with the metrics it holds for.
std::string not_measured_html(const std::vector<record::MetricResult>& metrics) {
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

std::string metrics_html(const record::Subject& subject) {
  if (subject.levels.empty()) return {};
  const auto* run = subject.shown_run();
  if (run == nullptr || run->metrics.empty())
    return subject.kind == record::SubjectKind::method
               ? "<p>Metrics were not measured: no run that is short enough reached its end.</p>\n"
               : "<p>Metrics need the displacements of all masses, which the file does not "
                 "have.</p>\n";
  std::vector<std::vector<std::string>> rows;
  for (const auto& metric : run->metrics) {
    if (!metric.reason.empty()) continue;
    std::string masses;
    for (const double value : metric.masses)
      masses += (masses.empty() ? "" : ", ") + html_scientific(value, 2);
    rows.push_back(
        {fmt::format("<code>{}</code>{}", escape(metric.name), metric.across_jumps ? "" : " *"),
         html_scientific(metric.value, 2), masses.empty() ? "–" : masses,
         metric.unit == "1" ? "" : escape(metric.unit), definition_html(metric.name)});
  }
  const HtmlColumn columns[] = {{"Metric", {}},
                                {"Value", {}, true},
                                {"Mass by mass", {}, true},
                                {"Unit", {}},
                                {"Definition", {}}};
  const auto source = history_name(subject, *run);
  return fmt::format("<details class=\"metrics\"><summary>Metrics of {}</summary>\n",
                     escape(source)) +
         html_table("Metrics of " + source,
                    "In definitions an asterisk marks the exact motion; U and V are the largest "
                    "envelopes. A metric marked * need not vanish as a method converges, since "
                    "velocities jump.",
                    columns, rows) +
         not_measured_html(run->metrics) + "</details>\n";
}

std::string impacts_html(const record::Subject& subject) {
  if (subject.impacts.empty()) return {};
  return fmt::format("<details class=\"metrics\"><summary>Impacts</summary>\n{}</details>\n",
                     sheet_html(impact_sheet(subject)));
}

std::string text_html(const record::Subject& subject) {
  if (const auto found = finding(subject)) return fmt::format("<p>{}</p>\n", finding_html(*found));
  return fmt::format("<p>{}</p>\n", escape(assessment_text(subject)));
}

}  // namespace

std::string subjects_html(const record::CaseRecord& problem, const Place& place) {
  std::string out;
  for (std::size_t i = 0; i < problem.subjects.size(); ++i) {
    const auto& subject = problem.subjects[i];
    out += fill(assets::subject_html, {{"id", anchor(place, i)},
                                       {"key", key_svg(plot_style(i))},
                                       {"name", escape(subject.name)},
                                       {"verdict", badge(record::verdict_word(subject))},
                                       {"verdicts", "verdicts" + place.suffix},
                                       {"finding", text_html(subject)},
                                       {"facts", facts_html(subject)},
                                       {"levels", levels_html(problem, subject)},
                                       {"self", self_html(subject)},
                                       {"impacts", impacts_html(subject)},
                                       {"metrics", metrics_html(subject)}});
  }
  return out;
}

}  // namespace clackers::report
