#pragma once

namespace clackers::methods {

/// The end of the interval of omega h, from 0 on, on which an undamped motion does not grow; 0 if it
/// grows in every step however short. `radius(x)` is the factor of its growth in a step with
/// omega h = x.
template <class Radius>
double stability_limit(const Radius& radius) {
  const auto grows = [&](double x) { return radius(x) > 1.0 + 1e-12; };
  double stable = 0.1;
  if (grows(stable)) return 0.0;
  for (double step = 0.01; step > 1e-12; step *= 0.5)
    while (!grows(stable + step)) stable += step;
  return stable;
}

/// The spectral radius of a real matrix of two rows, by its trace and determinant.
double spectral_radius(double trace, double determinant);

}  // namespace clackers::methods
