#include "clackers/report/html_frame.hpp"

#include <fmt/format.h>

#include "clackers/report/markup.hpp"

namespace clackers::report {

std::string figure(int number, const FigureText& text) {
  return fmt::format(
      R"(<figure class="figure" id="figure-{name}" aria-labelledby="figure-{name}-title">
<h3 id="figure-{name}-title">Figure {number}. {title}</h3>
<p class="caption">{caption}</p>
{choices}<div class="plot" data-plot="{name}" role="img" aria-label="{title}. {described}"></div>
<div class="tools" role="group" aria-label="Tools of figure {number}" data-tools="{name}" data-rows="{rows}"></div>
<figcaption class="reading"><strong>How to read.</strong> {reading}</figcaption>
</figure>
)",
      fmt::arg("name", text.name), fmt::arg("number", number), fmt::arg("title", text.title),
      fmt::arg("caption", text.caption), fmt::arg("choices", text.choices),
      fmt::arg("rows", text.rows), fmt::arg("reading", text.reading),
      fmt::arg("described", "The numbers stand in the tables of this page."));
}

std::string toggle(const std::string& series, const std::string& key, const std::string& text) {
  return fmt::format(
      "<button type=\"button\" data-series=\"{}\" aria-pressed=\"true\">{}{}</button>\n",
      escape(series), key, escape(text));
}

std::string response_legend(std::size_t masses, bool collisions, bool rows) {
  std::string out =
      "<div class=\"legend\" role=\"group\" aria-label=\"Shown in the response\" "
      "data-legend=\"response\">\n";
  for (std::size_t mass = 0; mass < masses; ++mass) {
    const auto name = fmt::format("mass {}", mass + 1);
    const auto key = fmt::format(
        "<svg class=\"key\" width=\"34\" height=\"12\" viewBox=\"-17 -6 34 12\" "
        "aria-hidden=\"true\" "
        "focusable=\"false\" style=\"color:var(--m{})\"><path d=\"M-17,0H17\" "
        "stroke=\"currentColor\" "
        "stroke-width=\"2\" stroke-dasharray=\"{}\"/></svg>",
        mass + 1, mass == 0 ? "1 0" : "5 2");
    out += toggle(name, key, name);
  }
  if (collisions)
    out += toggle("collisions",
                  "<svg class=\"key\" width=\"12\" height=\"12\" viewBox=\"-6 -6 12 12\" "
                  "aria-hidden=\"true\" focusable=\"false\" style=\"color:var(--collision)\"><path "
                  "d=\"M0,-5L5,4H-5Z\" fill=\"currentColor\"/></svg>",
                  "collisions");
  if (rows)
    out += toggle("history",
                  "<svg class=\"key\" width=\"12\" height=\"12\" viewBox=\"-6 -6 12 12\" "
                  "aria-hidden=\"true\" focusable=\"false\"><circle r=\"3\" fill=\"currentColor\"/>"
                  "</svg>",
                  "rows of the history");
  return out + "</div>\n";
}

std::string mass_choice(std::size_t masses) {
  if (masses < 2) return {};
  std::string out =
      "<div class=\"tools\" role=\"group\" aria-label=\"Mass shown in the figure\">\n";
  for (std::size_t mass = 1; mass <= masses; ++mass)
    out += fmt::format(
        "<button type=\"button\" data-mass=\"{0}\" data-of=\"history\" aria-pressed=\"{1}\">mass "
        "{0}</button>\n",
        mass, mass == 1 ? "true" : "false");
  return out + "</div>\n";
}

}  // namespace clackers::report
