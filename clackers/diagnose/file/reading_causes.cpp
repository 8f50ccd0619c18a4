#include <algorithm>
#include <cmath>

#include "clackers/diagnose/file/file_sample.hpp"
#include "clackers/diagnose/file/reading.hpp"
#include "clackers/diagnose/file/units.hpp"

namespace clackers::diagnose {
namespace {

// A file that is read wrongly is off by about the motion itself; read rightly it has the error of its
// method. Below `visible` nothing is read wrongly, above `acceptable` no reading is right. A gain of
// 10 is far from the 1.4 that the best of 40 wrong readings of a wrong history has.
constexpr double visible = 0.05, acceptable = 0.1, least_reading_gain = 10.0;

double whole(const RowDistance& distance) { return std::max(distance.u, distance.v); }

struct ReadingCandidate {
  Reading reading;
  Diagnosis cause;
};

class ReadingSearch {
 public:
  explicit ReadingSearch(const std::vector<FileSample>& files)
      : files_(files), finest_(files.front()), plain_(whole(finest_.distance_of(finest_.rows()))) {}

  std::vector<Diagnosis> run() {
    if (!(plain_ > visible)) return {};
    const auto masses = std::size_t(finest_.rows().dof);
    const auto swaps = exchanges(masses, finest_.has_v());
    for (const auto& swap : swaps)
      take(swap, columns_option(swap, finest_.history().facts.order, masses));
    for (const auto& sign : reversals(masses, finest_.has_v()))
      take(sign, reversed_columns(sign, masses));
    take_units();
    if (!best_) return {};
    auto& cause = best_->cause;
    const double gain = plain_ / least_;
    if (!(least_ < acceptable) || !(gain > least_reading_gain)) return {};
    double same = 0.0;
    for (const auto& file : files_)
      same += whole(file.distance_of(read_as(best_->reading, file.rows()))) * 3.0 <
              whole(file.distance_of(file.rows()));
    cause.confidence = gain > 30.0 ? 0.95 : 0.85;
    cause.evidence = {{"gain", gain}, {"runner-up-gain", plain_ / second_}, {"files", same}};
    return {cause};
  }

 private:
  // The first of equal readings counts: they are ordered by how far they are believed.
  void take(const Reading& reading, std::string text,
            double value = std::numeric_limits<double>::quiet_NaN()) {
    const double left = whole(finest_.distance_of(read_as(reading, finest_.rows())));
    if (left < 0.5 * least_) {
      second_ = least_;
      least_ = left;
      best_ = ReadingCandidate{reading, {}};
      best_->cause.code = reading.code;
      best_->cause.text = std::move(text);
      best_->cause.value = value;
    } else {
      second_ = std::min(second_, left);
    }
  }

  void take_units() {
    const auto& rows = finest_.rows();
    const auto reference = reference_rows(finest_.motion(), rows.t, finest_.has_v());
    const double u = factor_of(rows.u, reference.u), v = factor_of(rows.v, reference.v);
    // The method's own error is in the factor.
    constexpr double tolerance = 0.02;
    const auto masses = std::size_t(rows.dof);
    const auto scaled = [&](double of_u, double of_v) {
      auto reading = Reading::plain(finest_.has_v() ? 2 * masses : masses);
      reading.code = "unit-scaled";
      for (std::size_t q = 0; q < reading.factor.size(); ++q)
        reading.factor[q] = q < masses ? of_u : of_v;
      return reading;
    };
    if (const auto* unit = unit_of(length_units, u, tolerance)) {
      const std::string name(unit->name);
      take(scaled(unit->factor, unit->factor), name, unit->factor);
      if (finest_.has_v()) take(scaled(unit->factor, 1.0), "u " + name, unit->factor);
    }
    if (!finest_.has_v()) return;
    if (const auto* unit = unit_of(length_units, v, tolerance))
      take(scaled(1.0, unit->factor), "v " + std::string(unit->name) + "/s", unit->factor);
    else if (const auto* time = unit_of(time_units, 1.0 / v, tolerance))
      take(scaled(1.0, 1.0 / time->factor), "v m/" + std::string(time->name), 1.0 / time->factor);
    else if (v > 0.0)
      take(scaled(1.0, v), "v", v);
  }

  const std::vector<FileSample>& files_;
  const FileSample& finest_;
  double plain_;
  double least_ = INFINITY, second_ = INFINITY;
  std::optional<ReadingCandidate> best_;
};

}  // namespace

std::vector<Diagnosis> reading_causes(const std::vector<FileSample>& files) {
  return ReadingSearch(files).run();
}

}  // namespace clackers::diagnose
