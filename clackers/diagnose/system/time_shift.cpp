#include <algorithm>
#include <cmath>

#include "clackers/diagnose/file/file_sample.hpp"
#include "clackers/diagnose/file/reading.hpp"
#include "clackers/diagnose/system/fit_rows.hpp"
#include "clackers/diagnose/system/measured_causes.hpp"

namespace clackers::diagnose {
namespace {

struct Shift {
  double seconds = 0.0, gain = 0.0;
};

// Gauss-Newton steps of the time by which the states of a file stand late.
Shift shift_of(const FileSample& file) {
  Shift shift{.seconds = late_start(file.history(), file.motion())};
  const auto& rows = file.rows();
  auto times = rows.t;
  for (double& t : times) t -= shift.seconds;
  const auto dof = std::size_t(rows.dof);
  for (int step = 0; step < 6; ++step) {
    const auto reference = reference_rows(file.motion(), times);
    double over = 0.0, under = 0.0;
    for (std::size_t i = 0; i < rows.u.size(); ++i) {
      const double weight = 1.0 / std::pow(file.scale().u[Eigen::Index(i % dof)], 2);
      over += weight * (rows.u[i] - reference.u[i]) * reference.v[i];
      under += weight * reference.v[i] * reference.v[i];
    }
    if (!(under > 0.0)) return {};
    shift.seconds -= over / under;
    for (std::size_t i = 0; i < times.size(); ++i) times[i] = rows.t[i] - shift.seconds;
  }
  shift.gain = file.distance().u / std::max(file.distance_at(times).u, 1e-300);
  return shift;
}

}  // namespace

std::optional<Diagnosis> shifted_time(const DiagnosisInput& question) {
  constexpr double least_gain = 30.0, least_gain_alone = 100.0, least_gain_beside = 3.0;
  constexpr double same = 0.1, whole_share = 0.03, visible = 1e-9;
  const FileSample finest(question.histories.back(), question.motion);
  if (!(finest.distance().u > visible)) return {};
  const auto found = shift_of(finest);
  const double step = question.by_tolerance ? 0.0 : finest.history().facts.step;
  const double halves = step > 0.0 ? std::round(2.0 * found.seconds / step) : 0.0;
  bool in_steps = halves != 0.0 && std::abs(2.0 * found.seconds / step - halves) < whole_share;
  double spread = 0.0, files = 1.0;
  if (question.histories.size() > 1) {
    const FileSample other(question.histories[question.histories.size() - 2], question.motion);
    const auto again = shift_of(other);
    const double factor = step > 0.0 ? other.history().facts.step / step : 1.0;
    const auto apart = [&](double by) { return std::abs(again.seconds - by * found.seconds); };
    const double seconds = std::abs(found.seconds);
    in_steps = in_steps && apart(factor) < same * factor * seconds;
    if (again.gain < least_gain_beside || !(in_steps || apart(1.0) < same * seconds)) return {};
    spread = apart(in_steps ? factor : 1.0);
    files = 2.0;
  }
  if (!(found.gain > (files > 1.0 ? least_gain : least_gain_alone))) return {};
  auto cause = in_steps ? diagnosis_of(Code("time-shifted"), found.seconds / step, "steps")
                        : diagnosis_of(Code("time-shifted"), found.seconds, "s");
  cause.confidence = files > 1.0 ? 0.95 : 0.8;
  cause.evidence = {
      {"gain", found.gain}, {"uncertainty", in_steps ? spread / step : spread}, {"files", files}};
  return cause;
}

}  // namespace clackers::diagnose
