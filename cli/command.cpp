#include "cli/command.hpp"

#include <algorithm>
#include <utility>

namespace clackers::cli {

std::vector<std::string> Option::values() const {
  if (const auto* const* many = std::get_if<std::vector<std::string>*>(&target)) return **many;
  const auto* const* text = std::get_if<std::string*>(&target);
  if (text == nullptr || (*text)->empty()) return {};
  return {**text};
}

Option* Option::description(std::string text) {
  explanation = std::move(text);
  return this;
}

Option* Option::option_text(std::string text) {
  placeholder = std::move(text);
  return this;
}

Option* Option::reads_file(std::string text) {
  kind = ValueKind::input_file;
  return option_text(std::move(text));
}

Option* Option::writes_file(std::string text) {
  kind = ValueKind::output_file;
  return option_text(std::move(text));
}

Option* Option::divides(const std::vector<std::string>& list, std::vector<std::size_t>& at) {
  divided = &list;
  starts = &at;
  return this;
}

namespace {

Option* add(Command& command, Option option) {
  auto& list = option.name.starts_with("--") ? command.options : command.arguments;
  return &list.emplace_back(std::move(option));
}

}  // namespace

Option* Command::add_option(std::string option, std::string& target, std::string description) {
  return add(*this, {std::move(option), &target, std::move(description)});
}

Option* Command::add_option(std::string option, std::vector<std::string>& target,
                            std::string description) {
  return add(*this, {std::move(option), &target, std::move(description)});
}

Option* Command::add_flag(std::string option, bool& target, std::string description) {
  return add(*this, {std::move(option), &target, std::move(description)});
}

Option* Command::get_option(const std::string& option) {
  return &*std::ranges::find(options, option, &Option::name);
}

void set_help(Command& command, HelpPage page) { command.page = std::move(page); }

Command* Grammar::add_subcommand(std::string name, std::string synopsis, std::string summary) {
  return &commands.emplace_back(Command{std::move(name), std::move(synopsis), std::move(summary)});
}

}  // namespace clackers::cli
