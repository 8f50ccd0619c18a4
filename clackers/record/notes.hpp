#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clackers/record/record.hpp"

namespace clackers::record {

/// A code of Note: what it says, and what its numbers and its text are.
struct NoteEntry {
  std::string_view code, meaning;
  std::string_view numbers;  ///< in their order, "; " between them; empty for none
  std::string_view text;     ///< empty for none
};

// clang-format off
inline constexpr auto note_entries = std::to_array<NoteEntry>({
    // Of the file.
    {"columns-from-comment", "the names of the columns stand in the comment above the rows", "", ""},
    {"columns-not-used", "columns that were left out", "", "their names, \", \" between them"},
    {"velocities-incomplete", "velocities of some masses only, left out", "", ""},
    {"accelerations-incomplete", "accelerations of some masses only, left out", "", ""},
    {"last-line-incomplete", "the last line has no line feed: the file may be cut, and so its last number", "number of the line", ""},
    {"no-times", "the file has no times: rows are a step apart", "step [s]; time of the first row [s]: 0 where it is the initial state, else one step", ""},
    {"step-in-name-ignored", "the number in the name is longer than the time between rows, so it is not the step", "the number; time between rows [s]", ""},
    {"rows-closer-than-step", "the step is the one in the name: rows are closer, as of dense or resampled output", "the step [s]; time between rows [s]", ""},
    {"displacements-incomplete", "without the displacements of all masses neither impacts nor metrics are measured", "", ""},
    {"events-outside", "impacts of the events file outside the history, left out", "how many; first time of the history [s]; last [s]", "the events file"},
    // Of the numbers in it.
    {"printed-digits", "printing alone may make an error in u", "digits of the column; 1 for numbers of single precision, else 0; the error in u that printing may make; u_error over that; the largest ratio at which u_error is not measured but printed", "the column"},
    {"few-rows-a-period", "between rows the fast mass leaves the straight line", "rows a fast period; largest departure over the amplitude", ""},
    {"no-impacts", "the case has no impact before the history ends, and the history has none", "", ""},
    {"impacts-not-stated", "no row of the problem states where the impacts are: none are counted", "", ""},
    {"no-impacts-reported", "the events file has no impact", "impacts of the case", ""},
    {"impacts-from-history", "no events file: impacts were found in the history", "time between rows [s]; 1 where rows are close enough to find them, else 0; impacts found; impacts of the case; contact time [s], 0 for instants", ""},
    // Of its ends.
    {"starts-late", "the first row is not at the start", "its time [s]", ""},
    {"rows-beyond-end", "rows after the end of the case, left out", "how many; end of the case [s]", ""},
    {"ends-early", "the history ends before the case", "its last time [s]; end of the case [s]", ""},
    {"reused", "an earlier call of a program has made the history", "", ""},
    {"start-differs", "the initial state differs from the case's by more than the printed digits explain", "the difference over the envelope", ""},
});
// clang-format on

using NoteCode = NameOf<note_entries>;

inline Note note(NoteCode code, std::vector<double> numbers = {}, std::string text = {}) {
  return {std::string(code.name()), std::move(numbers), std::move(text)};
}

}  // namespace clackers::record
