#include "clackers/input/text/text_table.hpp"

namespace clackers::input {
namespace {

constexpr std::string_view blanks = " \t\r\v\f\"";

bool is_blank(char c) { return c == ' ' || c == '\t'; }

}  // namespace

std::string_view trimmed(std::string_view text) {
  // Most fields have nothing around them.
  const auto is_bare = [](char c) { return c > ' ' && c != '"'; };
  if (!text.empty() && is_bare(text.front()) && is_bare(text.back())) return text;
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

Separation Separation::of(std::string_view row) {
  row = trimmed(row);
  if (row.find(';') != std::string_view::npos) return Separation(';');
  // Tabs alone separate one by one, so that an empty field is one; tabs among blanks are blanks.
  if (row.find('\t') != std::string_view::npos)
    return Separation(row.find(' ') == std::string_view::npos ? '\t' : ' ');
  return Separation(row.find(',') != std::string_view::npos ? ',' : ' ');
}

void Separation::split(std::string_view line, std::vector<std::string_view>& fields) const {
  fields.clear();
  if (mark_ == ' ') {
    const char* at = line.data();
    const char* const end = at + line.size();
    while (true) {
      while (at != end && is_blank(*at)) ++at;
      if (at == end) return;
      const char* const begin = at;
      while (at != end && !is_blank(*at)) ++at;
      fields.emplace_back(begin, static_cast<std::size_t>(at - begin));
    }
  }
  for (bool more = true; more;) {
    const auto end = line.find(mark_);
    more = end != std::string_view::npos;
    const auto field = trimmed(line.substr(0, end));
    if (more || !field.empty()) fields.push_back(field);
    if (more) line.remove_prefix(end + 1);
  }
}

}  // namespace clackers::input
