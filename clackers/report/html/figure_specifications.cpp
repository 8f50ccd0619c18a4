#include "clackers/report/html/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "clackers/base/files/json.hpp"
#include "clackers/base/number.hpp"
#include "clackers/report/assets.hpp"
#include "clackers/report/html/figure_data.hpp"
#include "clackers/report/html/plot_style.hpp"
#include "clackers/report/write.hpp"

namespace clackers::report {
namespace {

using Json = nlohmann::ordered_json;

// A tick of a logarithmic axis: powers of ten, and between them only where few would be left.
std::string power_label(const std::string& axis) {
  const std::string exponent = "round(log(datum.value) / LN10)", digits = "'⁰¹²³⁴⁵⁶⁷⁸⁹'";
  const auto digit = [&](const std::string& value) {
    return "substring(" + digits + ", " + value + ", " + value + " + 1)";
  };
  const auto size = "abs(" + exponent + ")";
  const auto power = "'10' + (" + exponent + " < 0 ? '⁻' : '') + (" + size + " >= 100 ? " +
                     digit("floor(" + size + " / 100)") + " : '') + (" + size + " >= 10 ? " +
                     digit("(floor(" + size + " / 10) % 10)") + " : '') + " +
                     digit("(" + size + " % 10)");
  const auto ratio = "domain('" + axis + "')[1] / domain('" + axis + "')[0]";
  return "abs(log(datum.value) / LN10 - " + exponent + ") < 1e-9 ? " + power + " : " + ratio +
         " < 1.5 ? format(datum.value, '.4~g') : " + ratio +
         " < 30 ? format(datum.value, '.2~g') : ''";
}

// A tick of a logarithmic axis: ..., 0.5, 1, 2, 5, 10, 20, ...
std::string ratio_label() {
  const std::string power = "pow(10, floor(log(datum.value) / LN10 + 1e-9))";
  return "indexof([1, 2, 5], round(datum.value / " + power +
         ")) >= 0 ? format(datum.value, '.3~g') : ''";
}

// Replaces every text "$name" by its value.
void substitute(Json& json, const Json& values) {
  if (json.is_structured()) {
    for (auto& item : json) substitute(item, values);
  } else if (json.is_string()) {
    const auto text = json.get<std::string>();
    if (text.size() > 1 && text.front() == '$') {
      const auto value = values.find(text.substr(1));
      if (value != values.end()) json = *value;
    }
  }
}

// Without the tooltips of a field.
void erase_field(Json& json, std::string_view field) {
  if (!json.is_structured()) return;
  if (json.is_array())
    for (auto item = json.begin(); item != json.end();)
      item = item->is_object() && item->value("field", Json()) == field ? json.erase(item)
                                                                        : std::next(item);
  for (auto& item : json) erase_field(item, field);
}

// Of a long curve a marker at every sixtieth point, at other points for every method.
std::string marker_rows(const Json& names) {
  const auto list = json_text(names);
  return "datum.row % 60 === (7 * indexof(" + list + ", datum.method) + 15) % 60";
}

Json method_scales(const std::vector<std::string>& methods) {
  Json names = Json::array(), colors = Json::array(), shapes = Json::array(),
       dashes = Json::array();
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const auto style = plot_style(i);
    names.push_back(methods[i]);
    colors.push_back(style.color);
    shapes.push_back(style.shape);
    dashes.push_back(style.dash);
  }
  return {{"methods", names},
          {"colors", colors},
          {"shapes", shapes},
          {"dashes", dashes},
          {"marker_rows", marker_rows(names)},
          {"x_power", power_label("x")},
          {"x_ratio", "datum.value < 0.999 ? '' : " + ratio_label()},
          {"y_power", power_label("y")}};
}

// What a figure of work needs beside its methods. `before` stands before each counter's title.
Json counter_values(const std::vector<ShownCounter>& counters, const std::string& before) {
  Json titles = Json::object();
  for (const auto& counter : counters) titles[std::string(counter.field)] = before + counter.title;
  const auto first = std::string(first_shown(counters).field);
  return {{"counter", first},
          {"titles", {{"counters", titles}}},
          {"x_title", titles[first]},
          {"drawable",
           "datum.u_error > 0 && isFinite(datum.u_error) && datum.cost > 0 && "
           "indexof(hidden, datum.method) < 0"}};
}

Json mass_scales(const record::CaseRecord& problem) {
  Json names = Json::array(), colors = Json::array(), dashes = Json::array();
  for (std::size_t mass = 0; mass < std::min(problem.response.y.size(), most_drawn_masses);
       ++mass) {
    const auto style = mass_style(mass);
    names.push_back(fmt::format("mass {}", mass + 1));
    colors.push_back(style.color);
    dashes.push_back(style.dash);
  }
  return {{"masses", names}, {"mass_colors", colors}, {"mass_dashes", dashes}};
}

// Of all impacts, and so wide that rounding does not fill it; empty without any.
Json restitution_range(const record::CaseRecord& problem) {
  constexpr double margin = 0.01;
  double least = INFINITY, most = -INFINITY;
  for (const auto& subject : problem.subjects)
    for (const auto& impact : subject.impacts) {
      least = std::min(least, impact.restitution - margin);
      most = std::max(most, impact.restitution + margin);
    }
  return least < most ? Json{least, most} : Json::array();
}

// Around values that hardly differ, so that the labels of their axis do.
Json least_range(const record::Sheet& sheet) {
  constexpr double share = 0.01;
  double least = INFINITY, most = -INFINITY;
  for (const auto& row : sheet.rows)
    for (std::size_t c = 1; c < row.size(); ++c)
      if (const double value = record::number_in(row[c]); !std::isnan(value)) {
        least = std::min(least, value);
        most = std::max(most, value);
      }
  const double room = share * std::abs(most);
  return most - least < room ? Json{least - room, most + room} : Json::array();
}

}  // namespace

