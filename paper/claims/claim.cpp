#include "paper/claims/claim.hpp"

#include <fmt/args.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "clackers/base/files/json.hpp"
#include "paper/rendering/assets.hpp"

namespace clackers::paper {
namespace {

using Json = nlohmann::ordered_json;

std::string text(double value) {
  return value == std::round(value) ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

const Measure& measure(std::string_view name) {
  for (const auto table : {measures_of_pairs(), measures_of_figures()})
    if (const auto found = std::ranges::find(table, name, &Measure::name); found != table.end())
      return *found;
  throw std::logic_error("no measure " + std::string(name));
}

// A pair with the changes that a system of claims.json names.
Pair pair_of(const Json& system) {
  const auto given = [&](const char* name, double otherwise) {
    return system.value(name, otherwise);
  };
  Pair pair(given("N", 0.0), given("xi1", 0.05), given("r", 3.0), given("u1", 1.0),
            given("m1", 1.0), given("k1", 1.0));
  for (auto* x : {pair.m, pair.c, pair.k}) x[1] *= given("heavier", 1.0);
  pair.k[1] *= given("stiffer", 1.0);
  pair.v[1] *= given("faster", 1.0);
  pair.masses = system.value("masses", 2);
  pair.contact = system.value("contact", true);
  return pair;
}

// Times in s, or with "quarters" in π/(2 ω_D1).
double end_of(const Json& system, const Pair& pair) {
  return system.contains("quarters") ? pair.quarters(system["quarters"])
                                     : system.value("end", 20.0);
}

// N = 0, 1, 2, 5, 20 with ξ1 = 0, 0.05, 0.3, 0.7, and what `more` says of each.
Json grid(const Json& more) {
  Json out = Json::array();
  for (const double N : {0.0, 1.0, 2.0, 5.0, 20.0})
    for (const double xi1 : {0.0, 0.05, 0.3, 0.7}) {
      out.push_back(more);
      out.back().update({{"N", N}, {"xi1", xi1}});
    }
  return out;
}

std::vector<double> values_of(const Measure& asked, const Json& group, const Figure& figure) {
  std::vector<double> out;
  if (const auto* of_pair = std::get_if<0>(&asked.of)) {
    for (const auto& system : group.contains("grid") ? grid(group["grid"]) : group.at("systems")) {
      const auto pair = pair_of(system);
      out.push_back((*of_pair)(pair, end_of(system, pair)));
    }
  } else if (const auto* of_line = std::get_if<1>(&asked.of)) {
    const auto stride = group.value("every", std::size_t(1));
    for (auto i = group.value("from", std::size_t(0)); i < figure.panels.size(); i += stride)
      out.push_back((*of_line)(figure.panels[i].series.at(group.at("series"))));
  } else {
    out = std::get<2>(asked.of)(figure);
  }
  return out;
}

// Whether every criterion of every group is met; appends what decided.
bool met(const Json& groups, const Figure& figure,
         fmt::dynamic_format_arg_store<fmt::format_context>& values) {
  bool out = true;
  for (const auto& group : groups)
    for (const auto& [name, criterion] : group.at("find").items()) {
      const auto found = judged(
          criterion, values_of(measure(name), group, figure),
          [&](const std::string& other) { return values_of(measure(other), group, figure); });
      values.push_back(found.values);
      out = out && found.met;
    }
  return out;
}

}  // namespace

Judged judged(const std::string& criterion, const std::vector<double>& values,
              const std::function<std::vector<double>(const std::string& name)>& of) {
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); }) ||
      values.empty())
    return {false, "no number"};
  std::istringstream in(criterion);
  std::string word;
  in >> word;
  if (word == "near" || word == "unlike") {
    double limit = 0.0, off = 0.0;
    std::string other;
    std::getline(in >> limit >> std::ws, other);
    const auto others = of(other);
    for (std::size_t i = 0; i < values.size(); ++i)
      off = std::max(off, std::abs(values[i] / others.at(i) - 1.0));
    return {(off < limit) == (word == "near"), text(off)};
  }
  const std::vector<double> limits{std::istream_iterator<double>(in), {}};
  const auto [low, high] = std::ranges::minmax(values);
  const auto all = [&] {
    std::vector<std::string> words;
    for (const double value : values) words.push_back(text(value));
    return fmt::format("{}", fmt::join(words, ", "));
  };
  const auto sorted = [&](auto wrong) {
    return std::ranges::adjacent_find(values, wrong) == values.end();
  };
  if (word == "<") return {high < limits.at(0), text(high)};
  if (word == ">") return {low > limits.at(0), text(low)};
  if (word == "some") return {low < limits.at(0), text(low)};
  if (word == "=") return {values == limits, all()};
  const bool within = limits.size() == 2 && low >= limits[0] && high <= limits[1];
  if (word == "within" || word == "beyond") return {within == (word == "within"), all()};
  if (word == "rising") return {sorted(std::greater_equal<>()), all()};
  if (word == "falling") return {sorted(std::less_equal<>()), all()};
  if (word == "same") return {high - low <= 1e-13 * std::abs(high), all()};
  if (word == "list") return {true, all()};
  const double sum = std::reduce(values.begin(), values.end());
  if (word == "sum") return {sum >= 0.0, text(sum)};
  throw std::logic_error("no criterion " + criterion);
}

std::vector<Claim> claims_beside(const Figure& figure, const std::atomic<bool>* interrupt) {
  static const auto rows = parse_json(assets::claims_json);
  std::vector<Claim> out;
  for (const auto& row : rows) {
    if (interrupt != nullptr && interrupt->load()) break;
    if (row.at("figure") != figure.name) continue;
    Claim claim{row.at("name"),
                int(&row - &rows[0]),
                row.at("section"),
                row.at("says"),
                Verdict::not_measurable,
                {},
                row.value("condition", "")};
    if (row.contains("there")) {
      fmt::dynamic_format_arg_store<fmt::format_context> values;
      const bool there = met(row["there"], figure, values);
      const bool elsewhere = !row.contains("elsewhere") || met(row["elsewhere"], figure, values);
      claim.verdict = !there      ? Verdict::does_not_hold
                      : elsewhere ? Verdict::holds
                                  : Verdict::holds_where;
      claim.measured = fmt::vformat(row.at("measured").get<std::string>(), values);
      if (claim.verdict != Verdict::holds_where) claim.condition.clear();
    }
    out.push_back(std::move(claim));
  }
  return out;
}

}  // namespace clackers::paper
