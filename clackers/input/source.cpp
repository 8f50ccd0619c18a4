#include "clackers/input/source.hpp"

namespace clackers::input {

std::string name_of(const Source& source) {
  if (const auto* columns = std::get_if<NumberColumns>(&source)) return columns->name;
  const auto& path = std::get<std::string>(source);
  return path == "-" ? "standard input" : path;
}

std::string path_of(const Source& source) {
  const auto* path = std::get_if<std::string>(&source);
  return path == nullptr ? std::string() : *path;
}

std::string given_name(const Source& source) {
  const auto* columns = std::get_if<NumberColumns>(&source);
  return columns != nullptr ? columns->name : std::get<std::string>(source);
}

bool is_given(const Source& source) {
  return std::holds_alternative<NumberColumns>(source) || !std::get<std::string>(source).empty();
}

}  // namespace clackers::input
