#include "cli/values.hpp"

#include "clackers/report/words/words.hpp"
#include "cli/messages.hpp"

namespace clackers::cli {

void add_require_option(Command& command, std::vector<std::string>& requirements) {
  command
      .add_option(
          "--require", requirements,
          "Exit code 1 unless every subject fulfils this: agrees; an order of at least p, "
          "order:p; an error in u of the finest level of at most x, error:x; or a "
          "behaviour such as proper. Refused methods and undecided or contradicted claims never "
          "do. May be repeated; all must be fulfilled.")
      ->option_text("WHAT");
}

std::vector<record::Requirement> read_requirements(const std::vector<std::string>& options) {
  std::vector<record::Requirement> all;
  for (const auto& text : options) all.push_back(record::requirement_from(text));
  return all;
}

int required_exit_code(const record::Record& record,
                       const std::vector<record::Requirement>& requirements) {
  for (const auto& requirement : requirements)
    if (const auto missing = record::unmet(record, requirement); !missing.empty())
      note(report::requirement_text(record, requirement, missing));
  return record::exit_code(record, requirements);
}

}  // namespace clackers::cli
