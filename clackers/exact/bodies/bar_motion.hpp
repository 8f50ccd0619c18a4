#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "clackers/model/motion.hpp"
#include "clackers/numerics/bounded.hpp"

namespace clackers::exact {

/// What lies between two doubles is on neither side of a front for whoever asks in doubles [s].
inline double half_spacing(double t) { return 0.5 * (std::nextafter(t, INFINITY) - t); }

/// Bars, one or two that meet, or a string, as continua: what is known of each point, and of the contact.
class BarMotion {
 public:
  using Bounded = numerics::Bounded;
  struct Point {
    Bounded u, v, stress;  ///< tension is positive; of a string the transverse force T u_x [N]
  };
  struct Energy {
    Bounded kinetic, elastic, potential;  ///< the last of the weight, 0 at the start
  };

  virtual ~BarMotion() = default;

  virtual bool is_string() const { return false; }
  virtual double end() const = 0;
  /// Of each bar [m], the left one first.
  virtual std::vector<double> lengths() const = 0;
  /// At the distance x from the contact end, 0 <= x <= L, and at t in [0, end]. Across a front u is
  /// continuous; where x and t lie on a front within the spacing of doubles, `side` is meant in time.
  virtual Point at(std::size_t bar, double x, double t, model::Side side) const = 0;
  virtual Bounded force(double t, model::Side side) const = 0;
  /// The integral of the force from 0 to t; whether with an impulse at t itself, `side` decides.
  virtual Bounded impulse(double t, model::Side side) const = 0;
  /// Of all bars or the string, and of a mass that strikes one.
  virtual Energy energy(double t) const = 0;

  /// When the contact closes and opens, in turn, up to the end: the nearest doubles of the first `most` [s].
  std::vector<double> contact_changes(std::size_t most) const {
    const auto [first, period] = changes();
    std::vector<double> times;
    for (double k = 0.0; !first.empty(); ++k) {
      for (const auto& change : first) {
        const double t = (change + Bounded(k) * period).nearest();
        if (t > end() || times.size() == most) return times;
        if (times.empty() || t > times.back()) times.push_back(t);
      }
      if (period.value == 0) break;
    }
    return times;
  }

 protected:
  /// The first of them, ascending, and the time after which they come again; 0 where they do not.
  struct Changes {
    std::vector<Bounded> first;
    Bounded period;
  };
  virtual Changes changes() const = 0;
};

}  // namespace clackers::exact
