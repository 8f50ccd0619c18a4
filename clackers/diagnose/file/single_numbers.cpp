#include "clackers/diagnose/file/single_numbers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

namespace clackers::diagnose {
namespace {

enum class Kind { other, short_decimal, single };

double parsed(std::string_view text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

Kind kind_of(double x) {
  constexpr std::ptrdiff_t telling = 8;
  std::array<char, 64> buffer{};
  const auto print = [&](auto number, auto... form) {
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number,
                                   std::chars_format::scientific, form...)
                         .ptr;
    return std::string_view(buffer.data(), std::size_t(end - buffer.data()));
  };
  const auto nearest = static_cast<float>(x);
  const bool single = static_cast<double>(nearest) == x || parsed(print(nearest)) == x ||
                      parsed(print(nearest, 8)) == x;
  if (!single) return Kind::other;
  const auto shortest = print(x);
  const auto digits = std::ranges::count_if(shortest.substr(0, shortest.find('e')),
                                            [](char c) { return c >= '0' && c <= '9'; });
  return digits < telling ? Kind::short_decimal : Kind::single;
}

}  // namespace

bool are_single(const std::vector<double>& values, std::size_t first, std::size_t stride) {
  constexpr int enough = 20;
  int single = 0;
  for (auto i = first; i < values.size(); i += stride) {
    if (values[i] == 0.0) continue;
    const auto kind = kind_of(values[i]);
    if (kind == Kind::other) return false;
    single += kind == Kind::single;
  }
  return single >= enough;
}

}  // namespace clackers::diagnose
