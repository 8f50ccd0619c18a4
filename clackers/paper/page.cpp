#include "clackers/paper/page.hpp"

#include <fmt/format.h>

#include "clackers/paper/answers.hpp"
#include "clackers/paper/assets.hpp"
#include "clackers/paper/table.hpp"
#include "clackers/report/assets.hpp"
#include "clackers/report/markup.hpp"
#include "clackers/study/provenance.hpp"

namespace clackers::paper {
namespace {

using report::escape;

std::string label(const std::string& name) {
  if (name.starts_with("figA")) return "Figure A." + name.substr(4);
  if (name.starts_with("fig")) return "Figure " + name.substr(3);
  return "Validation";
}

std::string badge(const Claim& claim) {
  return fmt::format("<span class=\"badge {0}\">{0}</span>", verdict_of(claim));
}

std::string picture(const Drawn& drawn) {
  if (drawn.svg.empty())
    return "<p class=\"notice\">This figure could not be drawn; its numbers stand in the csv "
           "file.</p>";
  return fmt::format("<img alt=\"{}\" src=\"data:image/svg+xml;base64,{}\">",
                     escape(drawn.figure.title), base64(drawn.svg));
}

std::string claims(const std::vector<Claim>& list) {
  if (list.empty()) return {};
  std::string rows;
  for (const auto& claim : list)
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>\n",
                        escape(claim.says), escape(claim.measured), badge(claim));
  return "<div class=\"scroll\"><table class=\"claims\"><thead><tr><th scope=\"col\">the paper "
         "says</th>"
         "<th scope=\"col\">measured</th><th scope=\"col\">verdict</th></tr></thead><tbody>\n" +
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
  std::size_t holding = 0, differing = 0;
  for (const auto& one : drawn)
    for (const auto& claim : one.figure.claims) ++(claim.holds ? holding : differing);
  auto out = fmt::format("<span class=\"badge holds\">holds</span> {} of {} claims", holding,
                         holding + differing);
  if (differing > 0)
    out += fmt::format(" <span class=\"badge differs\">differs</span> {}", differing);
  return out;
}

std::string open_points() {
  std::string out;
  for (const auto& [question, answer, proof] : answers()) {
    out += fmt::format("<div class=\"answer\"><h3>{}</h3><p>{}</p><div class=\"proof\">",
                       escape(question), escape(answer));
    for (const auto& paragraph : proof) out += "<p>" + escape(paragraph) + "</p>";
    out += "</div></div>\n";
  }
  return out;
}

}  // namespace

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto part = bytes.substr(i, 3);
    unsigned word = 0;
    for (std::size_t j = 0; j < 3; ++j)
      word = word << 8 | (j < part.size() ? static_cast<unsigned char>(part[j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j)
      out += j <= part.size() ? digits[word >> (18 - 6 * j) & 63] : '=';
  }
  return out;
}

std::string page(const std::vector<Drawn>& drawn, const std::string& command) {
  std::string contents, figures;
  for (const auto& one : drawn) {
    contents += fmt::format("<a href=\"#{}\">{}</a>\n", one.figure.name, label(one.figure.name));
    figures += section(one);
  }
  const auto from = study::provenance(command);
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
