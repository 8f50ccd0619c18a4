#include "clackers/model/motion.hpp"

#include <fmt/format.h>

#include "clackers/base/error.hpp"

namespace clackers::model {

void require_buffers(std::string_view who, const SampleBuffers& out, std::size_t times,
                     std::size_t masses) {
  const auto size = times * masses;
  if (out.u.size() != size || out.v.size() != size || (!out.a.empty() && out.a.size() != size))
    throw InputError(
        fmt::format("{}: buffers for u, v, a hold {}, {}, {} numbers; allowed: {} each, one a time "
                    "and mass (a may be empty).",
                    who, out.u.size(), out.v.size(), out.a.size(), size),
        "wrong-size");
}

void require_inside(std::string_view who, double t, double end) {
  if (!(t >= 0.0 && t <= end))
    refuse(who, "t", t, fmt::format("0 <= t <= {} (the end of the motion, in s)", end), {},
           "time-outside");
}

void require_impact(std::string_view who, long long index, long long count, double end) {
  if (index >= 1 && index <= count) return;
  throw InputError(
      fmt::format("{}: impact {} was asked for; allowed: {}.", who, index,
                  count == 0 ? std::string("none, since nothing collides up to the end")
                             : fmt::format("1 to {}, those up to t = {} s", count, end)),
      "beyond-last-impact");
}

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
