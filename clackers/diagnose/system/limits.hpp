#pragma once

#include <vector>

#include "clackers/diagnose/diagnosis.hpp"
#include "clackers/diagnose/system/fit_files.hpp"

namespace clackers::diagnose {

/// Frequencies and damping of the files' own fits: what of them remains at h -> 0 differs from the
/// case, what falls with a power of the step is the method's error of period.
std::vector<Diagnosis> smooth_limits(const FitQuestion& question);

}  // namespace clackers::diagnose
