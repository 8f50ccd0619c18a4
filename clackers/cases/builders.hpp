#pragma once

#include "clackers/cases/case.hpp"

namespace clackers::cases {

/// Fills problem, motion, constants, indicators and periods of a case whose entry and values are
/// set. Throws InputError for values outside their range.
using Builder = void (*)(Case& which, double threshold);

void build_sdof(Case& which, double threshold);
void build_stop(Case& which, double threshold);
void build_symmetric_pair(Case& which, double threshold);
void build_one_parameter(Case& which, double threshold);
void build_two_parameter(Case& which, double threshold);
void build_three_parameter(Case& which, double threshold);
void build_synchronized_pair(Case& which, double threshold);
void build_exact_data_pair(Case& which, double threshold);

/// A named case and how it is made.
struct Row {
  CaseEntry entry;
  Builder build;
};

/// All cases; one row a case is the whole of what the command line, the manual and the tests know.
std::span<const Row> table();

}  // namespace clackers::cases
