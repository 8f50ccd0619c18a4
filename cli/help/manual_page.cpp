#include "cli/help/manual_page.hpp"

#include <fmt/format.h>

#include <sstream>

namespace clackers::cli {
namespace {

constexpr std::string_view exit_heading = "\nExit codes\n";

// Text as roff reads it back: no character of it is a request.
std::string literal(std::string_view text) {
  std::string out;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";  // a minus that can be copied, not a hyphen
    else
      out += c;
    at_start = c == '\n';
  }
  return out;
}

std::string section(std::string_view title, const std::string& body) {
  return body.empty() ? "" : fmt::format(".SH {}\n{}", title, body);
}

std::string with_line_end(std::string text) {
  if (!text.empty() && text.back() != '\n') text += '\n';
  return text;
}

// Lines as they stand, without the two spaces that indent them in --help.
std::string as_it_stands(const std::string& text) {
  if (text.empty()) return {};
  std::string body;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    body += line.starts_with("  ") ? line.substr(2) + '\n' : line + '\n';
  return ".nf\n" + literal(body) + ".fi\n";
}

std::string described(const ReferenceItem& item, bool positional) {
  std::string head;
  for (const auto& name : item.names) {
    if (!head.empty()) head += ", ";
    head += fmt::format("\\f{}{}\\fR", positional ? 'I' : 'B', literal(name));
  }
  if (!item.value.empty() && item.value != item.names.front())
    head += fmt::format(" \\fI{}\\fR", literal(item.value));
  return fmt::format(".TP\n{}\n{}", head, with_line_end(literal(item.description)));
}

std::string all_described(const std::vector<ReferenceItem>& items, bool positional) {
  std::string text;
  for (const auto& item : items) text += described(item, positional);
  return text;
}

}  // namespace

std::string manual_page_name(const Reference& reference) {
  return reference.name.empty() ? "clackers" : "clackers-" + reference.name;
}

std::string manual_page(std::span<const Reference> references, std::size_t which) {
  const auto& it = references[which];
  const auto name = manual_page_name(it);
  std::string title = name;
  for (auto& c : title)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');

  // The usage of the program itself ends with the exit codes, which all commands share.
  const auto& overall = references.front().page.usage;
  const auto codes = overall.find(exit_heading);
  const auto usage = it.page.usage.substr(0, it.page.usage.find(exit_heading));
  auto summary = which == 0 ? it.page.about : summary_of(it.name, references.front().page);
  if (summary.ends_with('.')) summary.pop_back();

  std::string others;
  for (const auto& other : references)
    if (&other != &it)
      others += fmt::format("{}.BR {} (1)", others.empty() ? "" : " ,\n",
                            literal(manual_page_name(other)));

  // Words are not broken: options and names are there to be copied.
  return fmt::format(".TH {} 1 \"\" \"Clackers {}\" \"Clackers\"\n.nh\n.ad l\n", literal(title),
                     CLACKERS_VERSION) +
         section("NAME", fmt::format("{} \\- {}\n", literal(name), literal(summary))) +
         section("SYNOPSIS", as_it_stands(usage)) +
         section("DESCRIPTION", with_line_end(literal(it.page.about))) +
         section("ARGUMENTS", all_described(it.arguments, true)) +
         section("OPTIONS", all_described(it.options, false)) +
         section("EXIT STATUS", codes == std::string::npos
                                    ? ""
                                    : as_it_stands(overall.substr(codes + exit_heading.size()))) +
         section("EXAMPLES", as_it_stands(it.page.examples)) + section("SEE ALSO", others + "\n");
}

}  // namespace clackers::cli
