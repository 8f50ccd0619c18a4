#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "clackers/input/source.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers::input {

/// Reads a list of impacts from any source: a column t and, where they are known, impulse, u1,
/// v1-, v1+, u2, ... (v-, v+ for one mass); one column alone needs no name. Other columns are left
/// out. What is not given of an impact is NaN; a quantity that no mass has is an empty vector. No
/// rows: there were no impacts. With several `contacts` a column contact names one of them, from
/// 0.
///
/// Throws InputError as read_history does, for times that descend, and for contacts that are missing
/// or none of the problem's; FileError when a file cannot be read.
std::vector<model::Impact> read_events(const Source& source, int dof, int contacts = 1,
                                       const std::atomic<bool>* interrupt = nullptr);

}  // namespace clackers::input
