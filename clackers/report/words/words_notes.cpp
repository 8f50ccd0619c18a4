#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/record/notes.hpp"
#include "clackers/report/format.hpp"
#include "clackers/report/words/words.hpp"

namespace clackers::report {
namespace {

using record::NoteCode;

// The notes of one code.
struct Group {
  const Note* note = nullptr;        ///< of the finest history that has it
  const record::Run* run = nullptr;  ///< that history
  long long files = 0;
  bool same = true;  ///< in all of them the same sentence
};

std::string printed_digits(const Note& note, const std::vector<double>& n) {
  const bool is_single = n[1] == 1.0;
  const double share = n[3], slack = n[4];
  const auto measured =
      share > slack ? fmt::format("the measured error is {} times that", short_number(share, 3))
      : share > 1.0 ? std::string("the measured error is not significantly larger")
                    : std::string("the measured error is below that");
  return fmt::format("Printed digits: {} {}; printing alone may make an error of {} in u, and {}.",
                     note.text,
                     is_single ? std::string("holds numbers of single precision")
                               : "is printed with " + counted(std::llround(n[0]), "digit"),
                     scientific(n[2]), measured);
}

std::string impacts_from_history(const std::vector<double>& n) {
  std::string text = "No events file: impacts were found in the history itself";
  if (n[1] == 0.0)
    text += fmt::format(", but its rows, {} s apart, are too far apart for that",
                        short_number(n[0], 3));
  else if (n[2] == 0.0)
    text += fmt::format("; it has none, the case has {}", short_number(n[3], 15));
  if (n[4] > 0.0)
    text += fmt::format("; contacts last {} s: compliant, not rigid", short_number(n[4], 3));
  return text + ".";
}

}  // namespace

std::string note_text(const Note& note) {
  auto n = note.numbers;
  n.resize(std::max<std::size_t>(n.size(), 5), std::nan(""));
  const auto text = [&](std::size_t i, int digits = 6) { return short_number(n[i], digits); };
  const auto is = [&](NoteCode code) { return note.code == code.name(); };
  if (is("columns-from-comment"))
    return "The names of the columns are taken from the comment above the rows.";
  if (is("columns-not-used")) return fmt::format("Columns not used: {}.", note.text);
  if (is("velocities-incomplete"))
    return "Velocities of some masses only: velocities are not used.";
  if (is("accelerations-incomplete"))
    return "Accelerations of some masses only: accelerations are not used.";
  if (is("last-line-incomplete"))
    return fmt::format(
        "The last line, {}, has no line feed: the file may be cut, and with it its last number.",
        text(0, 15));
  if (is("no-times"))
    return fmt::format("The file has no times: rows are {} s apart, the first at {} s.", text(0),
                       text(1));
  if (is("step-in-name-ignored"))
    return fmt::format(
        "The {} in the name is longer than the time between rows, {} s, so it is not taken as the "
        "step; --steps sets it.",
        text(0), text(1));
  if (is("rows-closer-than-step"))
    return fmt::format(
        "The step is the {} s in the name; rows are {} s apart, as of dense or resampled output.",
        text(0), text(1));
  if (is("displacements-incomplete"))
    return "Impacts and metrics are not measured: they need the displacements of all masses.";
  if (is("events-outside"))
    return fmt::format("{}: {} outside the history, {} s to {} s, left out.", note.text,
                       counted(std::llround(n[0]), "impact"), text(1), text(2));
  if (is("printed-digits")) return printed_digits(note, n);
  if (is("few-rows-a-period"))
    return fmt::format(
        "Sampling: {} rows a fast period; between rows the fast mass leaves the straight line by "
        "up to {} of its amplitude.",
        text(0, 3), text(1, 2));
  if (is("impacts-not-stated"))
    return "No row of the problem states where the impacts are: none are looked for, and those of an events file are "
           "not used.";
  if (is("no-impacts"))
    return "The case has no impact before the history ends, and the history has none.";
  if (is("no-impacts-reported"))
    return fmt::format("The events file has no impact, the case has {}.", text(0, 15));
  if (is("impacts-from-history")) return impacts_from_history(n);
  if (is("starts-late")) return fmt::format("The first row is at {} s, not at the start.", text(0));
  if (is("rows-beyond-end"))
    return fmt::format(
        "{} after the end of the case, {} s, not assessed; a larger t_end or a_t includes them.",
        counted(std::llround(n[0]), "row"), text(1));
  if (is("ends-early"))
    return fmt::format(
        "The history ends at {} s, the case at {} s: the time between is not assessed.", text(0),
        text(1));
  if (is("reused")) return "The history is that of an earlier call; --fresh repeats it.";
  if (is("start-differs"))
    return fmt::format(
        "The initial state differs from the case's by {} of the envelope, more than the printed "
        "digits explain. Errors below that do not come from the method.",
        text(0, 2));
  return note.code;
}

std::vector<std::string> note_texts(const record::Subject& subject) {
  std::vector<Group> groups;
  const record::Run* finest = nullptr;
  long long files = 0;
  for (auto level = subject.levels.rbegin(); level != subject.levels.rend(); ++level)
    for (auto run = level->runs.rbegin(); run != level->runs.rend(); ++run) {
      if (!run->file) continue;
      if (finest == nullptr) finest = &*run;
      ++files;
      for (const auto& note : run->file->notes) {
        if (is_shown_cause(subject, note.code)) continue;
        auto known = std::ranges::find(groups, note.code,
                                       [](const Group& group) { return group.note->code; });
        if (known == groups.end()) known = groups.insert(known, {&note, &*run});
        ++known->files;
        known->same = known->same && note_text(note) == note_text(*known->note);
      }
    }
  std::vector<std::string> out;
  for (const auto& group : groups) {
    auto text = note_text(*group.note);
    if (group.run != finest) text = fmt::format("{}: {}", history_name(subject, *group.run), text);
    const auto others = group.files - 1;
    const bool of_all = group.same && group.files == files;
    if (others > 0 && !of_all)
      text += fmt::format(" Also in {}{}.", counted(others, "other history"),
                          group.same ? "" : ", with other numbers");
    out.push_back(std::move(text));
  }
  return out;
}

}  // namespace clackers::report
