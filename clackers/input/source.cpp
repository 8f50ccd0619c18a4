#include "clackers/input/source.hpp"

#include "clackers/base/error.hpp"
#include "clackers/base/text.hpp"

namespace clackers::input {

ResultChoice result_choice(const std::string& reader, std::vector<std::string> nodes,
                           const std::string& component, std::string_view name) {
  ResultChoice choice{.reader = reader, .nodes = std::move(nodes)};
  if (component.empty()) return choice;
  choice.coordinates = component.starts_with("coor");
  const auto direction = component.substr(choice.coordinates ? 4 : 0);
  if (direction != "1" && direction != "2" && direction != "3")
    refuse("check", name, printable(component), "1, 2, 3, coor1, coor2 or coor3");
  choice.direction = direction[0] - '0';
  return choice;
}

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
