#include "cli/help/help.hpp"

#include <fmt/format.h>

#include <array>
#include <deque>

#include "clackers/base/text.hpp"

namespace clackers::cli {
namespace {

constexpr std::size_t width = 80, column = 24;

constexpr auto codes = std::to_array<ExitCode>({
    {0, "agrees, nothing claimed, or done"},
    {1, "disagrees"},
    {2, "refused input"},
    {3, "undecided"},
    {4, "file or failure"},
    {130, "interrupted"},
});

std::string described(const Option& option) {
  auto line = "  " + heading(option);
  if (line.size() + 1 > column)
    line.append("\n").append(column, ' ');
  else
    line.resize(column, ' ');
  return line + wrapped(option.explanation, width, column) + "\n";
}

std::string section(std::string_view title, const std::deque<Option>& options) {
  std::string text;
  for (const auto& option : options) text += described(option);
  return text.empty() ? "" : fmt::format("\n{}\n{}", title, text);
}

}  // namespace

std::span<const ExitCode> exit_codes() { return codes; }

std::string heading(const Option& option) {
  const auto name = option.name == "--help" ? "-h,--help" : option.name;
  return option.placeholder.empty() ? name : name + " " + option.placeholder;
}

std::string help_text(const Command& command) {
  return fmt::format("Examples\n{}\n{}\n\nUsage\n{}{}{}", command.page.examples,
                     wrapped(command.page.about, width), command.page.usage,
                     section("Arguments", command.arguments), section("Options", command.options));
}

std::string overall_usage(const Grammar& grammar) {
  std::string text;
  for (const auto& command : grammar.commands)
    text += fmt::format("  clackers {:<8} {:<16} {}\n", command.name, command.synopsis,
                        command.summary);
  return text;
}

std::string help_text(const Grammar& grammar) {
  auto program = grammar.program;
  program.page.usage = overall_usage(grammar) +
                       "\n  clackers COMMAND --help describes it. Quantities are in SI units.\n"
                       "\nExit codes\n";
  for (const auto& [code, meaning] : exit_codes())
    program.page.usage += fmt::format("  {:<4} {}\n", code, meaning);
  return help_text(program);
}

}  // namespace clackers::cli
