#include "clackers/diagnose/file/reading.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace clackers::diagnose {
namespace {

std::size_t moved(const Reading& reading) {
  std::size_t count = 0;
  for (std::size_t q = 0; q < reading.column.size(); ++q) count += reading.column[q] != q;
  return count;
}

Reading with_masses_exchanged(std::size_t i, std::size_t j, std::size_t masses, bool has_v) {
  auto reading = Reading::plain(has_v ? 2 * masses : masses);
  reading.code = "masses-exchanged";
  std::swap(reading.column[i], reading.column[j]);
  if (has_v) std::swap(reading.column[masses + i], reading.column[masses + j]);
  return reading;
}

Reading reversed(std::size_t quantities, const std::vector<std::size_t>& which) {
  auto reading = Reading::plain(quantities);
  reading.code = "sign-reversed";
  for (const auto q : which) reading.factor[q] = -1.0;
  return reading;
}

// "u" and "U1" are u1.
std::string canonical(std::string name) {
  std::ranges::transform(name, name.begin(),
                         [](char c) { return char(std::tolower(static_cast<unsigned char>(c))); });
  return name == "u" || name == "v" ? name + "1" : name;
}

}  // namespace

Reading Reading::plain(std::size_t quantities) {
  Reading reading;
  reading.column.resize(quantities);
  std::iota(reading.column.begin(), reading.column.end(), std::size_t(0));
  reading.factor.assign(quantities, 1.0);
  return reading;
}

bool Reading::permutes() const { return moved(*this) > 0; }

std::vector<double> Reading::applied(std::span<const double> numbers) const {
  std::vector<double> quantities(column.size());
  for (std::size_t q = 0; q < column.size(); ++q) quantities[q] = numbers[column[q]] / factor[q];
  return quantities;
}

model::Trajectory read_as(const Reading& reading, const model::Trajectory& rows) {
  const auto masses = std::size_t(rows.dof);
  model::Trajectory result{rows.dof, rows.t, rows.u, rows.v, {}, {}};
  std::vector<double> numbers(reading.column.size());
  const bool has_v = numbers.size() > masses;
  for (std::size_t row = 0; row < rows.t.size(); ++row) {
    for (std::size_t mass = 0; mass < masses; ++mass) {
      numbers[mass] = rows.u[row * masses + mass];
      if (has_v) numbers[masses + mass] = rows.v[row * masses + mass];
    }
    const auto quantities = reading.applied(numbers);
    for (std::size_t mass = 0; mass < masses; ++mass) {
      result.u[row * masses + mass] = quantities[mass];
      if (has_v) result.v[row * masses + mass] = quantities[masses + mass];
    }
  }
  return result;
}

std::vector<Reading> exchanges(std::size_t masses, bool has_v) {
  std::vector<Reading> all;
  for (std::size_t i = 0; i < masses; ++i)
    for (std::size_t j = i + 1; j < masses; ++j)
      all.push_back(with_masses_exchanged(i, j, masses, has_v));
  if (masses > 2 || !has_v) return all;
  auto next = Reading::plain(2 * masses);
  next.code = "columns-exchanged";
  const auto known = all;
  while (std::ranges::next_permutation(next.column).found)
    if (std::ranges::find(known, next.column, &Reading::column) == known.end()) all.push_back(next);
  std::ranges::stable_sort(all.begin() + std::ptrdiff_t(known.size()), all.end(), {}, moved);
  return all;
}

std::vector<Reading> reversals(std::size_t masses, bool has_v) {
  const auto quantities = has_v ? 2 * masses : masses;
  std::vector<std::size_t> whole(quantities), displacements(masses), velocities(masses);
  std::iota(whole.begin(), whole.end(), std::size_t(0));
  std::iota(displacements.begin(), displacements.end(), std::size_t(0));
  std::iota(velocities.begin(), velocities.end(), masses);
  std::vector<Reading> all{reversed(quantities, whole)};
  for (std::size_t mass = 0; mass < masses && masses > 1; ++mass)
    all.push_back(
        reversed(quantities, has_v ? std::vector{mass, masses + mass} : std::vector{mass}));
  if (!has_v) return all;
  all.push_back(reversed(quantities, velocities));
  all.push_back(reversed(quantities, displacements));
  for (std::size_t q = 0; q < quantities && masses > 1; ++q)
    all.push_back(reversed(quantities, {q}));
  return all;
}

std::string quantity_name(std::size_t quantity, std::size_t masses) {
  return (quantity < masses ? "u" : "v") + std::to_string(quantity % masses + 1);
}

std::string columns_option(const Reading& reading, const std::vector<std::string>& columns,
                           std::size_t masses) {
  auto names = columns;
  if (names.empty()) {
    names.push_back("t");
    for (std::size_t mass = 0; mass < masses; ++mass)
      for (const auto q : {mass, masses + mass})
        if (q < reading.column.size()) names.push_back(quantity_name(q, masses));
  }
  const auto labels = names;
  for (std::size_t q = 0; q < reading.column.size(); ++q)
    for (std::size_t i = 0; i < labels.size(); ++i)
      if (canonical(labels[i]) == quantity_name(reading.column[q], masses))
        names[i] = quantity_name(q, masses);
  std::string option;
  for (const auto& name : names) option += (option.empty() ? "" : ",") + name;
  return option;
}

std::string reversed_columns(const Reading& reading, std::size_t masses) {
  std::string names;
  for (std::size_t q = 0; q < reading.factor.size(); ++q)
    if (reading.factor[q] < 0.0) names += (names.empty() ? "" : ",") + quantity_name(q, masses);
  return names;
}

double factor_of(std::span<const double> numbers, std::span<const double> reference) {
  double product = 0.0, square = 0.0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    product += numbers[i] * reference[i];
    square += reference[i] * reference[i];
  }
  return square > 0.0 ? product / square : 1.0;
}

model::Trajectory reference_rows(const model::Motion& motion, std::span<const double> times,
                                 bool with_v) {
  model::Trajectory rows;
  rows.dof = motion.dof();
  for (const double t : times) rows.t.push_back(std::clamp(t, 0.0, motion.end()));
  rows.u.resize(rows.t.size() * std::size_t(rows.dof));
  rows.v.resize(rows.u.size());
  motion.sample(rows.t, model::Side::right, {rows.u, rows.v, {}});
  if (!with_v) rows.v.clear();
  return rows;
}

}  // namespace clackers::diagnose
