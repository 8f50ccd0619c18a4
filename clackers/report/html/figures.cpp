#include "clackers/report/html/figures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clackers/report/assets.hpp"
#include "clackers/report/html/figure_data.hpp"
#include "clackers/report/html/plot_style.hpp"
#include "clackers/report/markup.hpp"
#include "clackers/report/write.hpp"

namespace clackers::report {

std::string figure_html(int& number, const Place& place, const FigureText& text) {
  return fill(assets::figure_html, {{"name", text.name + place.suffix},
                                    {"number", fmt::format("{}", number++)},
                                    {"title", text.title},
                                    {"caption", text.caption},
                                    {"choices", text.choices},
                                    {"rows", text.rows + place.suffix},
                                    {"reading", text.reading}});
}

std::string toggle(const std::string& series, const std::string& key, const std::string& text) {
  return fmt::format(
      "<button type=\"button\" data-series=\"{}\" aria-pressed=\"true\">{}{}</button>\n",
      escape(series), key, escape(text));
}

namespace {

std::string small_key(std::string_view color, std::string_view shape) {
  return fmt::format(
      "<svg class=\"key\" width=\"12\" height=\"12\" viewBox=\"-6 -6 12 12\" aria-hidden=\"true\" "
      "focusable=\"false\" style=\"color:{}\">{}</svg>",
      color, shape);
}

std::size_t drawn_masses(const record::CaseRecord& problem) {
  return std::min(problem.response.y.size(), most_drawn_masses);
}

std::string masses_left_out(const record::CaseRecord& problem) {
  const auto masses = problem.response.y.size(), drawn = drawn_masses(problem);
  return drawn == masses ? std::string()
                         : fmt::format(" Of {} masses the first {} are drawn.", masses, drawn);
}

std::string response_legend(const record::CaseRecord& problem, const Place& place) {
  auto out = fmt::format(
      "<div class=\"legend\" role=\"group\" aria-label=\"Shown in the response\" "
      "data-legend=\"response{}\">\n",
      place.suffix);
  for (std::size_t mass = 0; mass < drawn_masses(problem); ++mass) {
    const auto name = fmt::format("mass {}", mass + 1);
    out += toggle(name, key_svg(mass_style(mass)), name);
  }
  if (!problem.problem.impact_times.empty())
    out += toggle("impacts",
                  small_key("var(--impact)", "<path d=\"M0,-5L5,4H-5Z\" fill=\"currentColor\"/>"),
                  "impacts");
  if (drawn_subject(problem) != nullptr)
    out += toggle("history", small_key("inherit", "<circle r=\"3\" fill=\"currentColor\"/>"),
                  "rows of the history");
  return out + "</div>\n";
}

std::string legend(std::string_view figures, const std::vector<std::string>& toggles) {
  auto out = fmt::format(
      "<div class=\"legend all\" role=\"group\" aria-label=\"Methods shown in the figures below\" "
      "data-legend=\"{}\">\n",
      figures);
  for (const auto& button : toggles) out += button;
  return out + "<button type=\"button\" class=\"every quiet\">all / none</button>\n</div>\n";
}

std::string method_legend(const record::CaseRecord& problem, const Place& place) {
  std::vector<std::string> toggles;
  for (std::size_t i = 0; i < problem.subjects.size(); ++i) {
    const auto& subject = problem.subjects[i];
    const auto ran = [](const record::Level& level) { return !level.runs.empty(); };
    if (std::ranges::any_of(subject.levels, ran))
      toggles.push_back(toggle(subject.name, key_svg(plot_style(i)), subject.name));
  }
  if (toggles.size() < 2) return {};
  return legend(fmt::format("convergence{0} history{0} work{0} profile{0}", place.suffix), toggles);
}

std::string mass_choice(const record::CaseRecord& problem, const Place& place) {
  if (problem.response.y.size() < 2) return {};
  std::string out =
      "<div class=\"tools\" role=\"group\" aria-label=\"Mass shown in the figure\">\n";
  const auto shown = worst_mass(problem);
  for (std::size_t mass = 1; mass <= drawn_masses(problem); ++mass)
    out += fmt::format(
        "<button type=\"button\" data-mass=\"{0}\" data-of=\"history{2}\" "
        "aria-pressed=\"{1}\">mass {0}</button>\n",
        mass, mass == shown ? "true" : "false", place.suffix);
  return out + "</div>\n";
}

// What a logarithmic axis cannot show.
std::string not_drawn(const record::CaseRecord& problem) {
  long long failed = 0, zero = 0;
  for (const auto& subject : problem.subjects)
    for (const auto& level : subject.levels)
      for (const auto& run : level.runs) {
        if (!run.score.finished)
          ++failed;
        else if (run.score.u_error == 0.0)
          ++zero;
      }
  std::string out;
  if (failed > 0) out += fmt::format(" Not drawn: {} that failed.", counted(failed, "run"));
  if (zero > 0) out += fmt::format(" Not drawn: {} without any error.", counted(zero, "run"));
  return out;
}

// Figures that a logarithmic axis leaves nothing of.
std::string not_shown(const record::CaseRecord& problem) {
  const auto has_levels = [](const auto& subject) { return !subject.levels.empty(); };
  if (!std::ranges::any_of(problem.subjects, has_levels)) return {};
  std::string out;
  if (!has_convergence(problem))
    out += "Convergence is not drawn: fewer than two runs have an error above zero. ";
  if (!has_error_history(problem))
    out += "Error against time is not drawn: no run has an error above zero. ";
  return out.empty() ? out : fmt::format("<p class=\"reading\">{}</p>\n", out);
}

FigureText response_text(const record::CaseRecord& record, const Place& place) {
  const auto& problem = record.problem;
  const auto drawn = problem.impact_times.size();
  const auto* rows = drawn_subject(record);
  std::string reading =
      rows != nullptr
          ? "Dots that leave their line are errors of the history; dots that are all late or early "
            "by the same amount are errors of its time column. Triangles mark the exact impacts."
          : "The masses touch at the thin vertical lines, marked by a triangle on the time axis.";
  if (static_cast<long long>(drawn) < problem.impact_count)
    reading +=
        fmt::format(" Only the first {} of {} impacts are marked.", drawn, problem.impact_count);
  if (!has_player(record) && record.response.t.size() > 1)
    reading +=
        record.response.y.size() > std::size_t(record::most_blocks)
            ? fmt::format(" More than {} masses are not animated.", record::most_blocks)
            : std::string(" The motion is not animated: its contacts join combinations of masses.");
  const auto caption =
      rows != nullptr
          ? fmt::format(
                "Displacement u of each mass in metres against time in seconds: the exact "
                "motion as lines, rows of {} as dots.",
                escape(history_name(*rows, *rows->shown_run())))
          : fmt::format(
                "Displacement u of each mass in metres against time in seconds, over {} s "
                "with {}.",
                html_number(problem.end, 6), counted(problem.impact_count, "impact"));
  return {"response",
          rows != nullptr ? "history_rows" : "response",
          rows != nullptr ? "The history over the exact response" : "Exact response",
          caption + masses_left_out(record),
          reading +
              " Of long curves the lowest and highest point of every stretch are drawn. Drag "
              "to move, pinch or hold Ctrl and turn the wheel to zoom.",
          response_legend(record, place)};
}

FigureText convergence_text(const record::CaseRecord& problem) {
  const bool by_step = std::ranges::any_of(problem.subjects, [](const record::Subject& subject) {
    return subject.refined_by == record::RefinementParameter::step;
  });
  return {
      "convergence",
      "runs",
      "Convergence",
      fmt::format("Largest displacement error over all masses and times of a run, divided by "
                  "the largest envelope of the mass, against the {}. Both axes are logarithmic.",
                  by_step ? "step h in seconds" : "tolerance"),
      "Faint points are single runs; the line joins the worst run of each level (the upper "
      "envelope), without levels of which more than half of the runs failed. A method of order "
      "p follows a straight line as steep as the side of the triangle with p beside it. "
      "Scatter of the points is irregularity, a line that levels out is a floor. Point at a "
      "curve, or at its name above, to highlight it in every figure." +
          not_drawn(problem),
      {}};
}

FigureText history_text(const record::CaseRecord& problem, const Place& place) {
  return {"history",
          "history",
          "Error against time",
          "Displacement error divided by the largest envelope of the mass against time in seconds, "
          "one run of each. The error axis is logarithmic." +
              masses_left_out(problem),
          "Steps up at impacts are errors that the impacts cause; downward spikes are changes "
          "of sign; a level line in a history may be its printed digits. Point at a curve to see "
          "which run it is.",
          mass_choice(problem, place)};
}

FigureText impacts_text() {
  return {
      "impacts",
      "impact_table",
      "Restitution and lateness",
      "Of each impact of the finest history, read from the rows around it: the speed after over "
      "the speed before, and the delay in steps, against time in seconds.",
      "A right solver keeps one restitution for each contact, and lateness near zero; lateness "
      "between 0 and 1 means impacts at the ends of steps. Filled: restitution, with bars of what flights between "
      "rows leave open; open: lateness. Speeds and momentum stand in the table of impacts below.",
      {}};
}

bool has_impact_table(const record::CaseRecord& problem) {
  return std::ranges::any_of(problem.subjects,
                             [](const auto& subject) { return !subject.impacts.empty(); });
}

std::string scene_reading(const record::Schematic& drawing) {
  if (drawing.plane)
    return "The body moves along the faint line in the plane of u1 and u2; the arrow is the scale. Its radius is chosen for "
           "the drawing, and walls stand off by it; a third displacement turns it by u3 over this radius.";
  if (!drawing.lengths.empty())
    return "Masses hang at their lengths, drawn to the scale of the arrow, and are drawn side by side "
           "where they meet: bobs have no size.";
  if (!drawing.string.empty())
    return "Points are the nodes of the mesh. The arrow is the scale of displacements, which is not that of lengths along the "
           "string; what the string may touch is drawn where it is.";
  return "Blocks are masses with their numbers, lines below and between them are springs. The arrow "
         "points along positive displacements and is their scale; a structure has no size of its own.";
}

std::string player_html(int& number, const record::CaseRecord& problem, const Place& place) {
  return fill(
      assets::player_html,
      {{"name", "motion" + place.suffix},
       {"number", fmt::format("{}", number++)},
       {"title", "The exact motion"},
       {"caption",
        fmt::format("The structure over {} s, in real time unless another speed is chosen.",
                    html_number(problem.problem.end, 6))},
       {"choices", ""},
       {"response", "response" + place.suffix},
       {"reading",
        scene_reading(problem.problem.drawing) +
            (problem.problem.contact_forces.t.empty()
                 ? ""
                 : " A ring marks a contact that stays closed, and an arrow the force on each mass there.") +
            " A dot flashes at impacts. The line in the response shows the time. A run chosen "
            "beside the exact motion is drawn as outlines."}});
}

FigureText work_text(const std::vector<ShownCounter>& counters, const Place& place) {
  return {
      "work",
      "runs",
      "Work and precision",
      "The same error against the cost of the run: counted, and therefore the same on every "
      "machine, or as processor time in seconds on the machine named below.",
      "Lower is more accurate, further left is cheaper. Faint points are single runs; a line "
      "joins the largest error and the largest cost of each level. The dashed grey line is the Pareto front: no run of any method is both "
      "cheaper and more accurate. A method without any of what is counted is not drawn. Times "
      "of short runs are dominated by the clock's resolution.",
      counter_choice(counters, "work" + place.suffix)};
}

// A line that stays low is easily overlooked.
std::string failed_tasks(const record::Profile& profile) {
  std::string list;
  for (const auto& method : profile.methods)
    if (method.failed > 0)
      list +=
          fmt::format("{}{} {}", list.empty() ? "" : ", ", escape(method.method), method.failed);
  return list.empty() ? " Every method solves all." : " Not solved: " + list + ".";
}

FigureText profile_text(const std::vector<record::Profile>& profiles, const Place& place,
                        long long cases) {
  const auto& profile = profiles.front();
  return {"profile",
          "profile",
          "Performance profile",
          fmt::format("Share of {} that a method solves at no more than so many times the least "
                      "cost. A task is an error in u to reach on {}: 0.1, 0.01, ... down to the "
                      "smallest that some method reaches.",
                      counted(std::ssize(profile.tasks), "task"),
                      cases == 1 ? std::string("this case") : "one of " + counted(cases, "case")),
          "The left edge shows how often a method is the cheapest, the right edge how many tasks "
          "it solves. Refusals and failures count as not solved." +
              failed_tasks(profile) + (cases == 1 ? " One case says little about others." : ""),
          counter_choice(counters_of(profiles), "profile" + place.suffix)};
}

}  // namespace

std::string response_html(const record::CaseRecord& problem, const Place& place, int& number) {
  auto out = figure_html(number, place, response_text(problem, place));
  if (has_player(problem)) out += player_html(number, problem, place);
  return out;
}

std::string figures_html(const record::CaseRecord& problem, const Place& place, int& number) {
  auto out = response_html(problem, place, number);
  out += method_legend(problem, place);
  if (has_convergence(problem)) out += figure_html(number, place, convergence_text(problem));
  if (has_error_history(problem)) out += figure_html(number, place, history_text(problem, place));
  out += not_shown(problem);
  if (has_impact_table(problem)) out += figure_html(number, place, impacts_text());
  std::string pair;
  if (const auto counters = counters_of(problem); !counters.empty())
    pair += figure_html(number, place, work_text(counters, place));
  if (!problem.profiles.empty())
    pair += figure_html(number, place, profile_text(problem.profiles, place, 1));
  return pair.empty() ? out : out + "<div class=\"pair\">\n" + pair + "</div>\n";
}

std::string profile_html(const record::Record& record, int& number) {
  if (record.profiles.empty()) return {};
  std::vector<std::string> toggles;
  const auto& methods = record.profiles.front().methods;
  for (std::size_t i = 0; i < methods.size(); ++i)
    toggles.push_back(toggle(methods[i].method, key_svg(plot_style(i)), methods[i].method));
  return legend("profile", toggles) +
         figure_html(number, {}, profile_text(record.profiles, {}, std::ssize(record.cases)));
}

}  // namespace clackers::report
