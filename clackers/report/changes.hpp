#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "clackers/report/write.hpp"
#include "clackers/study/baseline.hpp"

namespace clackers::report {

/// What changed of one method, a sentence a difference.
struct ChangeText {
  std::string method;  ///< its full name
  std::vector<std::string> sentences;
};
/// Methods of which nothing changed are left out.
std::vector<ChangeText> change_texts(const study::BaselineComparison& comparison);

/// "Against the baseline of 2025-11-21T09:43:00Z (clackers 0.1.0): 2 of 7 methods changed."
std::string change_summary(const study::BaselineComparison& comparison);

/// The summary and the sentences, "method: sentence", at most style.width characters a line.
void write_changes(const study::BaselineComparison& comparison, std::ostream& out,
                   const Style& style);

}  // namespace clackers::report
