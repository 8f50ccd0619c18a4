#include <fmt/format.h>

#include "clackers/report/digest.hpp"
#include "clackers/report/figure_data.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/html_parts.hpp"
#include "clackers/report/look.hpp"
#include "clackers/report/markup.hpp"

namespace clackers::report {
namespace {

struct FigureText {
  std::string name, rows, title, caption, reading;
  std::string choices;  ///< buttons of its own, before the tools
};

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
      fmt::arg("described", "The numbers stand in the tables of section Methods."));
}

std::string toggle(const std::string& series, const std::string& key, const std::string& text) {
  return fmt::format(
      "<button type=\"button\" data-series=\"{}\" aria-pressed=\"true\">{}{}</button>\n",
      escape(series), key, escape(text));
}

std::string response_legend(const study::Record& record) {
  std::string out =
      "<div class=\"legend\" role=\"group\" aria-label=\"Shown in the response\" "
      "data-legend=\"response\">\n";
  for (std::size_t mass = 0; mass < record.response.y.size(); ++mass) {
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
  if (!record.problem.impact_times.empty())
    out += toggle("collisions",
                  "<svg class=\"key\" width=\"12\" height=\"12\" viewBox=\"-6 -6 12 12\" "
                  "aria-hidden=\"true\" focusable=\"false\" style=\"color:var(--collision)\"><path "
                  "d=\"M0,-5L5,4H-5Z\" fill=\"currentColor\"/></svg>",
                  "collisions");
  return out + "</div>\n";
}

std::string method_legend(const study::Record& record) {
  std::string out =
      "<div class=\"legend all\" role=\"group\" aria-label=\"Methods shown in the figures below\" "
      "data-legend=\"convergence history work-forces work-seconds\">\n";
  for (std::size_t i = 0; i < record.methods.size(); ++i) {
    const auto& method = record.methods[i];
    if (digest(method).runs > 0) out += toggle(method.name, key_svg(look(i)), method.name);
  }
  return out + "<button type=\"button\" class=\"every quiet\">all / none</button>\n</div>\n";
}

std::string mass_choice(const study::Record& record) {
  const auto masses = record.response.y.size();
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

// What a logarithmic axis cannot show is said.
std::string not_drawn(const study::Record& record) {
  long long failed = 0, zero = 0;
  for (const auto& method : record.methods)
    for (const auto& level : method.ladder)
      for (const auto& run : level.runs) {
        if (!run.finished)
          ++failed;
        else if (!(run.u_error > 0.0))
          ++zero;
      }
  std::string out;
  if (failed == 1) out += " 1 run that did not reach its end is not drawn.";
  if (failed > 1)
    out += fmt::format(" {} runs that did not reach their end are not drawn.", failed);
  if (zero == 1) out += " 1 run without any error is not drawn.";
  if (zero > 1) out += fmt::format(" {} runs without any error are not drawn.", zero);
  return out;
}

FigureText response_text(const study::Record& record) {
  const auto& problem = record.problem;
  const auto drawn = problem.impact_times.size();
  auto reading = std::string(
      "The masses touch where the thin vertical lines stand, marked by a triangle on the time "
      "axis.");
  if (static_cast<long long>(drawn) < problem.impact_count)
    reading +=
        fmt::format(" Only the first {} of {} collisions are marked.", drawn, problem.impact_count);
  return {"response",
          "response",
          "Exact response",
          fmt::format(
              "Displacement u of each mass in metres against time in seconds, over {} s with {} "
              "collisions.",
              html_number(problem.end, 6), html_count(problem.impact_count)),
          reading + " Drag to move, pinch or hold Ctrl and turn the wheel to zoom.",
          response_legend(record)};
}

}  // namespace

std::string figures_html(const study::Record& record) {
  const auto missing = not_drawn(record);
  const std::string cost_reading =
      "Lower is more accurate, further left is cheaper: at a given error the leftmost curve wins.";
  std::string out = figure(1, response_text(record));
  out += method_legend(record);
  out += figure(
      2, {"convergence",
          "runs",
          "Convergence",
          "Largest displacement error over both masses and all times of a run, divided by the "
          "initial envelope of the mass, against the step h in seconds. Both axes are "
          "logarithmic.",
          "Faint points are single runs; the line joins the worst run of each level (the upper "
          "envelope). A method of order p follows a straight line as steep as the side of the "
          "triangle with p beside it. Scatter of the points is irregularity, a line that levels "
          "out is a floor. Point at a curve, or at its name above, to pick the method out in every "
          "figure." +
              missing,
          {}});
  out += figure(
      3,
      {"history", "history", "Error against time",
       "Displacement error divided by the initial envelope of the mass against time in "
       "seconds, one run a method. The error axis is logarithmic.",
       "Steps up at collisions are errors that collisions bring in; the downward spikes are "
       "changes of sign. The markers only tell the curves apart. Point at a curve for its step h.",
       mass_choice(record)});
  out += "<div class=\"pair\">\n";
  out +=
      figure(4, {"work-forces",
                 "runs",
                 "Work and precision: force evaluations",
                 "The same error against the number of force evaluations of the run, counted and "
                 "therefore the same on every machine.",
                 cost_reading,
                 {}});
  out +=
      figure(5, {"work-seconds",
                 "runs",
                 "Work and precision: time",
                 "The same error against the processor time of the run in seconds, on the machine "
                 "named below.",
                 cost_reading + " Short runs are dominated by the clock's resolution.",
                 {}});
  return out + "</div>\n";
}

}  // namespace clackers::report
