#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clackers/record/record.hpp"

namespace clackers::report {

/// A counter of work that a figure may show.
struct ShownCounter {
  judge::Counter counter;
  std::string_view field;  ///< name of its column: "force_evaluations"
  std::string title;       ///< "force evaluations", with the unit where there is one
};

/// The counters of which some finished run of a method has more than none, in the order of their
/// buttons.
std::vector<ShownCounter> counters_of(const record::CaseRecord& problem);
/// Those of the profiles.
std::vector<ShownCounter> counters_of(const std::vector<record::Profile>& profiles);

/// What is shown first: force evaluations where they are counted. Throws std::logic_error for none.
ShownCounter first_shown(const std::vector<ShownCounter>& counters);

/// Buttons that choose the counter of a figure; nothing for one counter.
std::string counter_choice(const std::vector<ShownCounter>& counters, std::string_view figure);

}  // namespace clackers::report
