#include <fmt/format.h>

#include "clackers/report/counters.hpp"
#include "clackers/report/digest.hpp"
#include "clackers/report/figure_data.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/html_frame.hpp"
#include "clackers/report/html_parts.hpp"
#include "clackers/report/look.hpp"
#include "clackers/report/markup.hpp"

namespace clackers::report {
namespace {

std::string method_legend(const study::Record& record) {
  std::string out =
      "<div class=\"legend all\" role=\"group\" aria-label=\"Methods shown in the figures below\" "
      "data-legend=\"convergence history work profile\">\n";
  for (std::size_t i = 0; i < record.methods.size(); ++i) {
    const auto& method = record.methods[i];
    if (digest(method).runs > 0) out += toggle(method.name, key_svg(look(i)), method.name);
  }
  return out + "<button type=\"button\" class=\"every quiet\">all / none</button>\n</div>\n";
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
          response_legend(record.response.y.size(), !record.problem.impact_times.empty())};
}

FigureText work_text(const std::vector<ShownCounter>& counters) {
  return {"work",
          "runs",
          "Work and precision",
          "The same error against what the run cost: counted, and therefore the same on every "
          "machine, or as processor time in seconds on the machine named below.",
          "Lower is more accurate, further left is cheaper: at a given error the leftmost curve "
          "wins. A method that makes none of what is counted has no place on a logarithmic axis. "
          "Times of short runs are dominated by the clock's resolution.",
          counter_choice(counters, "work")};
}

// What failed is told in words too: a line that stays low is easily overlooked.
std::string failed_tasks(const study::Profile& profile) {
  std::string list;
  for (const auto& method : profile.methods)
    if (method.failed > 0)
      list +=
          fmt::format("{}{} {}", list.empty() ? "" : ", ", escape(method.method), method.failed);
  return list.empty() ? " Every method solves all." : " Not solved: " + list + ".";
}

FigureText profile_text(const study::Record& record, const std::vector<ShownCounter>& counters) {
  const auto& profile = record.profiles.front();
  return {"profile",
          "profile",
          "Performance profile",
          fmt::format("Share of {} tasks that a method solves at no more than so many times the "
                      "least cost. A task is an error in u to reach on this case: 0.1, 0.01, ... "
                      "down to the smallest that some method reaches.",
                      profile.tasks.size()),
          "At the left edge stands how often a method is the cheapest, at the right edge how many "
          "tasks it solves at all. Refusals and failures stay in the shares." +
              failed_tasks(profile) + " One case says little of others.",
          counter_choice(counters, "profile")};
}

std::string work_figures(const study::Record& record) {
  const auto counters = counters_of(record), profiled = counters_of(record.profiles);
  std::string out;
  if (!counters.empty()) out += figure(4, work_text(counters));
  if (!profiled.empty()) out += figure(5, profile_text(record, profiled));
  return out.empty() ? out : "<div class=\"pair\">\n" + out + "</div>\n";
}

}  // namespace

std::string figures_html(const study::Record& record) {
  const auto missing = not_drawn(record);
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
       mass_choice(record.response.y.size())});
  return out + work_figures(record);
}

}  // namespace clackers::report
