#include <fmt/format.h>

#include <cmath>

#include "clackers/report/format.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {

std::string requirement_text(const record::Record& record, const record::Requirement& requirement,
                             const std::vector<record::Unmet>& unmet) {
  std::string list;
  for (const auto& miss : unmet) {
    auto found = miss.found;
    if (!std::isnan(miss.value))
      found += miss.found == "order" ? fmt::format(" {:.2f}", miss.value)
                                     : ' ' + short_number(miss.value, 2);
    const auto where = record.cases.size() > 1 ? fmt::format(" on {}", miss.case_name) : "";
    list += fmt::format("{}{}{} ({})", list.empty() ? "" : ", ", miss.subject, where, found);
  }
  return fmt::format("Required: {}. Not met by {} of {}: {}.", requirement.text, unmet.size(),
                     record::counts(record).total(), list);
}

}  // namespace clackers::report
