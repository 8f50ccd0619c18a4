#include "clackers/study/check/initial_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clackers::study {
namespace {

void compare(StartDifference& most, const char* letter, const std::vector<double>& given,
             const Eigen::VectorXd& expected, const Eigen::VectorXd& envelope) {
  for (std::size_t j = 0; j < given.size(); ++j) {
    const auto mass = Eigen::Index(j);
    const double relative = std::abs(given[j] - expected[mass]) / envelope[mass];
    if (most.name.empty() ? !std::isnan(relative) : relative > most.relative)
      most = {fmt::format("{}{}", letter, j + 1), given[j], expected[mass], relative};
  }
}

}  // namespace

StartDifference start_difference(const FirstRow& row, const cases::Case& problem) {
  const auto& motion = *problem.motion;
  const auto reference = motion.at(std::clamp(row.t, 0.0, motion.end()), model::Side::right);
  const auto envelope = motion.peak();
  StartDifference most;
  compare(most, "u", row.u, reference.u, envelope.u);
  compare(most, "v", row.v, reference.v, envelope.v);
  return most;
}

}  // namespace clackers::study
