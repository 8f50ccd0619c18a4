#pragma once

#include <string>
#include <vector>

namespace clackers {

/// The header of a NumPy file of `rows` rows of doubles with these names, which follow it row by row,
/// least byte first. It is as long as that of `most_rows` rows, which may take its place.
std::string npy_header(const std::vector<std::string>& names, long long rows,
                       long long most_rows = 0);

}  // namespace clackers
