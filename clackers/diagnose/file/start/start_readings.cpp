#include "clackers/diagnose/file/start/start_readings.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/diagnose/file/units.hpp"

namespace clackers::diagnose {
namespace {

// A reading that explains the first row, with its diagnosis.
struct Candidate {
  Reading reading;
  Diagnosis diagnosis;
  double flight = 0.0;  ///< rms distance of the first flight, NaN where it is not known
};

// Quantities from..to of the row are one factor times those of the state: the factor in the sense of
// least squares, and how many of them are not zero.
struct Factor {
  double value = 1.0;
  int numbers = 0;
};

Factor factor_of(const FirstRow& row, const std::vector<double>& numbers, std::size_t from,
                 std::size_t to) {
  double product = 0.0, square = 0.0;
  Factor factor;
  for (std::size_t q = from; q < to; ++q) {
    const double expected = row.expected()[q] / row.scale(q);
    if (std::isnan(numbers[q]) || std::abs(expected) <= row.tolerance()) continue;
    product += numbers[q] / row.scale(q) * expected;
    square += expected * expected;
    ++factor.numbers;
  }
  if (square > 0.0) factor.value = product / square;
  return factor;
}

class ShapeSearch {
 public:
  explicit ShapeSearch(const FirstRow& row)
      : row_(row), plain_flight_(row.flight_distance(Reading::plain(row.given().size()))) {}

  std::optional<Diagnosis> run() {
    add_unit();
    if (row_.complete()) {
      const auto reversals_ = reversals(row_.masses(), row_.has_v());
      const auto exchanges_ = exchanges(row_.masses(), row_.has_v());
      add_first(exchanges_, "masses-exchanged");
      add_first(reversals_, "sign-reversed");
      add_first(exchanges_, "columns-exchanged");
      if (found_.empty()) add_units_of_parts();
      if (found_.empty()) add_together(exchanges_, reversals_);
    } else {
      add_units_of_parts();
    }
    return best();
  }

 private:
  bool matches(const Reading& reading, double largest_factor = 1.0) const {
    // A file of large numbers has its printing error in their unit.
    const double slack = std::max(1.0, largest_factor);
    const double tolerance = 1e-6 + (row_.tolerance() - 1e-6) / slack;
    return row_.distance(reading.applied(row_.given()), row_.expected()) <= tolerance;
  }

  double unit_tolerance() const { return std::max(1e-5, 2.0 * row_.tolerance()); }

  Reading scaled(double u, double v) const {
    auto reading = Reading::plain(row_.given().size());
    reading.code = "unit-scaled";
    for (std::size_t q = 0; q < reading.factor.size(); ++q)
      reading.factor[q] = q < row_.masses() ? u : v;
    return reading;
  }

  void add(const Reading& reading, double value, std::string text, double confidence) {
    Candidate candidate{reading, {}, row_.flight_distance(reading)};
    candidate.diagnosis.code = reading.code;
    candidate.diagnosis.value = value;
    candidate.diagnosis.text = std::move(text);
    candidate.diagnosis.confidence = confidence;
    found_.push_back(std::move(candidate));
  }

  void add_unit() {
    const auto factor = factor_of(row_, row_.given(), 0, row_.given().size());
    const auto* unit = unit_of(length_units, factor.value, unit_tolerance());
    // Any factor fits one number.
    if (!(factor.value > 0.0) || (unit == nullptr && factor.numbers < 2)) return;
    const auto reading = scaled(factor.value, factor.value);
    if (!matches(reading, factor.value)) return;
    add(reading, unit != nullptr ? unit->factor : factor.value,
        unit != nullptr ? std::string(unit->name) : "", unit != nullptr ? 0.95 : 0.7);
  }

