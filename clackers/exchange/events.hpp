#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "clackers/model/trajectory.hpp"

namespace clackers::exchange {

/// Reads a list of collisions: a column t and, where they are known, impulse, u1, v1-, v1+, u2, ...
/// (v-, v+ for one mass), named by a header; a file of one column needs none. Other columns are left
/// out. What is not given of a collision is NaN; a quantity that no mass has is an empty vector. A
/// header without rows: there were no collisions.
///
/// Throws InputError as read_history does, and for times that descend; FileError when the file
/// cannot be read.
std::vector<model::Impact> read_events(const std::string& path, int dof,
                                       const std::atomic<bool>* interrupt = nullptr);

}  // namespace clackers::exchange
