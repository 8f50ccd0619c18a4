#include <nlohmann/json.hpp>

#include "clackers/base/number.hpp"
#include "clackers/report/html/figure_data.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_player_numbers = 60000;

}  // namespace

bool has_player(const record::CaseRecord& problem) {
  return problem.response.t.size() > 1 &&
         problem.problem.drawing.blocks.size() == problem.response.y.size();
}

Json player_data(const record::CaseRecord& problem) {
  const auto& drawing = problem.problem.drawing;
  const auto& whole = problem.response;
  const auto every = 1 + whole.y.size() * whole.t.size() / most_player_numbers;
  const auto thinned = [&](const std::vector<double>& values) {
    std::vector<double> kept;
    for (std::size_t i = 0; i < values.size(); i += every) kept.push_back(values[i]);
    return rounded_list(kept);
  };
  Json u = Json::array(), blocks = Json::array(), springs = Json::array(), contacts = Json::array(),
       impacts = Json::array();
  for (const auto& curve : whole.y) u.push_back(thinned(curve));
  for (const auto& block : drawing.blocks)
    blocks.push_back({{"column", block.column}, {"height", block.height}});
  for (const auto& spring : drawing.springs)
    springs.push_back({{"one", spring.one}, {"other", spring.other}});
  for (const auto& touch : drawing.contacts)
    contacts.push_back({{"left", touch.left}, {"right", touch.right}, {"gap", touch.gap}});
  for (std::size_t k = 0; k < problem.problem.impact_contacts.size(); ++k)
    impacts.push_back({{"t", rounded(problem.problem.impact_times[k])},
                       {"contact", problem.problem.impact_contacts[k]}});
  const auto& forces = problem.problem.contact_forces;
  Json of_contacts = Json::array();
  for (const auto& force : forces.y) of_contacts.push_back(rounded_list(force));
  Json string = Json::array();
  for (const auto& node : drawing.string) string.push_back({{"x", node.x}, {"mass", node.mass}});
  Json runs = Json::array();
  for (const auto& subject : problem.subjects) {
    const auto* run = subject.shown_run();
    if (run == nullptr) continue;
    const auto& curve = run->file ? run->file->history : run->motion;
    if (curve.t.size() < 2 || curve.y.size() != drawing.blocks.size()) continue;
    Json displacements = Json::array();
    for (const auto& y : curve.y) displacements.push_back(rounded_list(y));
    runs.push_back({{"name", subject.name},
                    {"step", resolution_text(subject, run->score.step)},
                    {"t", rounded_list(curve.t)},
                    {"u", std::move(displacements)}});
  }
  return {{"runs", runs},
          {"t", thinned(whole.t)},
          {"u", u},
          {"blocks", blocks},
          {"springs", springs},
          {"contacts", contacts},
          {"impacts", impacts},
          {"forces", {{"t", rounded_list(forces.t)}, {"u", std::move(of_contacts)}}},
          {"leftward", drawing.leftward},
          {"lengths", drawing.lengths},
          {"plane", drawing.plane ? Json(*drawing.plane) : Json(nullptr)},
          {"string", string}};
}

}  // namespace clackers::report
