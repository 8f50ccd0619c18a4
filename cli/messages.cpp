#include "cli/messages.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "clackers/base/text.hpp"

namespace clackers::cli {
namespace {

void put_line(const std::string& text) { std::fputs((text + "\n").c_str(), stderr); }

}  // namespace

void note(std::string_view text) { put_line(printable(text)); }

void report_error(std::string_view message, std::string_view code) {
  const auto* const who = message.starts_with("clackers: ") ? "" : "clackers: ";
  const auto line = fmt::format("{}{} [{}]", who, printable(message), code);
  put_line(::isatty(STDERR_FILENO) != 0 ? wrapped(line, 80) : line);
}

}  // namespace clackers::cli
