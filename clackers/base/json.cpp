#include "clackers/base/json.hpp"

#include <nlohmann/json.hpp>

namespace clackers {

using Json = nlohmann::ordered_json;

Json parse_json(std::string_view text, const JsonWatch& watch) {
  if (!watch) return Json::parse(text);
  return Json::parse(text, [&](int depth, Json::parse_event_t event, const Json&) {
    watch(depth, event == Json::parse_event_t::array_start);
    return true;
  });
}

std::string json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string json_quoted(std::string_view text) { return json_text(Json(text)); }

std::string valid_utf8(std::string_view text) {
  return parse_json(json_quoted(text)).get<std::string>();
}

}  // namespace clackers
