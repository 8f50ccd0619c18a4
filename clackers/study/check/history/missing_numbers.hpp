#pragma once

#include <atomic>

#include "clackers/cases/case.hpp"
#include "clackers/input/source.hpp"
#include "clackers/study/check/history/prepared_history.hpp"

namespace clackers::study {

/// Reads the collisions of a history; those outside it are left out, with a note. Where two masses
/// touch, the place of one gives that of the other. Throws as input::read_events() does.
void add_events(PreparedHistory& history, const input::Source& events, const cases::Case& problem,
                const std::atomic<bool>* interrupt);

/// Displacements that the history has not are those of the reference, so that they add no error.
void complete_u(PreparedHistory& history, const cases::Case& problem);

}  // namespace clackers::study
