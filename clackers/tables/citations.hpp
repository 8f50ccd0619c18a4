#pragma once

#include <span>
#include <string>

#include "clackers/record/record.hpp"

namespace clackers::tables {

/// What is used: methods and cases, as subjects of records name them, or by name.
struct Used {
  std::vector<std::string> methods, cases;
  std::vector<std::string> others;  ///< programs and histories, whose authors are not known here
};

/// Those of a record, each once.
Used used_in(const record::Record& record);
/// Methods ("newmark+penalty") and cases by name. Throws InputError (unknown-name).
Used used_of(std::span<const std::string> names);

/// BibTeX of the program, the paper, and the sources on the cards of the methods; what has none is named
/// in a comment.
std::string bibtex(const Used& used);

}  // namespace clackers::tables
