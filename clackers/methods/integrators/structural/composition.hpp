#pragma once

#include <array>

#include "clackers/methods/integrators/structural/alpha_method.hpp"

namespace clackers::methods {

/// Steps of the central difference of the lengths w_i h, one after the other, w mirrored: a
/// composition of a symmetric method. Some w are negative.
struct Composition {
  static constexpr int most = 4;

  int half;                         ///< number of different weights
  std::array<double, most> weight;  ///< from the outer one to the middle one
  double order;

  Facts facts() const;

  template <int Dof>
  using Memory = AlphaMethod::Memory<Dof>;

  template <int Dof>
  void prepare(MotionEquation<Dof>& equation, double h) const {
    for (int i = 0; i < half; ++i) central.prepare(equation, weight[std::size_t(i)] * h);
  }

  template <int Dof>
  void advance(MotionEquation<Dof>& equation, double h, model::State<Dof>& x,
               Memory<Dof>& memory) const {
    const double end = x.t + h;
    for (int i = 1 - half; i < half; ++i)
      central.advance(equation, weight[std::size_t(half - 1 - (i < 0 ? -i : i))] * h, x, memory);
    x.t = end;
  }

 private:
  static constexpr AlphaMethod central{.beta = 0.0, .gamma = 0.5};
};

}  // namespace clackers::methods
