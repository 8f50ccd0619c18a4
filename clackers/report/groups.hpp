#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/record/record.hpp"
#include "clackers/report/words/words.hpp"

// In which order outputs for people show what was assessed on a case.
namespace clackers::report {

/// Subjects under one heading.
struct SubjectGroup {
  std::string
      treatment;  ///< "penalty:law=hertz"; of methods that bring their own and of programs ""
  std::vector<const record::Subject*> subjects;
  bool is_headed = false;  ///< false: the only group, in the order of the record
};

/// More methods than this stand in groups by contact treatment.
inline constexpr std::size_t most_ungrouped = 10;

/// The subjects of a case in groups, the worst first in each, and the groups by their worst: what
/// disagrees, stays undecided, was interrupted, claims nothing, agrees; of these the larger error in
/// u first; then what was refused. Few subjects are one group, in the order of the record. `only`
/// holds the verdict words to show; empty: all.
std::vector<SubjectGroup> groups_of(const record::CaseRecord& problem,
                                    const std::vector<std::string>& only = {});

/// "penalty, 45 methods"; "standalone methods, 1 method".
std::string heading_of(const SubjectGroup& group);
/// The name of a method without the treatment of its group.
std::string name_in(const SubjectGroup& group, const record::Subject& subject);

/// A finding of one subject, or of several that have it for the same reason.
struct NamedFinding {
  const record::Subject* subject;
  std::string who;  ///< "newmark+penalty", "newmark+penalty and 44 more with penalty"
  Finding finding;
};

/// What `findings` says of the subjects of the groups, in their order. Under headings, what has the
/// same verdict and the same code with the same treatment, whatever its parameters, is said once, in
/// the words for the first of them.
std::vector<NamedFinding> named_findings(
    const std::vector<SubjectGroup>& groups,
    const std::function<std::vector<Finding>(const record::Subject&)>& findings);

}  // namespace clackers::report
