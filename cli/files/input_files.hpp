#pragma once

#include <string>
#include <vector>

#include "clackers/record/record.hpp"

namespace clackers::cli {

/// The times [s] of a text file with one a line; "-" reads standard input. Empty lines, and what
/// follows # or %, are skipped. Throws InputError, with the number of the line, for what is no
/// number or lies outside [0, end], and when there is none at all; FileError when the file cannot
/// be read; Interrupted.
std::vector<double> read_times(const std::string& path, double end);

/// The record of an earlier `verify --format json`; "-" reads standard input. Throws FileError when
/// the file cannot be read, InputError with its name and the place when it is no such record;
/// Interrupted.
record::Record read_baseline(const std::string& path);

}  // namespace clackers::cli
