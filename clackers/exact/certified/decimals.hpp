#pragma once

#include <optional>
#include <string>

#include "clackers/exact/certified/ball.hpp"

namespace clackers::certified {

/// What is known of a number apart from the ball that holds it: its square is a fraction of whole
/// numbers whose denominator is below 2^bits. Such a number can lie exactly halfway between two
/// decimal numbers, and no ball shows that; but a ball that is narrow enough proves it, because two
/// different fractions cannot be arbitrarily close.
struct Fraction {
  double bits = 0.0;
};

/// The number that `value` holds, correctly rounded to n >= 1 significant digits, half to even;
/// nothing when the ball is too wide to decide. Without `fraction` the number must not lie halfway,
/// unless the ball is exact. From 1e-5 to below 10^n as in 0.0012300, else as in 1.2300e-17; 0 is 0.
std::optional<std::string> decimals(const Ball& value, int n,
                                    const std::optional<Fraction>& fraction = {});

}  // namespace clackers::certified
