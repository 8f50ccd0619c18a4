#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <vector>

#include "target.hpp"

namespace clackers::fuzz {
namespace {

constexpr auto extreme = std::to_array<std::string_view>({"0",
                                                          "-0",
                                                          "5e-324",
                                                          "-5e-324",
                                                          "1e-310",
                                                          "2.2250738585072014e-308",
                                                          "1e-300",
                                                          "-1e-300",
                                                          "1e-160",
                                                          "1e-17",
                                                          "0.1",
                                                          "1",
                                                          "1.0000000000000002",
                                                          "9007199254740993",
                                                          "1e154",
                                                          "1e300",
                                                          "-1e300",
                                                          "1.7976931348623157e308",
                                                          "1e309",
                                                          "nan",
                                                          "-nan",
                                                          "inf",
                                                          "-inf",
                                                          "1d-5",
                                                          "0x1p-3",
                                                          "1,5",
                                                          "1e",
                                                          "+.5",
                                                          "1/3",
                                                          "00000000000000000000001",
                                                          "0.30000000000000004"});

struct Span {
  std::size_t from, length;
};

bool is_of_number(char c) { return (c >= '0' && c <= '9') || std::strchr("+-.eE", c) != nullptr; }

std::vector<Span> numbers_of(std::string_view text) {
  std::vector<Span> out;
  for (std::size_t i = 0; i < text.size();) {
    const auto from = i;
    bool digit = false;
    for (; i < text.size() && text[i] != '\0' && is_of_number(text[i]); ++i)
      digit = digit || (text[i] >= '0' && text[i] <= '9');
    if (digit) out.push_back({from, i - from});
    if (i == from) ++i;
  }
  return out;
}

// The line around a place, with its end.
Span line_at(std::string_view text, std::size_t place) {
  const auto before = place == 0 ? std::string_view::npos : text.rfind('\n', place - 1);
  const auto from = before == std::string_view::npos ? 0 : before + 1;
  const auto after = text.find('\n', place);
  return {from, (after == std::string_view::npos ? text.size() : after + 1) - from};
}

}  // namespace

std::size_t mutate_numbers(char* text, std::size_t size, std::size_t room, unsigned seed) {
  std::minstd_rand random(seed);
  const auto below = [&](std::size_t count) { return std::size_t(random()) % count; };
  std::string changed(text, size);
  for (auto times = 1 + below(4); times > 0; --times) {
    const auto numbers = numbers_of(changed);
    if (numbers.empty()) break;
    const auto place = numbers[below(numbers.size())];
    const auto line = line_at(changed, place.from);
    switch (below(8)) {
      case 0:
        changed.insert(line.from, changed.substr(line.from, line.length));
        break;
      case 1:
        changed.erase(line.from, line.length);
        break;
      case 2: {  // every number of a line
        const auto value = extreme[below(extreme.size())];
        for (auto each = numbers.rbegin(); each != numbers.rend(); ++each)
          if (each->from >= line.from && each->from < line.from + line.length)
            changed.replace(each->from, each->length, value);
        break;
      }
      case 3:  // another power of ten
        changed.insert(place.from + place.length, "e" + std::to_string(int(below(660)) - 330));
        break;
      case 4: {  // one that stands elsewhere
        const auto other = numbers[below(numbers.size())];
        changed.replace(place.from, place.length, changed.substr(other.from, other.length));
        break;
      }
      default:
        changed.replace(place.from, place.length, extreme[below(extreme.size())]);
    }
  }
  const auto length = std::min(changed.size(), room);
  std::memcpy(text, changed.data(), length);
  return length;
}

}  // namespace clackers::fuzz
