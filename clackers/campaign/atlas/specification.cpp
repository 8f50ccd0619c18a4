#include "clackers/campaign/atlas.hpp"

namespace clackers::campaign {

std::string_view atlas_specification() {
  return R"(# The atlas: every method of `clackers list pairs` on pairs over a grid of their parameters, and
# on the systems beyond the pair.
methods = ["all"]

[ladder]
levels = 8
samples_per_level = 4

# The paper's class by its three parameters: how much faster mass 2 is (4 N + 1), damping.
[[cases]]
case = "three-parameter"
set = { N = [0, 1, 2, 4], xi1 = [0.0, 0.05, 0.1, 0.2] }

# The same class with impacts that take energy; X = 4 N + 1.
[[cases]]
case = "synchronized-pair"
set = { X = [5, 9], xi1 = [0.0, 0.1], eta = [0.5, 0.9] }

[[cases]]
case = "stop"
set = { eta = [0.5, 1.0] }

[[cases]]
case = "buildings"
set = { left = [1, 3], eta = [0.6, 1.0] }

[[cases]]
case = "row"
set = { masses = [3] }

[[cases]]
case = "alternating"

[[cases]]
case = "cradle"

[[cases]]
case = "assembly"
set = { coupling = ["chain", "block"] }

[[cases]]
case = "forced-pair"

[[cases]]
case = "base-excited-pair"

[[cases]]
case = "penalized-pair"

[[cases]]
case = "piecewise"
)";
}

}  // namespace clackers::campaign
