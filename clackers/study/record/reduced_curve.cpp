#include "clackers/study/reduced_curve.hpp"

namespace clackers::study {

Curve reduced(const Curve& curve, std::size_t most) {
  const auto value = [&](std::size_t row, std::size_t i) { return curve.y[row][i]; };
  Curve out;
  out.y.resize(curve.y.size());
  for (const auto i : kept_points(curve.t.size(), curve.y.size(), value, most)) {
    out.t.push_back(curve.t[i]);
    for (std::size_t row = 0; row < curve.y.size(); ++row) out.y[row].push_back(curve.y[row][i]);
  }
  return out;
}

}  // namespace clackers::study
