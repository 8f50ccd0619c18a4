#include "clackers/campaign/specification.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace clackers::campaign {
namespace {

bool is_sampled(const CaseSystems& systems, const Axis& axis) {
  return axis.is_range() && systems.sample.kind != SampleKind::grid;
}

}  // namespace

double Axis::at(double share) const {
  if (share <= 0.0) return from;
  if (share >= 1.0) return to;
  return is_log ? from * std::pow(to / from, share) : from * (1.0 - share) + to * share;
}

ParameterValue Axis::value(long long i) const {
  if (!is_range()) return listed.at(static_cast<std::size_t>(i));
  if (i == 0 || i == points - 1) return at(i == 0 ? 0.0 : 1.0);
  // Whole numbers stay whole.
  if (!is_log) return (from * double(points - 1 - i) + to * double(i)) / double(points - 1);
  return at(double(i) / double(points - 1));
}

long long CaseSystems::size() const {
  long long count = 1;
  bool any_sampled = false;
  for (const auto& axis : axes)
    if (is_sampled(*this, axis))
      any_sampled = true;
    else
      count *= axis.size();
  return any_sampled ? count * sample.points : count;
}

Settings CaseSystems::settings(long long i) const {
  Settings values(axes.size());
  const bool any_sampled =
      std::ranges::any_of(axes, [&](const Axis& axis) { return is_sampled(*this, axis); });
  if (any_sampled) {
    const auto dimensions = static_cast<std::size_t>(
        std::ranges::count_if(axes, [&](const Axis& axis) { return is_sampled(*this, axis); }));
    const auto point = sample_point(sample, dimensions, i % sample.points);
    i /= sample.points;
    std::size_t dimension = 0;
    for (std::size_t a = 0; a < axes.size(); ++a)
      if (is_sampled(*this, axes[a])) values[a] = {axes[a].name, axes[a].at(point[dimension++])};
  }
  for (auto a = axes.size(); a-- > 0;) {
    if (is_sampled(*this, axes[a])) continue;
    values[a] = {axes[a].name, axes[a].value(i % axes[a].size())};
    i /= axes[a].size();
  }
  return values;
}

System Specification::system(long long number) const {
  if (number < 0 || number >= systems_) throw std::out_of_range("no system of this number");
  const auto& entry = *std::prev(std::ranges::upper_bound(cases_, number, {}, &CaseSystems::first));
  return {number, entry.name, entry.settings(number - entry.first)};
}

std::vector<std::string> Specification::parameters() const {
  std::vector<std::string> names;
  for (const auto& entry : cases_)
    for (const auto& axis : entry.axes)
      if (std::ranges::find(names, axis.name) == names.end()) names.push_back(axis.name);
  return names;
}

}  // namespace clackers::campaign