Json specification_of(std::string_view text, const std::vector<std::string>& methods, Json values) {
  auto specification = parse_json(text);
  values.update(method_scales(methods));
  substitute(specification, values);
  return specification;
}

Json figure_specifications(const record::CaseRecord& problem) {
  std::vector<std::string> names;
  for (const auto& subject : problem.subjects) names.push_back(subject.name);
  const auto masses = mass_scales(problem);
  Json all{{"response", specification_of(assets::response_vl_json, names, masses)}};
  // A layer without rows has no times, of which the axis warns.
  if (auto& layers = all["response"]["layer"]; problem.problem.impact_times.empty())
    layers.erase(std::remove_if(layers.begin(), layers.end(),
                                [](const Json& layer) {
                                  return layer.contains("data") &&
                                         layer["data"]["name"] == "impacts";
                                }),
                 layers.end());
  if (drawn_subject(problem) != nullptr)
    all["response"]["layer"].push_back(
        specification_of(assets::history_rows_vl_json, names, masses));
  const bool by_step = std::ranges::any_of(problem.subjects, [](const record::Subject& subject) {
    return subject.refined_by == record::RefinementParameter::step;
  });
  const Json step{{"x_step", by_step ? "step h [s]" : "tolerance"}};
  if (has_convergence(problem))
    all["convergence"] = specification_of(assets::convergence_vl_json, names, step);
  if (has_error_history(problem))
    all["history"] = specification_of(assets::history_vl_json, names,
                                      {{"x_step", step["x_step"]}, {"mass", worst_mass(problem)}});
  if (const auto range = restitution_range(problem); !range.empty())
    all["impacts"] =
        specification_of(assets::impacts_vl_json, names, {{"restitution_range", range}});
  if (const auto counters = counters_of(problem); !counters.empty()) {
    auto values = counter_values(counters, "");
    values.update(step);
    all["work"] = specification_of(assets::work_vl_json, names, values);
  }
  if (!by_step) erase_field(all, "steps_per_fast_period");
  if (const auto counters = counters_of(problem.profiles); !counters.empty())
    all["profile"] = specification_of(assets::profile_vl_json, names,
                                      counter_values(counters, "times the least "));
  return all;
}

Json profile_specification(const std::vector<record::Profile>& profiles) {
  std::vector<std::string> names;
  for (const auto& method : profiles.front().methods) names.push_back(method.method);
  return specification_of(assets::profile_vl_json, names,
                          counter_values(counters_of(profiles), "times the least "));
}

Json curves_specification(const record::Sheet& sheet, std::string_view name) {
  const bool is_whole = sheet.columns[0].kind == record::ColumnKind::whole;
  const auto scale = [](bool is_log, int padding) {
    Json axis{{"type", is_log ? "log" : "linear"}, {"nice", false}};
    if (!is_log) axis["zero"] = false;
    if (padding > 0) axis["padding"] = padding;
    return axis;
  };
  const auto axis = [](const std::string& title, bool is_log, const std::string& label) {
    Json all{{"title", title}, {"format", "~g"}, {"labelOverlap", true}};
    if (is_log) all["labelExpr"] = label;
    return all;
  };
  const auto& axes = *sheet.curves;
  std::vector<std::string> names;
  for (std::size_t c = 1; c < sheet.columns.size(); ++c) names.push_back(sheet.columns[c].label());
  Json mark = Json::array();
  for (const double x : axes.marks) mark.push_back({{"x", rounded(x)}, {"text", axes.mark_text}});
  const auto x_title = sheet.columns[0].label();
  const auto y_title = names.size() > 1 ? axes.y
                       : axes.y.empty() ? names[0]
                                        : fmt::format("{}, {}", axes.y, names[0]);
  auto x_axis = axis(x_title, axes.log_x, ratio_label());
  auto y_scale = scale(axes.log_y, 12);
  if (is_whole) {
    for (const auto& row : sheet.rows) x_axis["values"].push_back(record::number_in(row[0]));
    if (!axes.x_names.empty()) x_axis["labelExpr"] = json_text(axes.x_names) + "[datum.value - 1]";
    if (const auto range = least_range(sheet); !range.empty())
      y_scale["domain"] = {{"unionWith", range}};
  }
  return specification_of(assets::curves_vl_json, names,
                          {{"data", std::string(name)},
                           {"x_scale", scale(axes.log_x, is_whole ? 24 : 0)},
                           {"y_scale", y_scale},
                           {"point_opacity", is_whole ? 1 : 0},
                           {"x_title", x_title},
                           {"x_axis", x_axis},
                           {"y_axis", axis(y_title, axes.log_y, power_label("y"))},
                           {"mark", mark}});
}

void rename_data(Json& specification, std::string_view suffix) {
  if (!specification.is_structured()) return;
  if (specification.is_object() && specification.contains("data"))
    if (auto& data = specification["data"]; data.is_object() && data.contains("name"))
      data["name"] = data["name"].get<std::string>() + std::string(suffix);
  for (auto& item : specification) rename_data(item, suffix);
}

}  // namespace clackers::report
