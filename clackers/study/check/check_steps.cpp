#include "clackers/study/check/check_steps.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace clackers::study {
namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

}  // namespace

std::optional<double> step_in_name(std::string_view path) {
  auto name = path.substr(path.find_last_of('/') + 1);
  for (std::size_t at = 0; at < name.size(); ++at) {
    if (name[at] != 'h' || (at > 0 && is_letter(name[at - 1]))) continue;
    auto rest = name.substr(at + 1);
    if (rest.starts_with('=') || rest.starts_with('_')) rest.remove_prefix(1);
    if (rest.empty() || !(is_digit(rest[0]) || rest[0] == '.')) continue;
    double step = 0.0;
    const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), step);
    if (error == std::errc() && step > 0.0 && std::isfinite(step)) return step;
  }
  return {};
}

}  // namespace clackers::study
