#include "paper/rendering/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <regex>
#include <string_view>

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

// The class is the last word of the verdict.
std::string badge(std::string_view verdict) {
  return fmt::format("<span class=\"badge {}\">{}</span>", verdict.substr(verdict.rfind(' ') + 1),
                     verdict);
}

// Escaped, with each number (none of the escapes, "&#39;") and its unit, or "N = 1", on one line.
std::string unbroken(const std::string& text) {
  static const std::regex number(
      R"((^|[^#\d])((\S+ = )?(-|−)?\d[\d.]*(e[-+]?\d+)?,?( (rad/s|m/s|m s|kg m|per s|N/m|kg|m|s|%)(?![\w/]))?))");
  return std::regex_replace(escape(text), number, "$1<span class=\"n\">$2</span>");
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
  for (const auto& claim : list) {
    const auto condition =
        claim.condition.empty()
            ? ""
            : fmt::format("<small>{}{}</small>",
                          claim.verdict == Verdict::holds_where ? "where " : "because ",
                          unbroken(claim.condition));
    rows += fmt::format(
        "<tr id=\"{}\"><th scope=\"row\"><small>{}</small>{}</th><td>{}</td><td>{}{}</td></tr>\n",
        claim.name, claim.section, escape(claim.says), badge(verdict_of(claim)), condition,
        unbroken(claim.measured));
  }
  return "<table class=\"claims\"><thead><tr><th scope=\"col\">the paper says</th><th scope=\"col\">verdict</th><th scope=\"col\">measured</th></tr></thead><tbody>\n" +
         rows + "</tbody></table>\n";
}

// Every claim with its verdict, by section of the paper.
std::string contents_of_claims(const std::vector<Drawn>& drawn) {
  std::vector<const Claim*> all;
  for (const auto& item : drawn)
    for (const auto& claim : item.figure.claims) all.push_back(&claim);
  std::ranges::sort(all, {}, &Claim::order);
  std::string out, section;
  for (const auto* claim : all) {
    if (claim->section != section)
      out += fmt::format("{}<h3>{}</h3>\n<ul class=\"contents\">\n", out.empty() ? "" : "</ul>\n",
                         claim->section);
    section = claim->section;
    out += fmt::format("<li><a href=\"#{}\">{}</a> {}</li>\n", claim->name, escape(claim->says),
                       badge(verdict_of(*claim)));
  }
  return out.empty() ? out : out + "</ul>\n";
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
  std::map<Verdict, std::pair<const char*, int>> counts;
  int all = 0;
  for (const auto& item : drawn)
    for (const auto& claim : item.figure.claims) {
      auto& [words, count] = counts[claim.verdict];
      words = verdict_of(claim);
      ++count, ++all;
    }
  auto out = fmt::format("Of {} claims", all);
  for (const auto& [verdict, counted] : counts)
    out += fmt::format(" {} {}", counted.second, badge(counted.first));
  return out;
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
                                          {"claims", contents_of_claims(drawn)},
                                          {"figures", figures},
                                          {"answers", std::string(assets::open_points_html)},
                                          {"command", escape(command)}});
}

}  // namespace clackers::paper
