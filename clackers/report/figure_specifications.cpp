#include <nlohmann/json.hpp>

#include "clackers/report/assets.hpp"
#include "clackers/report/counters.hpp"
#include "clackers/report/figure_data.hpp"
#include "clackers/report/look.hpp"

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
  return "abs(log(datum.value) / LN10 - " + exponent + ") < 1e-9 ? " + power + " : domain('" +
         axis + "')[1] / domain('" + axis + "')[0] < 30 ? format(datum.value, '.2~e') : ''";
}

// A tick of an axis of ratios from 1: 1, 2, 5, 10, 20, 50, ...
std::string ratio_label() {
  const std::string power = "pow(10, floor(log(datum.value) / LN10 + 1e-9))";
  return "datum.value > 0.999 && indexof([1, 2, 5], round(datum.value / " + power +
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

// Of a long curve a marker at every sixtieth point, at other points for every method.
std::string marker_rows(const Json& names) {
  const auto list = names.dump(-1, ' ', false, Json::error_handler_t::replace);
  return "datum.row % 60 === (7 * indexof(" + list + ", datum.method) + 15) % 60";
}

Json method_scales(const study::Record& record) {
  Json names = Json::array(), colors = Json::array(), shapes = Json::array(),
       dashes = Json::array();
  for (std::size_t i = 0; i < record.methods.size(); ++i) {
    const auto style = look(i);
    names.push_back(record.methods[i].name);
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
          {"x_ratio", ratio_label()},
          {"y_power", power_label("y")}};
}

}  // namespace

nlohmann::ordered_json figure_specifications(const study::Record& record) {
  const auto read = [&](std::string_view text, Json values) {
    auto specification = Json::parse(text);
    values.update(method_scales(record));
    substitute(specification, values);
    return specification;
  };
  const auto counted = [&](std::string_view text, const std::vector<ShownCounter>& counters,
                           const std::string& before) {
    Json titles = Json::object();
    for (const auto& [field, title] : counters) titles[std::string(field)] = before + title;
    const auto first = std::string(first_shown(counters).field);
    return read(text, {{"counter", first},
                       {"titles", {{"counters", titles}}},
                       {"x_title", titles[first]},
                       {"drawable",
                        "datum.u_error > 0 && isFinite(datum.u_error) && datum.cost > 0 && "
                        "indexof(hidden, datum.method) < 0"}});
  };
  Json all{{"response", read(assets::response_vl_json, Json::object())},
           {"convergence", read(assets::convergence_vl_json, Json::object())},
           {"history", read(assets::history_vl_json, Json::object())}};
  if (const auto counters = counters_of(record); !counters.empty())
    all["work"] = counted(assets::work_vl_json, counters, "");
  if (const auto counters = counters_of(record.profiles); !counters.empty())
    all["profile"] = counted(assets::profile_vl_json, counters, "times the least ");
  return all;
}

}  // namespace clackers::report
