#include <fmt/format.h>

#include <algorithm>

#include "clackers/report/digest.hpp"
#include "clackers/report/html_parts.hpp"
#include "clackers/report/look.hpp"
#include "clackers/report/markup.hpp"

namespace clackers::report {
namespace {

struct Heading {
  std::string_view label, detail;
  bool number;
};

constexpr Heading headings[] = {{"Verdict", "", false},
                                {"Behaviour", "and what is claimed", false},
                                {"Order", "± 95 %", true},
                                {"Error in u", "/ initial envelope", true},
                                {"Collisions", "found / exact", true},
                                {"Collision time", "worst error [s]", true},
                                {"Energy error", "/ initial energy", true},
                                {"Force evaluations", "and time of a run", true}};

std::string cell(std::size_t column, const std::string& html) {
  return fmt::format("<td role=\"cell\" data-label=\"{}\"{}><span>{}</span></td>",
                     headings[column].label, headings[column].number ? " class=\"number\"" : "",
                     html);
}

std::string collisions(const Digest& d) {
  if (!d.impacts) return "–";
  const auto text = fmt::format("{}\u202f/\u202f{}", d.impacts->found, d.impacts->expected);
  return d.impacts->missed + d.impacts->extra > 0 ? "<span class=\"wrong\">" + text + "</span>"
                                                  : text;
}

// "order 2" stays on one line.
std::string claimed(const Claim& claim) {
  auto text = escape(claim_text(claim, false));
  if (const auto at = text.find("order "); at != std::string::npos)
    text.replace(at, 6, "order\u00a0");
  return text;
}

std::string row(const study::MethodResult& method, std::size_t index) {
  const auto d = digest(method);
  const bool judged = method.refusal.empty() && d.runs > 0;
  const auto& fit = method.assessment.displacement;
  const auto order = judged ? escape(order_text(fit, "\u202f")) : "";
  std::string out = fmt::format(
      "<tr role=\"row\"><th scope=\"row\" role=\"rowheader\"><span class=\"named\">{}<a "
      "href=\"#{}\">{}</a></span></th>",
      key_svg(look(index)), anchor(index), breakable(escape(method.name)));
  std::size_t column = 0;
  const auto add = [&](const std::string& html) { out += cell(column++, html); };
  add(badge(verdict_word(method)));
  add(fmt::format("{}<small>claimed: {}</small>", judged ? escape(to_string(fit.behaviour)) : "–",
                  claimed(method.claim)));
  add(order.empty() ? "–" : order);
  add(html_scientific(d.u_error));
  add(collisions(d));
  add(d.impacts && d.impacts->matched > 0 ? html_scientific(d.impacts->worst_time_error) : "–");
  add(html_scientific(d.energy_error));
  add(d.runs > 0 ? fmt::format("{}<small>{} s</small>", html_count(d.force_evaluations),
                               html_number(d.seconds, 2))
                 : "–");
  return out + "</tr>\n";
}

std::string remarks(const study::Record& record) {
  std::string out;
  for (std::size_t i = 0; i < record.methods.size(); ++i)
    if (const auto said = remark(record.methods[i]))
      out += fmt::format("<li><a href=\"#{}\">{}</a>: {} <span class=\"code\">[{}]</span></li>\n",
                         anchor(i), escape(record.methods[i].name), escape(said->sentence),
                         escape(said->code));
  return out.empty() ? out : "<ul class=\"remarks\">\n" + out + "</ul>\n";
}

}  // namespace

std::string anchor(std::size_t method) { return fmt::format("method-{}", method + 1); }

std::string badge(const std::string& word) {
  auto style = word;
  std::ranges::replace(style, ' ', '-');
  return fmt::format("<span class=\"badge {}\">{}</span>", style, escape(word));
}

std::string overall_html(const study::Record& record) {
  const auto end = closing(record);
  auto out = fmt::format("<p class=\"overall\">{} <span>Of {}: {}.</span></p>\n", badge(end.word),
                         counted_methods(record), escape(end.sentence));
  if (record.interrupted)
    out +=
        "<p class=\"notice\" role=\"note\"><strong>Interrupted.</strong> The run was stopped "
        "before it "
        "was done; only what was finished is shown. <span "
        "class=\"code\">[interrupted]</span></p>\n";
  return out;
}

std::string verdicts_html(const study::Record& record) {
  std::string out =
      "<div class=\"scroll\" role=\"region\" aria-label=\"Verdict table\" tabindex=\"0\">\n"
      "<table class=\"verdicts\" role=\"table\">\n<caption>Of each method the worst of the finest "
      "level's "
      "neighbouring steps. A dash: not measured.</caption>\n<thead role=\"rowgroup\"><tr "
      "role=\"row\">"
      "<th scope=\"col\" role=\"columnheader\">Method</th>";
  for (const auto& [label, detail, number] : headings)
    out += fmt::format("<th scope=\"col\" role=\"columnheader\"{}>{}{}</th>",
                       number ? " class=\"number\"" : "", label,
                       detail.empty() ? "" : fmt::format(" <small>{}</small>", detail));
  out += "</tr></thead>\n<tbody role=\"rowgroup\">\n";
  for (std::size_t i = 0; i < record.methods.size(); ++i) out += row(record.methods[i], i);
  return out + "</tbody>\n</table>\n</div>\n" + remarks(record);
}

}  // namespace clackers::report
