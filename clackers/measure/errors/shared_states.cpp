#include "clackers/measure/errors/shared_states.hpp"

#include <algorithm>
#include <cstring>

namespace clackers::measure {

bool GridStates::holds(std::size_t first, std::span<const double> times) const {
  return first + times.size() <= t.size() &&
         std::memcmp(&t[first], times.data(), times.size_bytes()) == 0;
}

void GridStates::fill(const model::Motion& reference, double start, double h, std::size_t steps,
                      std::size_t first, std::size_t row) {
  const auto dof = static_cast<std::size_t>(reference.dof());
  t.resize(row + (first > steps ? 0 : std::min(most, steps + 1 - first)));
  u.resize(t.size() * dof);
  v.resize(u.size());
  for (auto k = row; k < t.size(); ++k) t[k] = start + double(first - row + k) * h;
  if (first <= steps && steps < first + most) t.back() = reference.end();
  const auto part = [&](std::vector<double>& all) { return std::span(all).subspan(row * dof); };
  reference.sample(std::span(t).subspan(row), model::Side::right, {part(u), part(v), {}});
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
  const auto dof = static_cast<std::size_t>(reference_->dof());
  states.t.reserve(steps + 1);
  for (auto* part : {&states.u, &states.v}) part->reserve((steps + 1) * dof);
  for (std::size_t first = 0; first <= steps; first += GridStates::most)
    states.fill(*reference_, start_, h, steps, first, first);
  return states;
}

}  // namespace clackers::measure
