#include "clackers/base/files/json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "clackers/base/error.hpp"

namespace clackers {

using Json = nlohmann::ordered_json;

Json parse_json(std::string_view text, const JsonWatch& watch) {
  using Event = Json::parse_event_t;
  std::vector<int> members;  // of the open objects, by depth
  return Json::parse(text, [&](int depth, Event event, const Json&) {
    if (event == Event::object_start) members.resize(std::size_t(depth) + 2, 0), members.back() = 0;
    if (event == Event::key && ++members[std::size_t(depth)] > most_members)
      throw InputError(fmt::format("a JSON object has more than {} members", most_members),
                       "bad-syntax");
    if (watch) watch(depth, event == Event::array_start);
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
