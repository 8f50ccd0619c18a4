#include "cli/messages.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "cli/text.hpp"

namespace clackers::cli {

void note(const std::string& text) { std::fputs((text + "\n").c_str(), stderr); }

void complain(std::string_view message, std::string_view code) {
  const auto* const who = message.starts_with("clackers: ") ? "" : "clackers: ";
  const auto line = fmt::format("{}{} [{}]", who, message, code);
  note(::isatty(STDERR_FILENO) != 0 ? wrap(line, 80) : line);
}

}  // namespace clackers::cli
