#include <fmt/format.h>

#include "clackers/report/html/figures.hpp"
#include "clackers/report/html/page.hpp"
#include "clackers/report/html/plot_style.hpp"
#include "clackers/report/markup.hpp"
#include "clackers/report/write.hpp"

namespace clackers::report {

void add_dials(Page& page, const Dials& dials, int& number) {
  const auto figure = [&](const FigureText& text) { return figure_html(number, {}, text); };
  std::string masses = "<p class=\"legend reading\">";
  for (std::size_t mass = 0; mass < 2; ++mass)
    masses += fmt::format("<span class=\"named\">{}mass {}</span>",
                          key_svg(MassStyle{mass_style(mass).color, {}}), mass + 1);
  masses += "</p>\n";
  const auto animation =
      fill(assets::player_html,
           {{"name", "motion"},
            {"number", std::to_string(number++)},
            {"title", "The exact motion"},
            {"caption", "In real time unless another speed is chosen."},
            {"choices", ""},
            {"response", "response"},
            {"reading",
             "A dot flashes where the masses collide; the line in the response shows the time. "
             "A run chosen beside the exact motion is drawn as outlines."}});
  page.sections.push_back(
      {"dials-section", "Dials", "Dials",
       std::string(assets::explore_html) + animation +
           figure({.name = "response",
                   .rows = "curves",
                   .title = "Response",
                   .caption = "Displacements of both masses in metres against time in seconds.",
                   .reading = "Whole lines are the exact motion, broken lines the runs; the masses "
                              "touch at the thin vertical lines. Drag to move, pinch or hold Ctrl "
                              "and turn the wheel to zoom.",
                   .choices = masses})});
  page.sections.push_back(
      {"orders", "Orders", "Why order is lost",
       figure({.name = "convergence",
               .rows = "ladder",
               .title = "Error against step",
               .caption = "Largest error of a displacement in a run, relative to the largest "
                          "initial displacement, for steps that halve.",
               .reading =
                   "A line that falls by 16 where the step halves is of order 4. Impacts taken at "
                   "the end of a step bring order 1 whatever the method; a spring as contact "
                   "converges to the motion of the spring. The broken line is the step above."})});
  const auto phase =
      figure({.name = "phase",
              .rows = "curves",
              .title = "Phase portrait",
              .caption = "Velocity against displacement of each mass, a line a flight.",
              .reading = "An impact is a jump of both velocities at u = 0.",
              .choices = masses});
  const auto energy = figure(
      {.name = "energy",
       .rows = "curves",
       .title = "Energies",
       .caption = "Kinetic and potential energy of each mass, exact and of the runs.",
       .reading = "Whole lines are the exact motion, broken lines the runs in the colours of "
                  "their list. Elastic impacts pass energy between the masses; damping "
                  "takes it away.",
       .choices = masses});
  page.sections.push_back({"phase-section", "Phase", "Phase and energy",
                           "<div class=\"pair\">\n" + phase + energy + "</div>\n"});
  page.sections.push_back(
      {"digits", "Digits", "The same motion with all digits",
       "<div class=\"command\"><pre id=\"again-command\"></pre><button type=\"button\" "
       "data-copy=\"again-command\">Copy</button></div>\n<p>The address of this page keeps the "
       "dials: send it, or bookmark it.</p>\n"});
  page.style = assets::explore_css;
  page.data["dials"] = {
      {"X", dials.X}, {"xi1", dials.xi1}, {"a_t", dials.a_t}, {"r", dials.r}, {"eta", dials.eta}};
  page.specifications.update(nlohmann::ordered_json::parse(assets::explore_json));
  page.scripts = {assets::synchronized_pair_js,
                  assets::runs_js,
                  assets::explore_js,
                  assets::page_js,
                  assets::scene_js,
                  assets::player_js};
}

std::string explore(const Dials& dials, const record::Provenance& from) {
  Page page;
  page.command = "explore";
  page.title = "Two masses that clack";
  page.heading = "Two masses that clack: turn the dials";
  page.lead =
      "Two damped masses collide again and again at their common equilibrium, and their motion is "
      "known exactly. m<sub>1</sub> = 1 kg, k<sub>1</sub> = 1 N/m, u<sub>1</sub>(0) = 1 m.";
  page.data = page.specifications = nlohmann::ordered_json::object();
  int number = 1;
  add_dials(page, dials, number);
  return page_html(page, from);
}

}  // namespace clackers::report
