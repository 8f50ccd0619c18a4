#include <fmt/format.h>

#include <algorithm>

#include "clackers/report/changes.hpp"
#include "clackers/report/html_parts.hpp"
#include "clackers/report/markup.hpp"

namespace clackers::report {
namespace {

// A link to the method's section, or the bare name of one that is gone.
std::string linked(const study::Record& record, const std::string& name) {
  const auto found = std::ranges::find(record.methods, name, &study::MethodResult::name);
  if (found == record.methods.end()) return escape(name);
  return fmt::format("<a href=\"#{}\">{}</a>", anchor(std::size_t(found - record.methods.begin())),
                     escape(name));
}

}  // namespace

std::string changes_html(const study::Record& record, const study::BaselineComparison& changes) {
  auto out = fmt::format("<p>{}</p>\n", escape(change_summary(changes)));
  std::string rows;
  for (const auto& text : change_texts(changes)) {
    rows += fmt::format("<dt>{}</dt><dd><ul>", linked(record, text.method));
    for (const auto& sentence : text.sentences)
      rows += fmt::format("<li>{}</li>", escape(sentence));
    rows += "</ul></dd>\n";
  }
  if (!rows.empty()) out += "<dl class=\"changes\">\n" + rows + "</dl>\n";
  return out;
}

}  // namespace clackers::report
