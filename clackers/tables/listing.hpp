#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clackers/cases/case.hpp"
#include "clackers/record/sheet.hpp"

namespace clackers::tables {

/// What `clackers list KIND` shows; KIND is cases, integrators, contacts, methods, pairs,
/// metrics or diagnoses. Throws InputError with did-you-mean for any other.
record::Sheet list(std::string_view kind);

/// What `kind` may be, in the order of the help.
std::vector<std::string> list_kinds();

/// What `clackers show NAME` shows of a case: parameters, derived constants, indicators, margin,
/// first impacts, and of a pair the harmonics and when disturbances make it lose synchrony.
std::vector<record::Sheet> show_case(std::string_view name, const cases::Settings& settings,
                                     double threshold);

/// What `clackers show NAME --format json` has beside it, and the programs of verify --exec read: the
/// text of its members `problem` and, of a mesh, `mesh` (model/problem_file.hpp).
std::string show_problem(std::string_view name, const cases::Settings& settings);

/// What `clackers show NAME` shows of a method: its claim, parameters and card. The card is a
/// sheet of one text column.
std::vector<record::Sheet> show_method(std::string_view specification);

/// What `clackers explain [CODE]` shows; an empty code lists all.
record::Sheet explain(std::string_view code);

}  // namespace clackers::tables
