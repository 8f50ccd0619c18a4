#include "clackers/measure/errors/comparison.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <span>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"

namespace clackers::measure {
namespace {

constexpr auto history_name = "history";

void require_size(std::string_view name, std::size_t given, std::size_t expected) {
  if (given != expected)
    refuse(history_name, fmt::format("entries of {}", name), double(given),
           fmt::format("{}, one for each time and mass", expected), {}, "wrong-size");
}

void require_all_finite(std::string_view name, std::span<const double> entries, std::size_t row) {
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (!std::isfinite(entries[i]))
      require_finite(history_name, fmt::format("{}{} in row {}", name, i % row + 1, i / row + 1),
                     entries[i]);
}

void require_times(const std::vector<double>& t, const model::Motion& reference) {
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (!std::isfinite(t[i])) require_finite(history_name, fmt::format("t in row {}", i + 1), t[i]);
    if (!(t[i] >= 0.0 && t[i] <= latest_time(reference)))
      refuse(history_name, fmt::format("t in row {}", i + 1), t[i],
             fmt::format("0 to {}, where the reference is known", reference.end()), {},
             "time-outside");
    if (i > 0 && t[i] < t[i - 1])
      refuse(history_name, fmt::format("t in row {}", i + 1), t[i],
             fmt::format("no less than {}, the time before it", t[i - 1]), {}, "not-sorted");
    if (i > 1 && t[i] == t[i - 2])
      refuse(history_name, fmt::format("t in row {}", i + 1), t[i],
             "at most two rows with one time", "Keep the two limits of the jump.", "three-limits");
  }
  if (t.empty() || t.front() == t.back())
    refuse(history_name, "different times", t.empty() ? 0.0 : 1.0, "at least 2", {}, "too-short");
}

void require_impacts(const std::vector<model::Impact>& impacts, std::size_t dof,
                     const model::ImpactProblem<>& problem) {
  for (std::size_t k = 0; k < impacts.size(); ++k) {
    const auto name = [&](std::string_view what) {
      return fmt::format("{} of impact {}", what, k + 1);
    };
    const auto& impact = impacts[k];
    require_finite(history_name, name("t"), impact.t);
    if (impact.contact < 0 || impact.contact >= std::ssize(problem.contacts))
      refuse(history_name, name("contact"), double(impact.contact),
             "a row of the problem's contacts");
    for (const auto* entries : {&impact.u, &impact.v_before, &impact.v_after})
      if (!entries->empty()) require_size(name("a vector"), entries->size(), dof);
  }
}

}  // namespace

double latest_time(const model::Motion& reference) {
  return reference.end() + 4.0 * std::numeric_limits<double>::epsilon() * reference.end();
}

void require_comparable(const model::Trajectory& history, const model::Motion& reference,
                        const model::ImpactProblem<>& problem) {
  if (history.dof != reference.dof() || problem.dof() != reference.dof())
    refuse(
        history_name, "masses", double(history.dof),
        fmt::format("{}, as the reference has; the problem has {}", reference.dof(), problem.dof()),
        {}, "wrong-size");
  const auto dof = std::size_t(history.dof), size = history.t.size() * dof;
  require_size("u", history.u.size(), size);
  if (!history.v.empty()) require_size("v", history.v.size(), size);
  if (!history.a.empty()) require_size("a", history.a.size(), size);
  require_times(history.t, reference);
  require_all_finite("u", history.u, dof);
  require_all_finite("v", history.v, dof);
  require_all_finite("a", history.a, dof);
  if (history.impacts) require_impacts(*history.impacts, dof, problem);
}

}  // namespace clackers::measure
