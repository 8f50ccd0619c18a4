#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "clackers/exact/bodies/bar_contact.hpp"
#include "clackers/numerics/wide.hpp"

namespace clackers::exact {

/// The piece that holds at t, from its `t` to the next one's; within the errors of these and `slack` the one that
/// `side` means.
template <class List>
const typename List::value_type& piece_at(const List& list, const numerics::Wide& t,
                                          model::Side side, const numerics::WideReal& slack) {
  const auto after = std::ranges::upper_bound(list, t.value, {}, [](auto& p) { return p.t.value; });
  auto i = std::size_t(std::max<std::ptrdiff_t>(0, after - list.begin() - 1));
  const auto near = [&](std::size_t k) {
    return abs(list[k].t.value - t.value) <= list[k].t.error + t.error + slack;
  };
  if (side == model::Side::left)
    while (i > 0 && near(i)) --i;
  else
    while (i + 1 < list.size() && near(i + 1)) ++i;
  return list[i];
}

/// The waves at the contact ends of the bars, linear in time between events, and the phases of the contact.
class BarContact::Waves {
 public:
  using Side = model::Side;
  using Wide = numerics::Wide;
  using WideReal = numerics::WideReal;

  // A linear function of time, until the next piece.
  struct Piece {
    Wide t, value, slope;
  };

  // Of a bar: L/c, c, z, and o from -2 tau on.
  struct Ends {
    Wide tau, c, z;
    std::vector<Piece> out;
  };

  // Between two changes of an arriving wave or of the contact: rate = a2 - a1 at t.
  struct Phase {
    Wide t, gap, rate, slope, impulse;
    bool closed = false;
    std::array<Piece, 2> end;       // velocity of each contact end
    std::array<Wide, 2> end_moved;  // its displacement at t
  };

  struct Change {
    bool closes = false;
    Wide t;
  };

  Waves(const BarsParameters& parameters, std::string_view who);

  // The same phase in the second period, with the periods between.
  struct Folded {
    Wide t;
    WideReal periods = 0;
  };
  Folded folded(double t) const;
  const Phase& phase(const Wide& t, Side side, const WideReal& slack) const {
    return piece_at(phases_, t, side, slack);
  }
  /// Moved in s seconds with this velocity at their beginning.
  static Wide moved(const Wide& velocity, const Wide& slope, const Wide& s) {
    return velocity * s + Wide(0.5) * slope * s * s;
  }
  Wide arriving(std::size_t bar, const Wide& t, Side side, const WideReal& slack) const;
  Wide outgoing(std::size_t bar, const Wide& t, Side side, const WideReal& slack) const;
  Wide displacement(std::size_t bar, const Wide& x, const Wide& t) const;
  Wide impulse(const Wide& t) const;

  BarsParameters p_;
  Wide gap_, period_;  // at the start
  Wide compliance_;    // 1/(1/z1 + 1/z2), force over rate
  std::vector<Ends> waves_;
  std::vector<Phase> phases_;
  std::vector<Change> events_;

 private:
  void build(std::string_view who);
  Wide sum_of_out(std::size_t bar, const Wide& from, const Wide& to) const;
};

}  // namespace clackers::exact
