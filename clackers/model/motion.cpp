#include "clackers/model/motion.hpp"

namespace clackers::model {

Kinematics Motion::peak() const {
  constexpr int parts = 1024;
  auto largest = envelope(0.0);
  for (int i = 1; i <= parts; ++i) {
    const auto now = envelope(end() * i / parts);
    for (const auto part : {&Kinematics::u, &Kinematics::v, &Kinematics::a})
      largest.*part = (largest.*part).cwiseMax(now.*part);
  }
  return largest;
}

}  // namespace clackers::model
