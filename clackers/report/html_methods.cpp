#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/report/digest.hpp"
#include "clackers/report/html_parts.hpp"
#include "clackers/report/look.hpp"
#include "clackers/report/markup.hpp"

namespace clackers::report {
namespace {

std::string fact(std::string_view name, const std::string& html) {
  return html.empty() ? html : fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, html);
}

std::string order_of(const assess::LadderFit& fit) {
  if (!fit.has_line) return {};
  return fmt::format("{}{}, levels {} to {}", escape(order_text(fit, "\u202f")),
                     fit.on_envelope ? " of the upper envelope" : "", fit.first_level + 1,
                     fit.last_level + 1);
}

std::string level_row(const assess::Level& level, std::size_t number, double fast_period) {
  study::MethodResult alone;
  alone.ladder = {level};
  const auto d = digest(alone);
  const auto failed = d.failed_runs == 0 ? "" : fmt::format(" ({} failed)", d.failed_runs);
  const bool matched = d.impacts && d.impacts->matched > 0;
  return fmt::format(
      "<tr><th scope=\"row\" class=\"number\">{}</th><td class=\"number\">{}</td><td "
      "class=\"number\">{}"
      "</td><td class=\"number\">{}{}</td><td class=\"number\">{}</td><td "
      "class=\"number\">{}</td><td "
      "class=\"number\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td "
      "class=\"number\">{}</td></tr>\n",
      number, html_number(level.step, 4), html_number(fast_period / level.step, 4), d.runs, failed,
      html_scientific(d.u_error, 2), html_scientific(d.v_error, 2),
      d.impacts ? fmt::format("{}\u202f/\u202f{}", d.impacts->found, d.impacts->expected) : "–",
      matched ? html_scientific(d.impacts->worst_time_error, 2) : "–",
      html_scientific(d.energy_error, 2), html_count(d.force_evaluations));
}

std::string ladder_table(const study::MethodResult& method, double fast_period) {
  if (method.ladder.empty()) return {};
  std::string out = fmt::format(
      "<div class=\"scroll\" role=\"region\" aria-label=\"Levels of {0}\" tabindex=\"0\"><table>\n"
      "<caption>Levels of {0}; the worst of the neighbouring steps of each.</caption>\n<thead><tr>",
      escape(method.name));
  for (const auto heading : {"Level", "Step h [s]", "Steps per fast period", "Runs", "Error in u",
                             "Error in v, L1", "Collisions found / exact",
                             "Collision-time error [s]", "Energy error", "Force evaluations"})
    out += fmt::format("<th scope=\"col\" class=\"number\">{}</th>", heading);
  out += "</tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < method.ladder.size(); ++i)
    out += level_row(method.ladder[i], i + 1, fast_period);
  return out + "</tbody>\n</table></div>\n";
}

// The failures of a method's runs, each sentence once.
std::string failures(const study::MethodResult& method) {
  std::string first;
  long long count = 0;
  for (const auto& level : method.ladder)
    for (const auto& run : level.runs)
      if (!run.finished && count++ == 0)
        first = fmt::format("{} <span class=\"code\">[{}]</span>", escape(run.failure),
                            escape(run.failure_code));
  return count == 0 ? "" : fmt::format("{} runs; the first: {}", count, first);
}

std::string section(const study::MethodResult& method, std::size_t index, double fast_period) {
  const auto said = remark(method);
  const auto& assessment = method.assessment;
  const bool judged = method.refusal.empty();
  std::string out = fmt::format(
      "<article class=\"method\" id=\"{0}\" aria-labelledby=\"{0}-title\"><h3 "
      "id=\"{0}-title\">{1}{2} {3}</h3>\n<p class=\"back\"><a href=\"#verdicts\">Back to "
      "the verdicts</a></p>\n",
      anchor(index), key_svg(look(index)), escape(method.name), badge(verdict_word(method)));
  if (said)
    out += fmt::format("<p>{} <span class=\"code\">[{}]</span></p>\n", escape(said->sentence),
                       escape(said->code));
  else if (!assessment.sentence.empty())
    out += fmt::format("<p>{}</p>\n", escape(assessment.sentence));
  out += "<dl>\n" + fact("Claimed", escape(claim_text(method.claim)));
  if (judged && !method.ladder.empty()) {
    const auto& fit = assessment.displacement;
    out += fact("Found", escape(to_string(fit.behaviour)));
    out += fact("Order in u", order_of(fit));
    out += fact("Order in v", order_of(assessment.velocity));
    out += fact("Order in collision time", order_of(assessment.impact_time));
    if (fit.has_line && fit.scatter > 1.0)
      out += fact("Scatter",
                  fmt::format("factor {} between runs and line", html_number(fit.scatter, 3)));
    if (fit.floor > 0.0) out += fact("Floor in u", html_scientific(fit.floor, 2));
  }
  if (method.contact_time > 0.0)
    out += fact("Contact time", html_number(method.contact_time, 3) + " s");
  out += fact("Failed runs", failures(method));
  out += "</dl>\n" + ladder_table(method, fast_period);
  return out + self_html(method) + metrics_html(method) + "</article>\n";
}

std::string quantities(const std::string& caption, const std::vector<study::Quantity>& rows) {
  if (rows.empty()) return {};
  auto out = fmt::format(
      "<div class=\"scroll\" role=\"region\" aria-label=\"{0}\" tabindex=\"0\"><table><caption>{0}"
      "</caption>\n<thead><tr><th scope=\"col\">Name</th><th scope=\"col\" "
      "class=\"number\">Value</th>"
      "<th scope=\"col\">Unit</th><th scope=\"col\">Meaning</th></tr></thead>\n<tbody>\n",
      caption);
  for (const auto& row : rows)
    out += fmt::format(
        "<tr><th scope=\"row\"><code>{}</code></th><td "
        "class=\"number\">{}</td><td>{}</td><td>{}</td>"
        "</tr>\n",
        escape(row.name), html_number(row.value, 10), escape(row.unit), escape(row.meaning));
  return out + "</tbody></table></div>\n";
}

}  // namespace

std::string methods_html(const study::Record& record) {
  std::string out;
  for (std::size_t i = 0; i < record.methods.size(); ++i)
    out += section(record.methods[i], i, record.problem.fast_period);
  return out;
}

std::string lead_html(const study::CaseSummary& problem) {
  return fmt::format("{} {} s with {} collisions; fast period {} s.", escape(problem.summary),
                     html_number(problem.end, 6), html_count(problem.impact_count),
                     html_number(problem.fast_period, 4));
}

std::string case_html(const study::CaseSummary& problem) {
  return fmt::format("<p><strong>{}</strong>, {}: {}</p>\n", escape(problem.name),
                     escape(problem.equations), escape(problem.summary)) +
         quantities("Parameters", problem.parameters) +
         quantities("Derived constants", problem.constants);
}

std::string again_html(const study::Provenance& provenance) {
  std::string out = fmt::format(
      "<div class=\"command\"><pre id=\"command\">{}</pre><button type=\"button\" "
      "data-copy=\"command\">Copy</button></div>\n<dl class=\"facts\">\n",
      escape(provenance.command));
  out += fact("clackers", escape(provenance.version));
  out += fact("Compiler", escape(provenance.compiler));
  out += fact("Machine", escape(provenance.machine));
  out += fact("Processor", escape(provenance.processor));
  out += fact("Date", fmt::format("<time datetime=\"{0}\">{0}</time>", escape(provenance.date)));
  return out + "</dl>\n";
}

}  // namespace clackers::report
