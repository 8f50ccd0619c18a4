#include "cli/help/help.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>

#include "cli/text.hpp"

namespace clackers::cli {
namespace {

constexpr std::size_t width = 80, column = 24;

std::string described(const std::string& name, const std::string& description) {
  auto line = "  " + name;
  if (line.size() + 1 > column)
    line.append("\n").append(column, ' ');
  else
    line.resize(column, ' ');
  return line + wrap(description, width, column) + "\n";
}

class Formatter : public CLI::Formatter {
 public:
  explicit Formatter(HelpPage page) : page_(std::move(page)) {}
  const HelpPage& page() const { return page_; }

  std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const override {
    std::string arguments, options;
    for (const auto* option : app->get_options()) {
      const auto text =
          described(make_option_name(option, option->get_positional()) +
                        (option->get_option_text().empty() ? "" : " ") + option->get_option_text(),
                    option->get_description());
      (option->get_positional() ? arguments : options) += text;
    }
    return app->get_description() + (arguments.empty() ? "" : "\nArguments\n" + arguments) +
           "\nOptions\n" + options;
  }

 private:
  HelpPage page_;
};

}  // namespace

void set_help(CLI::App& command, const HelpPage& page) {
  std::string text;
  for (const auto& [head, body] :
       {std::pair{"Examples", page.examples}, {"", page.about}, {"Usage", page.usage}}) {
    if (body.empty()) continue;
    if (!text.empty()) text += "\n";
    if (*head != '\0') text += fmt::format("{}\n", head);
    text += *head != '\0' ? body : wrap(body, width);
    if (text.back() != '\n') text += "\n";
  }
  command.description(text);
  command.formatter(std::make_shared<Formatter>(page));
}

const HelpPage& help_page(const CLI::App& command) {
  return dynamic_cast<const Formatter&>(*command.get_formatter()).page();
}

}  // namespace clackers::cli
