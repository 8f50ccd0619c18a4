#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clackers/cases/case.hpp"

// The table of cases: one row a case is all that the command line, the manual and the tests know.
namespace clackers::cases {

/// The value of a parameter that the case has: a number, or by text() a word.
struct Values {
  const Settings& settings;
  const ParameterValue& operator()(std::string_view name) const { return value_of(settings, name); }
};

/// Fills problem, motion, constants, indicators and periods of a case whose entry and values are
/// set. Throws InputError for values outside their range.
using Builder = void (*)(Case& test_case, const Values& value, double threshold);

struct CaseRow {
  CaseEntry entry;
  Builder build;
};

/// Parameters that mean the same in every case.
Parameter eta();
Parameter t_end(double standard = 20.0);
/// From 1e-30 to 1e30.
Parameter positive(std::string name, double standard, const char* unit, const char* meaning);

/// The number of a parameter, from `least` to 1e30, and the end of the run. Throw InputError outside.
double within(const Case& test_case, const Values& value, const std::string& name,
              double least = 1e-30);
double end_of(const Case& test_case, const Values& value);

/// Adds the end of the run and the number of impacts up to it to the constants of a case with a motion.
void add_run(Case& test_case);

Parameter xi1();
Parameter whole_N();
Parameter scale(const char* name, double default_value, const char* unit, const char* allowed,
                const char* meaning);

/// X = 4N + 1 of Eq. (9), up to the largest ratio that the reference solution takes. Throws
/// InputError for an N that is no whole number or outside its range.
double ratio(const Case& test_case, double N);

/// Periodic motions with impacts, penalty contacts, and problems of files.
std::vector<CaseRow> orbit_rows();

/// Any number of masses whose impacts are synchronized.
std::vector<CaseRow> assembly_rows();

/// Elastic bars in contact, and their meshes.
std::vector<CaseRow> bar_rows();

/// Vibrating strings above obstacles, and their meshes.
std::vector<CaseRow> string_rows();

/// Nonlinear oscillators above a stop or against each other.
std::vector<CaseRow> elliptic_rows();

/// Masses under dry friction.
std::vector<CaseRow> friction_rows();

/// Masses that come to rest on a stop or on each other.
std::vector<CaseRow> resting_rows();

}  // namespace clackers::cases
