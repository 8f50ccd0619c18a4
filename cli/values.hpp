#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/record/require.hpp"
#include "cli/command.hpp"

namespace clackers::cli {

/// The number in `text`: decimal with a point, nan, inf, or a fraction of two such numbers
/// ("1/9"). `what` names it in messages ("--step", "xi1"). Throws InputError for anything else.
double read_number(std::string_view what, std::string_view text);

/// A whole number ("1000" or "1e3") within [lowest, highest], at most 2^53 in size so that a double
/// holds it; throws InputError otherwise.
long long read_whole(std::string_view what, std::string_view text, long long lowest,
                     long long highest);

/// A duration [s]: a number of seconds, or with one of the units s, min, h ("30", "30s", "2min").
/// Throws InputError for anything else and for negative or infinite ones.
double read_duration(std::string_view what, std::string_view text);

/// The parts of an option's value between commas. Throws InputError for an empty one.
std::vector<std::string> parts_of(std::string_view option, std::string_view text);

/// The values of all --set options, each "name=value,...", and the file of --problem, where it is
/// given. A value that begins with a letter, / or . is a word. Throws InputError for a part that is
/// not name=value and for a name that is set twice.
cases::Settings read_settings(const std::vector<std::string>& options,
                              const std::string& problem = {});

/// Adds --label, which may stand several times. `labels` must outlive the parsing.
void add_label_option(Command& command, std::vector<std::string>& labels);

/// The values of all --label options, each "key=value". Throws InputError for others and for a key
/// that is given twice.
record::Labels read_labels(const std::vector<std::string>& options);

/// The case of a command line: `first`, or the value of --case `behind`, or that of files where
/// --problem is given. Throws InputError where two are given and differ.
std::string case_of(const std::string& first, const std::string& behind,
                    const std::string& problem);

/// Whether a word is the name of a case.
bool is_case(const std::string& word);

/// Adds --require, which may stand several times. `requirements` must outlive the parsing.
void add_require_option(Command& command, std::vector<std::string>& requirements);

/// The values of all --require options. Throws InputError as record::requirement_from does.
std::vector<record::Requirement> read_requirements(const std::vector<std::string>& options);

/// The exit code of a record; what does not meet the requirements is named on standard error, a line
/// a requirement.
int required_exit_code(const record::Record& record,
                       const std::vector<record::Requirement>& requirements);

}  // namespace clackers::cli
