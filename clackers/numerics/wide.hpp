#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "clackers/numerics/bounded.hpp"

namespace clackers::numerics {

/// 256 bits, for what loses digits on the way.
using WideReal = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<256, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;
using Wide = BoundedOf<WideReal>;

/// The same number in the widest type of the processor.
inline Bounded narrowed(const Wide& x) {
  const auto value = static_cast<long double>(x.value);
  return {value, static_cast<long double>(x.error) +
                     std::numeric_limits<long double>::epsilon() * std::abs(value)};
}

}  // namespace clackers::numerics