  // One unit of u, another of v. Only known units count.
  void add_units_of_parts() {
    if (!row_.has_v()) return;
    const auto u = factor_of(row_, row_.given(), 0, row_.masses());
    const auto v = factor_of(row_, row_.given(), row_.masses(), row_.given().size());
    const auto* u_unit = unit_of(length_units, u.value, unit_tolerance());
    const auto* v_unit = unit_of(length_units, v.value, unit_tolerance());
    const auto* v_time = unit_of(time_units, 1.0 / v.value, unit_tolerance());
    const double u_factor = u_unit != nullptr ? u_unit->factor : 1.0;
    const double v_factor = v_unit != nullptr   ? v_unit->factor
                            : v_time != nullptr ? 1.0 / v_time->factor
                                                : 1.0;
    if (u_factor == 1.0 && v_factor == 1.0) return;
    const auto reading = scaled(u_factor, v_factor);
    if (!matches(reading, std::min(u_factor, v_factor))) return;
    std::string text = u_unit != nullptr ? "u " + std::string(u_unit->name) : "";
    if (v_factor != 1.0) text += text.empty() ? "v " : ", v ";
    if (v_unit != nullptr) text += std::string(v_unit->name) + "/s";
    if (v_unit == nullptr && v_time != nullptr) text += "m/" + std::string(v_time->name);
    if (u_unit == nullptr && v_time != nullptr && time_explains(v_time->factor)) {
      auto in_time = reading;
      in_time.code = "time-unit";
      add(in_time, v_time->factor, std::string(v_time->name), 0.95);
      found_.back().flight = 0.0;
      return;
    }
    add(reading, u_unit != nullptr ? u_factor : v_factor, text, 0.9);
    // The velocities of another damping are all one factor off as well.
    if (found_.back().flight > agreeing * plain_flight_) found_.pop_back();
  }

  // The times of the rows are in that unit as well.
  bool time_explains(double factor) const {
    const auto& rows = row_.opening().rows;
    const auto last = std::min<std::size_t>(rows.t.size(), 20);
    double as_read = 0.0, in_unit = 0.0;
    for (std::size_t i = 1; i < last; ++i) {
      const auto as_it_is = row_.state_at(rows.t[i]), other = row_.state_at(rows.t[i] / factor);
      for (std::size_t mass = 0; mass < row_.masses(); ++mass) {
        const double u = rows.u[i * row_.masses() + mass];
        as_read += std::abs(u - as_it_is[mass]) / row_.scale(mass);
        in_unit += std::abs(u - other[mass]) / row_.scale(mass);
      }
    }
    return in_unit < 0.3 * as_read;
  }

  void add_first(const std::vector<Reading>& readings, std::string_view code) {
    for (const auto& reading : readings)
      if (reading.code == code && matches(reading))
        add(reading, std::numeric_limits<double>::quiet_NaN(), text_of(reading), 0.95);
  }

  // An exchange with a unit or a sign.
  void add_together(const std::vector<Reading>& swaps, const std::vector<Reading>& signs) {
    for (const auto& swap : swaps) {
      const auto numbers = swap.applied(row_.given());
      const auto factor = factor_of(row_, numbers, 0, numbers.size());
      if (const auto* unit = unit_of(length_units, factor.value, unit_tolerance())) {
        auto reading = swap;
        std::ranges::fill(reading.factor, unit->factor);
        if (matches(reading, unit->factor)) add(reading, unit->factor, text_of(reading), 0.9);
      }
      for (const auto& sign : signs) {
        auto reading = swap;
        reading.factor = sign.factor;
        if (matches(reading)) add(reading, -1.0, text_of(reading), 0.8);
      }
    }
  }

  std::string text_of(const Reading& reading) const {
    return reading.permutes() ? columns_option(reading, row_.opening().columns, row_.masses())
                              : reversed_columns(reading, row_.masses());
  }

  std::optional<Diagnosis> best() {
    if (found_.empty()) return {};
    double least = INFINITY;
    for (const auto& one : found_) least = std::fmin(least, one.flight);
    auto chosen = found_.front();
    for (const auto& one : found_) {
      if (!(one.flight > 2.0 * least + row_.tolerance())) {
        chosen = one;
        break;
      }
    }
    // The flight after it is another one: the start alone is read wrongly, not the file.
    if (chosen.flight > agreeing * plain_flight_) chosen.diagnosis.confidence -= 0.25;
    const double left = row_.distance(chosen.reading.applied(row_.given()), row_.expected());
    chosen.diagnosis.evidence.push_back({"gain", row_.distance() / std::max(left, 1e-16)});
    return chosen.diagnosis;
  }

  // A flight under the right reading is nearer to the motion by this factor.
  static constexpr double agreeing = 0.3;

  const FirstRow& row_;
  double plain_flight_;
  std::vector<Candidate> found_;
};

}  // namespace

std::optional<Diagnosis> start_as_reading(const FirstRow& row) { return ShapeSearch(row).run(); }

}  // namespace clackers::diagnose
