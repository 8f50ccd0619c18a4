#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <iterator>
#include <vector>

namespace clackers::measure {

inline std::vector<double> entries(const Eigen::VectorXd& vector) {
  return {vector.data(), vector.data() + vector.size()};
}

/// The upper median; `values` must not be empty.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace clackers::measure
