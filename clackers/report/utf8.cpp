#include "clackers/report/utf8.hpp"

#include <nlohmann/json.hpp>

namespace clackers::report {

std::string valid_utf8(std::string_view text) {
  // The writer of json replaces them.
  const nlohmann::json json{std::string(text)};
  const auto valid = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return nlohmann::json::parse(valid)[0].get<std::string>();
}

}  // namespace clackers::report
