#pragma once

#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/report/write.hpp"

namespace clackers::report {

inline std::string written(const record::Record& record, Format format, const Style& style = {},
                           const study::BaselineComparison* changes = nullptr) {
  std::ostringstream out;
  write(record, format, out, style, changes);
  return out.str();
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

inline bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

inline std::size_t occurrences(std::string_view text, std::string_view part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != text.npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

}  // namespace clackers::report
