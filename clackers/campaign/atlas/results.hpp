#pragma once

#include <map>
#include <string>

#include "clackers/campaign/atlas.hpp"

namespace clackers::campaign {

/// What `clackers verify` is given for the ladder of a specification: "--levels 5 --samples-per-level 4".
std::string ladder_options(const Ladder& ladder);

/// How a command line names the programs of a specification, by their names in the rows
/// of `subjects`.
std::map<std::string, std::string> calls_of(const Specification& specification,
                                            const record::Sheet& subjects);

record::Sheet sheet_of(record::RowSource& rows);

}  // namespace clackers::campaign
