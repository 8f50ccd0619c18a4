#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "clackers/base/error.hpp"
#include "clackers/base/json.hpp"
#include "clackers/campaign/atlas.hpp"

namespace clackers::campaign {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view family = "clackers/atlas-results/";
constexpr std::string_view schema = "clackers/atlas-results/1";

Json cell_json(const record::Cell& cell) {
  if (const auto* real = std::get_if<double>(&cell))
    return std::isfinite(*real) ? Json(*real) : Json(nullptr);
  if (const auto* whole = std::get_if<long long>(&cell)) return *whole;
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return nullptr;
}

Json sheet_json(const record::Sheet& sheet) {
  Json columns = Json::array(), rows = Json::array();
  for (const auto& column : sheet.columns) columns.push_back(column.name);
  for (const auto& row : sheet.rows) {
    auto& cells = rows.emplace_back(Json::array());
    for (const auto& cell : row) cells.push_back(cell_json(cell));
  }
  return {{"columns", columns}, {"rows", rows}};
}

record::Cell cell_from(const Json& json) {
  if (json.is_null()) return {};
  if (json.is_number_integer()) return json.get<long long>();
  if (json.is_number()) return json.get<double>();
  return json.get<std::string>();  // throws for anything else
}

record::Sheet sheet_from(const Json& json, std::initializer_list<const char*> needed) {
  record::Sheet sheet;
  for (const auto& name : json.at("columns"))
    sheet.columns.push_back({name.get<std::string>(), "", ""});
  for (const auto* name : needed)
    if (std::ranges::find(sheet.columns, name, &record::Column::name) == sheet.columns.end())
      throw InputError(fmt::format("there is no column {}", name), "no-column");
  for (const auto& row : json.at("rows")) {
    auto& cells = sheet.rows.emplace_back();
    for (const auto& cell : row) cells.push_back(cell_from(cell));
    if (cells.size() != sheet.columns.size())
      throw InputError(fmt::format("row {} has {} values for {} columns", sheet.rows.size(),
                                   cells.size(), sheet.columns.size()),
                       "ragged-row");
  }
  return sheet;
}

// A cell of the matrix has one row.
void require_different(const record::Sheet& subjects) {
  std::set<std::string> seen;
  for (const auto& row : subjects.rows) {
    Json key = Json::array();
    for (std::size_t c = 0; c < row.size(); ++c)
      if (const auto& name = subjects.columns[c].name;
          name == "case" || name == "method" || name.starts_with("set_"))
        key.push_back(cell_json(row[c]));
    const auto text = json_text(key);
    if (!seen.insert(text).second)
      throw InputError(
          fmt::format("two rows of subjects are of the same system and method: {}", text),
          "bad-syntax");
  }
}

Json provenance_json(const record::Provenance& from) {
  return {{"command", from.command}, {"version", from.version},     {"compiler", from.compiler},
          {"machine", from.machine}, {"processor", from.processor}, {"date", from.date}};
}

record::Provenance provenance_from(const Json& json) {
  const auto text = [&](const char* key) { return json.at(key).get<std::string>(); };
  return {text("command"), text("version"),   text("compiler"),
          text("machine"), text("processor"), text("date")};
}

void require_schema(const Json& json, const std::string& name) {
  const auto found = json.is_object() && json.contains("schema") && json["schema"].is_string()
                         ? json["schema"].get<std::string>()
                         : std::string();
  if (found == schema) return;
  if (found.starts_with(family))
    throw InputError(fmt::format("{}: schema = {}; allowed: {}. Write the file anew with this "
                                 "version: clackers atlas --submit METHOD --out {}",
                                 name, found, schema, name),
                     "other-version");
  throw InputError(fmt::format("{}: this is no file of results for an atlas, which has \"schema\": "
                               "\"{}\". Write one: clackers atlas --submit METHOD --out FILE.json",
                               name, schema),
                   "not-a-campaign");
}

AtlasResults results_from(const Json& json) {
  AtlasResults results;
  results.origin = json.at("origin").get<std::string>();
  if (results.origin.empty()) throw InputError("origin is empty; allowed: a name", "bad-syntax");
  results.from = provenance_from(json.at("provenance"));
  results.options = json.at("options").get<std::string>();
  for (const auto& [name, call] : json.at("calls").items())
    results.calls[name] = call.get<std::string>();
  results.specification = json.at("specification").get<std::string>();
  results.subjects = sheet_from(json.at("subjects"), {"task", "case", "method", "verdict"});
  require_different(results.subjects);
  results.runs = sheet_from(json.at("runs"), {"task", "level", "u_error"});
  return results;
}

}  // namespace

std::string results_text(const AtlasResults& results) {
  Json calls = Json::object();
  for (const auto& [name, call] : results.calls) calls[name] = call;
  const Json json{{"schema", schema},
                  {"origin", results.origin},
                  {"provenance", provenance_json(results.from)},
                  {"options", results.options},
                  {"calls", calls},
                  {"specification", results.specification},
                  {"subjects", sheet_json(results.subjects)},
                  {"runs", sheet_json(results.runs)}};
  return json_text(json) + '\n';
}

AtlasResults results_from(const std::string& text, const std::string& name) {
  Json json;
  try {
    json = parse_json(text);
  } catch (const Json::exception&) {
    throw InputError(
        fmt::format("{}: this is no json; allowed: what clackers atlas --submit writes.", name),
        "bad-syntax");
  }
  require_schema(json, name);
  try {
    return results_from(json);
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: the results are damaged: {}. Write the file anew: clackers "
                                 "atlas --submit METHOD --out {}",
                                 name, error.what(), name),
                     "bad-syntax");
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: the results are damaged: {}. Write the file anew: clackers "
                                 "atlas --submit METHOD --out {}",
                                 name, error.what(), name),
                     error.code());
  }
}

}  // namespace clackers::campaign
