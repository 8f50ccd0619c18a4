#pragma once

#include <string>
#include <vector>

namespace clackers::paper {

/// What the paper leaves open, and our answer with its proof.
struct Answer {
  std::string question;
  std::string answer;              ///< with numbers computed here
  std::vector<std::string> proof;  ///< paragraphs
};

std::vector<Answer> answers();

}  // namespace clackers::paper
