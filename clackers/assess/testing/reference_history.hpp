#pragma once

#include <utility>
#include <vector>

#include "clackers/model/motion.hpp"
#include "clackers/model/trajectory.hpp"

// Histories to be spoilt by hand, for tests.
namespace clackers::assess {

/// The motion itself at these times, accelerations and an empty list of impacts included; of two
/// equal times the first is the left limit.
inline model::Trajectory history_of(const model::Motion& reference, std::vector<double> times) {
  model::Trajectory history;
  history.dof = reference.dof();
  history.t = std::move(times);
  history.impacts.emplace();
  for (std::size_t i = 0; i < history.t.size(); ++i) {
    const bool left = i + 1 < history.t.size() && history.t[i + 1] == history.t[i];
    const auto now = reference.at(history.t[i], left ? model::Side::left : model::Side::right);
    history.u.insert(history.u.end(), now.u.begin(), now.u.end());
    history.v.insert(history.v.end(), now.v.begin(), now.v.end());
    history.a.insert(history.a.end(), now.a.begin(), now.a.end());
  }
  return history;
}

}  // namespace clackers::assess
