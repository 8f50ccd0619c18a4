#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/help/reference.hpp"

namespace clackers::cli {

/// What may stand where a placeholder stands.
struct Completion {
  bool files = false;              ///< names of files, of folders too
  std::vector<std::string> words;  ///< these words
};

/// What completes a value of `item`, a part of `command`: "a|b" are the words themselves, CASE,
/// METHOD, FIGURE, CODE and BEHAVIOUR the names that the program knows, FILE and FOLDER files; a placeholder
/// that the usage writes out ("[cases|methods]") is what stands there. Numbers complete to nothing.
Completion completion_of(const ReferenceItem& item, const Reference& command);

/// "name=" for each parameter of a case, in its order; by case.
struct CaseWords {
  std::string name;
  std::vector<std::string> words;
};
std::vector<CaseWords> case_words();

/// Completion for bash as a file to source, and for zsh as an autoloaded function. The first of
/// `references` is the program itself.
std::string bash_completion(std::span<const Reference> references);
std::string zsh_completion(std::span<const Reference> references);

}  // namespace clackers::cli
