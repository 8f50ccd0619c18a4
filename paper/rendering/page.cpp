#include "paper/rendering/page.hpp"

#include <fmt/format.h>

#include <cctype>
#include <map>
#include <string_view>

#include "clackers/cases/case.hpp"
#include "clackers/exact/quantities/quantities.hpp"
#include "clackers/record/record.hpp"
#include "clackers/report/assets.hpp"
#include "clackers/report/markup.hpp"
#include "paper/catalogue.hpp"
#include "paper/rendering/assets.hpp"

namespace clackers::paper {
namespace {

using report::escape;

std::string label(const std::string& name) {
  if (name.starts_with("figA")) return "Figure A." + name.substr(4);
  if (name.starts_with("fig")) return "Figure " + name.substr(3);
  return "Validation";
}

// The class is the first word.
std::string badge(std::string_view verdict) {
  return fmt::format("<span class=\"badge {}\">{}</span>", verdict.substr(0, verdict.find(' ')),
                     verdict);
}

// Percent-encoded, as a data address asks.
std::string encoded(std::string_view text) {
  constexpr std::string_view kept = "-._~,:;=/() ";
  std::string out;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) || kept.find(c) != kept.npos)
      out += c;
    else
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return out;
}

std::string picture(const Drawn& drawn) {
  if (drawn.svg.empty())
    return "<p class=\"notice\">This figure could not be drawn; its numbers are in the csv file.</p>";
  return fmt::format("<img alt=\"{}\" src=\"data:image/svg+xml,{}\">", escape(drawn.figure.title),
                     encoded(drawn.svg));
}

std::string claims(const std::vector<Claim>& list) {
  if (list.empty()) return {};
  std::string rows;
  for (const auto& claim : list)
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>\n",
                        escape(claim.says), escape(claim.measured), badge(verdict_of(claim)));
  return "<div class=\"scroll\"><table class=\"claims\"><thead><tr><th scope=\"col\">the paper says</th><th scope=\"col\">measured</th><th scope=\"col\">verdict</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>\n";
}

std::string choices(const std::vector<std::string>& list) {
  std::string out;
  for (const auto& choice : list) out += "<p class=\"choices\">" + escape(choice) + "</p>\n";
  return out;
}

std::string links(const std::vector<std::string>& files) {
  std::string out = "<p class=\"files\">";
  for (const auto& file : files) out += fmt::format("<a href=\"{0}\">{0}</a> ", escape(file));
  return out + "</p>\n";
}

std::string section(const Drawn& drawn) {
  const auto& figure = drawn.figure;
  return fmt::format(
      "<section class=\"paper-figure\" id=\"{0}\" aria-labelledby=\"{0}-title\">\n"
      "<h2 id=\"{0}-title\">{1}. {2}</h2>\n<figure>{3}<figcaption>{4}</figcaption></figure>\n"
      "{5}{6}{7}</section>\n",
      figure.name, label(figure.name), escape(figure.title), picture(drawn), escape(figure.caption),
      claims(figure.claims), choices(figure.choices), links(drawn.files));
}

std::string overall(const std::vector<Drawn>& drawn) {
  std::map<std::string_view, int> counts;
  int all = 0;
  for (const auto& item : drawn)
    for (const auto& claim : item.figure.claims) ++counts[verdict_of(claim)], ++all;
  auto out = fmt::format("{} {} of {} claims", badge("holds"), counts["holds"], all);
  for (const auto* verdict : {"holds in part", "differs"})
    if (counts[verdict] > 0) out += fmt::format(" {} {}", badge(verdict), counts[verdict]);
  return out;
}

// I_ms and T_L / T_S of the paper's system for some N, as words.
std::string ratios(double threshold) {
  std::string out;
  for (const int N : {0, 1, 2, 5, 10, 20}) {
    const double X = 4.0 * N + 1.0;
    const auto found = exact::indicators(X, 1.0, 20.0, threshold);
    out += fmt::format("{}N = {}: {:.0f} {} {:.0f}", out.empty() ? "" : ", ", N, X,
                       found.bound_holds ? "≥" : "&lt;", found.highest_harmonic);
  }
  return out;
}

std::string open_points() {
  std::string limits;
  for (const double X : {5.0, 9.0, 21.0, 41.0, 81.0})
    limits +=
        fmt::format("{}{:.4f}", limits.empty() ? "" : ", ", cases::admissibility(X, 3.0).r_star);
  return report::fill(
      assets::open_points_html,
      {{"ratios", ratios(0.1)}, {"ratios-fine", ratios(0.001)}, {"limits", limits}});
}

}  // namespace

std::string page(const std::vector<Drawn>& drawn, const std::string& command) {
  std::string contents, figures;
  for (const auto& item : drawn) {
    contents += fmt::format("<a href=\"#{}\">{}</a>\n", item.figure.name, label(item.figure.name));
    figures += section(item);
  }
  const auto from = record::provenance(command);
  return report::fill(assets::page_html, {{"version", escape(from.version)},
                                          {"date", escape(from.date)},
                                          {"style", std::string(report::assets::page_css) +
                                                        std::string(assets::paper_css)},
                                          {"overall", overall(drawn)},
                                          {"contents", contents},
                                          {"figures", figures},
                                          {"answers", open_points()},
                                          {"command", escape(command)}});
}

}  // namespace clackers::paper
