#pragma once

#include <string>

#include "clackers/study/record.hpp"

namespace clackers::report {

/// A floating table around its rows: what wrote it as comments, caption, label, rules of booktabs,
/// notes below. All texts are LaTeX already.
struct LatexFrame {
  std::string caption;
  std::string label;    ///< of the case; its unsafe characters are replaced
  std::string columns;  ///< of tabular
  std::string heading;  ///< lines of rows above the middle rule
  std::string rows;
  std::string notes;  ///< paragraphs, empty for none
};
std::string latex_table(const LatexFrame& frame, const study::Provenance& from);

/// A name that may be broken behind "+", ":", "," and "/", in typewriter.
std::string latex_name(std::string_view name);

/// "$2.00 \pm 0.01$", or "--" where there is no line.
std::string latex_order(const assess::LadderFit& fit);

}  // namespace clackers::report
