#include "cli/help/reference.hpp"

#include <CLI/CLI.hpp>
#include <sstream>

namespace clackers::cli {
namespace {

ReferenceItem item_of(const CLI::Option& option) {
  ReferenceItem item;
  // The positional name comes first where an option has both; ours have one of them.
  if (option.get_positional()) {
    item.names.push_back(option.get_name(true));
    item.value = option.get_option_text().empty() ? item.names.front() : option.get_option_text();
  } else {
    for (const auto& name : option.get_snames()) item.names.push_back("-" + name);
    for (const auto& name : option.get_lnames()) item.names.push_back("--" + name);
    item.value = option.get_option_text();
  }
  item.description = option.get_description();
  item.repeats = option.get_items_expected_max() > 1;
  return item;
}

}  // namespace

Reference reference_of(const CLI::App& app) {
  Reference reference{.name = app.get_parent() == nullptr ? "" : app.get_name(),
                      .page = help_page(app),
                      .arguments = {},
                      .options = {}};
  for (const auto* option : app.get_options())
    (option->get_positional() ? reference.arguments : reference.options)
        .push_back(item_of(*option));
  return reference;
}

std::string summary_of(const std::string& command, const HelpPage& overall) {
  std::istringstream lines(overall.usage);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  clackers " + command + " ")) continue;
    const auto gap = line.rfind("  ");
    return line.substr(gap + 2);
  }
  return {};
}

}  // namespace clackers::cli
