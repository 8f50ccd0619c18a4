#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "clackers/base/number.hpp"
#include "clackers/judge/cost/performance_profile.hpp"
#include "clackers/record/profile.hpp"
#include "clackers/report/atlas/survey_data.hpp"
#include "clackers/report/columns.hpp"

namespace clackers::report {
namespace {

using Json = nlohmann::ordered_json;

judge::CostTable cost_table(const Survey& survey, judge::Counter counter) {
  judge::CostTable table;
  for (const auto& method : survey.methods) table.methods.push_back(method.name);
  table.costs.resize(table.methods.size());
  std::vector<std::vector<measure::Ladder>> ladders(
      survey.systems.size(), std::vector<measure::Ladder>(survey.methods.size()));
  for (const auto& subject : survey.subjects)
    ladders[subject.system][subject.method] = subject.ladder;
  for (std::size_t s = 0; s < ladders.size(); ++s)
    judge::add_tasks(table, survey.systems[s].name, ladders[s], counter);
  return table;
}

Json line_json(const judge::MethodProfile& line, double tasks) {
  Json ratios = Json::array(), solved = Json::array();
  for (const auto& step : line.steps) {
    const Json ratio = rounded(step.ratio, 3);  // finer than any screen
    const auto count = std::lround(step.share * tasks);
    if (!ratios.empty() && ratios.back() == ratio) {
      solved.back() = count;
      continue;
    }
    ratios.push_back(ratio);
    solved.push_back(count);
  }
  return {ratios, solved};
}

}  // namespace

Json survey_profiles(const Survey& survey) {
  Json profiles = Json::array();
  for (const auto counter : {judge::Counter::force_evaluations, judge::Counter::steps}) {
    const auto table = cost_table(survey, counter);
    if (!judge::has_ratios(table)) continue;
    const auto field = record::field_of(counter);
    Json lines = Json::array();
    for (const auto& line : judge::performance_profile(table))
      lines.push_back(line_json(line, double(table.tasks.size())));
    profiles.push_back({{"counter", field},
                        {"title", column(field).heading},
                        {"tasks", table.tasks.size()},
                        {"lines", lines}});
  }
  return profiles;
}

}  // namespace clackers::report
