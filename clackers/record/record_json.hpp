#pragma once

#include <atomic>
#include <cstddef>
#include <string>

#include "clackers/record/record.hpp"

namespace clackers::record {

/// The record as json and back (docs/schemas/record-1.json); every number reads back to the same
/// double. Json knows neither infinity nor NaN: they stand as the texts "inf", "-inf" and "nan".
std::string to_json(const Record& record);

/// The longest text that is read as a record. One takes some 100 kB a method on the default steps.
inline constexpr std::size_t longest_record = 20'000'000;  // bytes

/// Throws InputError (not-a-record) for text that is no such record: longer than `longest_record`,
/// nested deeper than a record is, a missing, misspelled or unknown field, a value of another kind,
/// another schema; Error (interrupted) when `interrupt` becomes true.
Record record_from_json(const std::string& text, const std::atomic<bool>* interrupt = nullptr);

}  // namespace clackers::record
