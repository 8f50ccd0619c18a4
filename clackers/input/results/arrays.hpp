#pragma once

#include <functional>
#include <string>
#include <vector>

#include "clackers/input/results/result_reader.hpp"

namespace clackers::input {

inline constexpr std::size_t most_array_bytes = std::size_t{1} << 31;

/// An array of a file, the last index of its shape runs fastest.
struct NamedArray {
  std::string name;
  std::vector<std::size_t> shape;
  std::vector<double> values;
};

/// Whether rows_of() uses an array of that name.
bool is_history_array(const std::string& name);

/// The arrays t or time, u, v, a (a column a mass), u1 or u[1], ..., and MBDyn's node.struct.LABEL.X, .XP and
/// .XPP, in any group, as rows. Whichever axis is as long as t is that of time; a single
/// number is left out. Throws InputError
/// (not-an-array) where none is there or lengths differ, (no-column) as NodeRows does.
ResultRows rows_of(const std::string& file, const std::vector<NamedArray>& arrays,
                   const ResultChoice& choice);

/// A function of a library of the system, opened when it is first asked for, so that the command needs neither
/// the library nor time for it at its start; of its file names the first that is there. Throws FileError
/// (cannot-read) with the package of Debian 12 to install.
void* library_function(const std::string& file, const std::vector<const char*>& libraries,
                       const std::string& package, const char* name);

/// Runs `work` in a process of its own, so that a library that fails on a damaged file ends only that. Throws
/// InputError (not-an-array) with the message of an exception in it, or when it ends otherwise or takes
/// more than a minute; Error (interrupted) when Ctrl-C ended it.
std::vector<NamedArray> in_own_process(const std::string& file,
                                       const std::function<std::vector<NamedArray>()>& work);

}  // namespace clackers::input
