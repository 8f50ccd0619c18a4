#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "clackers/numerics/double_double.hpp"
#include "clackers/numerics/triple_double.hpp"

namespace clackers::exact {

/// Numbers of 384 bits for what is done once for a motion. Slow to compile: only for .cpp files.
using Wide = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<384, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

/// The nearest double, or the nearest sum of two or three.
inline double to_double(const Wide& x) { return x.convert_to<double>(); }

inline numerics::DoubleDouble to_double_double(const Wide& x) {
  const double hi = to_double(x);
  return {hi, to_double(x - hi)};
}

inline numerics::TripleDouble to_triple_double(const Wide& x) {
  const auto [hi, mid] = to_double_double(x);
  return {hi, mid, to_double(x - hi - mid)};
}

}  // namespace clackers::exact
