#pragma once

#include <string>

#include "clackers/study/record.hpp"

namespace clackers::cli {

/// The record of an earlier `--format json`; "-" reads standard input. Throws FileError when the file cannot be read,
/// InputError with its name and the place when it is no such record; Interrupted.
study::Record read_baseline(const std::string& path);

}  // namespace clackers::cli
