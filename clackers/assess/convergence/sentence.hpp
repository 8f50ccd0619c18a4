#pragma once

#include <string>
#include <string_view>

#include "clackers/assess/convergence/assessment.hpp"
#include "clackers/base/judgement.hpp"

namespace clackers::assess {

/// What was measured, in words with its numbers: "The displacement error falls as h^2.00 (+- 0.01)
/// from h = 0.025 s to 0.0002 s". `what` is the quantity of the ladder.
std::string describe(const LadderFit& fit, std::string_view what = "displacement error");

/// A claim in words: "proper of order 2", "irregular with an envelope of order 1", "nothing".
std::string describe(const Claim& claim);

}  // namespace clackers::assess
