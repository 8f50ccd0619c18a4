#include "clackers/judge/convergence/richardson.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/judge/convergence/fit/window.hpp"

namespace clackers::judge {
namespace {

constexpr auto richardson_name = "Richardson extrapolation";

using Values = std::vector<double>;

double norm(const Values& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

// first + factor * other
Values sum(const Values& first, double factor, const Values& other) {
  Values made = first;
  for (std::size_t i = 0; i < made.size(); ++i) made[i] += factor * other[i];
  return made;
}

class Extrapolation {
 public:
  Extrapolation(std::span<const Response> runs, double order) : runs_(runs), q_(order) {}

  Values difference(int j) const { return sum(at(j + 1).values, -1.0, at(j).values); }

  // r^q - 1 for the step from run j to run j + 1.
  double share(int j, double order) const {
    return std::pow(at(j).step / at(j + 1).step, order) - 1.0;
  }

  Values value(int j) const { return sum(at(j + 1).values, 1.0 / share(j, q_), difference(j)); }

  // R is (r^q U_{j+1} - U_j) / (r^q - 1), and so are the floors of its two runs.
  double rounding(int j) const {
    const double s = share(j, q_);
    return ((s + 1.0) * at(j + 1).floor + at(j).floor) / s;
  }

  // Whether difference j + 1 is that multiple of difference j which a term C h^q makes of it.
  bool follows(int j) const {
    const double h0 = std::pow(at(j).step, q_), h1 = std::pow(at(j + 1).step, q_),
                 h2 = std::pow(at(j + 2).step, q_);
    const double rho = (h1 - h2) / (h0 - h1);
    const auto before = difference(j);
    const double departure = norm(sum(difference(j + 1), -rho, before)) / (rho * norm(before));
    return rho < 1.0 && departure <= largest_departure(rho);
  }

 private:
  const Response& at(int j) const { return runs_[std::size_t(j)]; }

  std::span<const Response> runs_;
  double q_;
};

Richardson unbounded(std::string_view reason) {
  Richardson none;
  none.reason = reason;
  return none;
}

}  // namespace

Richardson extrapolate(std::span<const Response> runs, const SelfContext& context,
                       std::optional<double> next_order) {
  const double q = require_positive(richardson_name, "claimed order", context.claimed_order);
  if (next_order && !(*next_order > q))
    refuse(richardson_name, "order of the next term", *next_order, "above the claimed order");
  std::vector<ResponseLevel> levels;
  for (const auto& run : runs) levels.push_back({run});
  const auto self = self_convergence(levels, context);
  const auto& fit = self.differences;
  // Another reason of this fit is one of the first run of each level, not of the method.
  if (fit.reason == Code("run-failed").name()) return unbounded(fit.reason);
  if (!self.proper)
    return unbounded(std::ssize(runs) <= shortest_window ? Code("too-few-levels").name()
                                                         : Code("improper-convergence").name());
  const Extrapolation terms(runs, q);
  const int from = std::max(fit.first_level, fit.last_level - shortest_window + 1);
  for (int j = from; j < fit.last_level; ++j)
    if (!terms.follows(j)) return unbounded(Code("differences-turn").name());
  const int j = fit.last_level;
  Richardson found;
  found.bounded = true;
  found.value = terms.value(j);
  found.level = j + 1;
  found.bound = norm(terms.difference(j)) / terms.share(j, q) + terms.rounding(j);
  if (next_order)
    found.estimate = norm(sum(found.value, -1.0, terms.value(j - 1))) / terms.share(j, *next_order);
  return found;
}

}  // namespace clackers::judge
