#pragma once

#include <optional>

#include "clackers/diagnose/file/start/first_row.hpp"

namespace clackers::diagnose {

/// The reading of the file (units, signs, exchanges) under which the first row is the case's; of
/// several the one that the rows of the first flight prefer, else the one believed first.
std::optional<Diagnosis> start_as_reading(const FirstRow& row);

/// The state of the case at another time.
std::optional<Diagnosis> start_as_shift(const FirstRow& row);

}  // namespace clackers::diagnose
