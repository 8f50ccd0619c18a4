#include <algorithm>
#include <cmath>

#include "clackers/diagnose/file/file_sample.hpp"
#include "clackers/diagnose/file/single_numbers.hpp"

namespace clackers::diagnose {
namespace {

// A column and what its rounding may make of u over the scale.
struct Limit {
  std::string column;
  double digits = 0.0;
  double floor = 0.0;
};

// The number of a column "u2" is 2; 1 for "u".
Eigen::Index mass_of(const std::string& column) {
  return column.size() < 2 ? 0 : Eigen::Index(std::atoi(column.c_str() + 1) - 1);
}

// Of the columns that are used, the one whose printing spoils u most. Times whose grid is known to
// the last digit count with facts.time_half_unit, which is 0 for them.
Limit printing_limit(const FileSample& file) {
  const auto& facts = file.history().facts;
  const auto& scale = file.scale();
  Limit worst;
  for (const auto& column : facts.columns) {
    double floor = 0.0;
    if (column.name.starts_with('u') && mass_of(column.name) < scale.u.size())
      floor = column.half_unit / scale.u[mass_of(column.name)];
    if (column.name.starts_with('t'))
      floor = facts.time_half_unit * scale.v.cwiseQuotient(scale.u).maxCoeff();
    if (floor > worst.floor) worst = {column.name, double(column.digits), floor};
  }
  return worst;
}

// Printing makes at most its floor of the error, and a method as good as this at most once more.
constexpr double largest_share_of_method = 3.0;
// Fifteen digits are hardly rounded.
constexpr double least_floor = 1e-12;

std::optional<Diagnosis> printed_digits(const std::vector<FileSample>& files) {
  const auto& finest = files.front();
  const auto limit = printing_limit(finest);
  const double floor = std::max(limit.floor, finest.history().facts.floor);
  if (!(floor > least_floor) || limit.column.empty()) return {};
  if (!(finest.largest_error() < largest_share_of_method * floor)) return {};
  double count = 0.0;
  for (const auto& file : files)
    count += file.largest_error() < largest_share_of_method * file.history().facts.floor;
  Diagnosis cause;
  cause.code = "printed-digits";
  cause.value = limit.digits;
  cause.text = limit.column;
  cause.confidence = 0.9;
  cause.evidence = {{"digits", limit.digits}, {"floor", floor}, {"files", count}};
  return cause;
}

// Times that single precision leaves as they are, n / 1024 say, are not spoilt by it.
bool times_are_rounded(const Observation& history) {
  const auto& t = history.sample.t;
  if (history.sample_steps.size() != t.size() || t.size() < 3) return true;
  const double h = (history.last - history.first) / double(history.sample_steps.back());
  double off = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (history.sample_steps[i] >= 0)
      off = std::max(off, std::abs(t[i] - history.first - h * double(history.sample_steps[i])));
  return off > 0x1p-40 * history.last;
}

std::optional<Diagnosis> single_precision(const std::vector<FileSample>& files) {
  const auto& finest = files.front();
  const auto& rows = finest.rows();
  const auto& facts = finest.history().facts;
  const auto masses = std::size_t(rows.dof);
  std::string columns;
  const auto add = [&](const std::string& name) { columns += (columns.empty() ? "" : ",") + name; };
  double floor = 0.0;
  constexpr double rounding = 0x1p-24;
  if (are_single(rows.t) && times_are_rounded(finest.history())) {
    add("t");
    floor = rounding * rows.t.back() * finest.scale().v.cwiseQuotient(finest.scale().u).maxCoeff();
  }
  bool arithmetic = false;
  for (std::size_t mass = 0; mass < masses; ++mass) {
    const auto number = std::to_string(mass + 1);
    // Displacements from another origin are no single numbers any more.
    for (const auto& [letter, values] : {std::pair{"u", &rows.u}, std::pair{"v", &rows.v}}) {
      if (values->empty() || !are_single(*values, mass, masses)) continue;
      add(letter + number);
      arithmetic = true;
      floor = std::max(floor, rounding);
    }
  }
  if (columns.empty()) return {};
  // Rounded results limit an error of their own size; arithmetic in single precision an error that
  // grows with the number of steps, so that finer steps make it no smaller.
  const double error = finest.largest_error();
  bool limits = error < 10.0 * floor;
  if (arithmetic)
    for (const auto& file : files)
      limits = limits || (file.history().facts.step > 1.9 * facts.step &&
                          file.largest_error() < 1.4 * error && error < 1e-2);
  if (!limits && !arithmetic) return {};
  Diagnosis cause;
  cause.code = "single-precision";
  cause.value = 24.0;
  cause.unit = "bits";
  cause.text = columns;
  cause.confidence = limits ? 0.9 : least_confidence;
  cause.evidence = {{"floor", floor}};
  return cause;
}

}  // namespace

std::vector<Diagnosis> number_causes(const std::vector<FileSample>& files) {
  if (auto cause = single_precision(files)) return {*cause};
  if (auto cause = printed_digits(files)) return {*cause};
  return {};
}

}  // namespace clackers::diagnose
