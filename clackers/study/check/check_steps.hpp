#pragma once

#include <optional>
#include <string_view>

namespace clackers::study {

/// The step that a file's name tells: the number behind an "h" that begins a word, as in h0.01.csv,
/// run-h=1e-3.txt or disp_h0.005.out [s]. Nothing without one, and for 0.
std::optional<double> step_in_name(std::string_view path);

}  // namespace clackers::study
