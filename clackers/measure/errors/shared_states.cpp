#include "clackers/measure/errors/shared_states.hpp"

#include <cstring>

namespace clackers::measure {

bool GridStates::holds(std::size_t first, std::span<const double> times) const {
  return first + times.size() <= t.size() &&
         std::memcmp(&t[first], times.data(), times.size_bytes()) == 0;
}

const GridStates* SharedStates::of(double h, long long steps) {
  const auto count = static_cast<std::size_t>(steps);
  Entry* entry = nullptr;
  {
    const std::lock_guard lock(guard_);
    const auto numbers = (count + 1) * (1 + 2 * static_cast<std::size_t>(reference_->dof()));
    if (const auto known = kept_.find({h, steps}); known != kept_.end()) {
      entry = &known->second;
    } else {
      if (numbers > most_numbers - numbers_) return nullptr;
      numbers_ += numbers;
      entry = &kept_[{h, steps}];
    }
  }
  std::call_once(entry->once, [&] { entry->states = make(h, count); });
  return &entry->states;
}

GridStates SharedStates::make(double h, std::size_t steps) const {
  GridStates states;
  states.t.resize(steps + 1);
  for (std::size_t k = 0; k < steps; ++k) states.t[k] = start_ + double(k) * h;
  states.t[steps] = reference_->end();
  states.u.resize(states.t.size() * static_cast<std::size_t>(reference_->dof()));
  states.v.resize(states.u.size());
  reference_->sample(states.t, model::Side::right, {states.u, states.v, {}});
  return states;
}

}  // namespace clackers::measure
