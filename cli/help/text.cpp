#include "cli/help/text.hpp"

#include <algorithm>

namespace clackers::cli {
namespace {

constexpr std::string_view plain =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:=,+@%";

std::string quoted(const std::string& argument) {
  if (!argument.empty() && argument.find_first_not_of(plain) == std::string::npos) return argument;
  std::string out = "'";
  for (const char c : argument) c == '\'' ? out += "'\\''" : out += c;
  return out + "'";
}

}  // namespace

std::string wrap(std::string_view text, std::size_t width, std::size_t indent) {
  std::string out;
  std::size_t column = indent;
  while (!text.empty()) {
    const auto length = std::min(text.find_first_of(" \n"), text.size());
    const auto word = text.substr(0, length);
    if (!word.empty()) {
      if (column > indent && column + 1 + word.size() > width) {
        out.append("\n").append(indent, ' ');
        column = indent;
      } else if (column > indent) {
        out.append(" ");
        ++column;
      }
      out.append(word);
      column += word.size();
    }
    if (length < text.size() && text[length] == '\n') {
      out.append("\n").append(indent, ' ');
      column = indent;
    }
    text.remove_prefix(std::min(length + 1, text.size()));
  }
  return out;
}

std::string shell_line(std::span<const std::string> arguments) {
  std::string line;
  for (const auto& argument : arguments) {
    if (!line.empty()) line += ' ';
    line += quoted(argument);
  }
  return line;
}

}  // namespace clackers::cli
