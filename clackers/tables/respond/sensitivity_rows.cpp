#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "clackers/base/check.hpp"
#include "clackers/base/error.hpp"
#include "clackers/exact/quantities/sensitivity.hpp"
#include "clackers/tables/times/timed_rows.hpp"

namespace clackers::tables {
namespace {

constexpr std::string_view class_prefix = "class:";

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

std::string unit_of_raw(std::string_view name) {
  switch (name.front()) {
    case 'm':
      return "kg";
    case 'k':
      return "N/m";
    case 'c':
      return "N s/m";
    case 'v':
      return "m/s";
    case 'e':
      return "";
    default:
      return "m";  // gap, u10, u20
  }
}

// Units of u, v and a over that of the parameter.
std::array<std::string, 3> units_over(const std::string& by) {
  if (by == "N/m") return {"m^2/N", "m^2/N/s", "m^2/N/s^2"};
  if (by == "N s/m") return {"m^2/N/s", "m^2/N/s^2", "m^2/N/s^3"};
  if (by == "m") return {"", "1/s", "1/s^2"};
  if (by == "m/s") return {"s", "", "1/s"};
  if (by == "rad/s" || by == "1/s") return {"m s", "m", "m/s"};
  const auto rest = by.empty() ? by : "/" + by;
  return {"m" + rest, "m/s" + rest, "m/s^2" + rest};
}

// Of a parameter of the case that the motion does not depend on smoothly.
[[noreturn]] void refuse_parameter(const cases::Case& test_case, std::string_view name) {
  const bool whole = name == "N" || name == "X";
  throw InputError(
      fmt::format(
          "respond {}: --sensitivity {}: {}", test_case.entry->name, name,
          whole
              ? "it is a whole number, and between two of them there is no motion of the class to "
                "compare with. Use k2 or m2, which shift the frequency of mass 2."
              : "it only sets the end of the run; the motion up to there does not depend on it."),
      "no-derivative");
}

struct Choice {
  std::string label, unit;
  std::unique_ptr<exact::Sensitivity> sensitivity;
};

Choice choose(const cases::Case& test_case, const exact::ClosedForm& motion,
              std::string_view given) {
  const auto raw = exact::raw_parameters(motion);
  const bool in_class = given.starts_with(class_prefix);
  const auto name = in_class ? given.substr(class_prefix.size()) : given;
  if (!in_class && contains(raw, name))
    return {std::string(name), unit_of_raw(name), exact::raw_sensitivity(motion, name)};

  const auto smooth = exact::class_parameters(motion);
  const auto& own = test_case.entry->parameters;
  const auto found = std::ranges::find(own, name, &Parameter::name);
  if (found != own.end()) {
    if (!contains(smooth, name)) refuse_parameter(test_case, name);
    return {fmt::format("{}, all that follows from it following", name), found->unit,
            exact::class_sensitivity(motion, name)};
  }
  // What could have been meant, and a list of it in the message.
  auto known = raw;
  for (const auto& parameter : own)
    if (contains(smooth, parameter.name))
      known.push_back(contains(raw, parameter.name) ? std::string(class_prefix) + parameter.name
                                                    : parameter.name);
  refuse_name(fmt::format("parameter of {} to differentiate by", test_case.entry->name), given,
              known, fmt::format("{}", fmt::join(known, " ")));
}

}  // namespace

std::unique_ptr<record::RowSource> sensitivity(const cases::Case& test_case, const TimeGrid& grid,
                                               std::string_view name) {
  const auto& motion = closed_form(test_case, "a sensitivity");
  auto choice = choose(test_case, motion, name);
  require_inside(test_case, grid);
  const auto [u, v, a] = units_over(choice.unit);
  std::vector<record::Column> columns;
  for (int i = 1; i <= motion.dof(); ++i) {
    const auto add = [&](char symbol, const std::string& unit, std::string_view what) {
      columns.push_back({fmt::format("d{}{}", symbol, i), unit,
                         fmt::format("change of the {} of mass {} with {}", what, i, name)});
    };
    add('u', u, "displacement");
    add('v', v, "velocity");
    add('a', a, "acceleration");
  }
  const std::shared_ptr<const exact::Sensitivity> change = std::move(choice.sensitivity);
  return std::make_unique<TimedRows>(
      motion, grid, "clackers/sensitivity/1",
      fmt::format("Sensitivity of {} to {}", test_case.entry->name, choice.label), columns, 64,
      one_by_one([change](double t, model::Side side, double* row) {
        const auto d = change->at(t, side);
        for (Eigen::Index i = 0; i < d.u.size(); ++i)
          for (const double value : {d.u[i], d.v[i], d.a[i]}) *row++ = value;
      }));
}

}  // namespace clackers::tables
