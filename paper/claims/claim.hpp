#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "paper/claims/simulation.hpp"
#include "paper/figure.hpp"

namespace clackers::paper {

/// What claims.json can ask for: of each simulated pair over a run, of each chosen series of the
/// figure, or of the figure.
struct Measure {
  std::string_view name;
  std::variant<double (*)(const Pair& pair, double end), double (*)(const Series& line),
               std::vector<double> (*)(const Figure& figure)>
      of;
};
std::span<const Measure> measures_of_pairs(), measures_of_figures();

/// What a criterion says of values: whether it is met, and those that decide it.
struct Judged {
  bool met = false;
  std::string values;
};
/// "< x", "> x" of all, "some x" for < of any; "= x y ...", "within x y", "beyond x y" (not all), "rising", "falling", "same";
/// "list" and "sum", of counts that exist, only show; "near x NAME" compares with what `of` gives for NAME,
/// to x of it, and "unlike x NAME" is its opposite. Nothing meets "no number". Throws std::logic_error for another.
Judged judged(const std::string& criterion, const std::vector<double>& values,
              const std::function<std::vector<double>(const std::string& name)>& of);

/// The claims of claims.json that stand beside a figure, measured until `interrupt` becomes true.
std::vector<Claim> claims_beside(const Figure& figure, const std::atomic<bool>* interrupt);

}  // namespace clackers::paper
