#include <algorithm>
#include <cmath>
#include <string>

#include "clackers/base/constants.hpp"
#include "clackers/diagnose/file/file_sample.hpp"
#include "clackers/diagnose/file/reading.hpp"

namespace clackers::diagnose {
namespace {

/// What stays of the difference of a mass beside a constant, or a constant rate, in rms.
constexpr double largest_rest = 0.1;
constexpr double above_printing = 30.0;
/// From one file to the next the value of a fault of the output stays.
constexpr double same_value = 0.1;

struct Departure {
  double offset = 0.0, rate = 0.0;                ///< of least squares [m], [m/s]
  double whole = 0.0;                             ///< rms of the difference from the reference [m]
  double beside_offset = 0.0, beside_rate = 0.0;  ///< what is left of it [m]
};

// Of the rows after the first, which may be the right start.
Departure departure(const FileSample& file, std::size_t mass) {
  const auto& rows = file.rows();
  const auto reference = reference_rows(file.motion(), rows.t);
  const auto dof = std::size_t(rows.dof), n = rows.t.size() - 1;
  std::vector<double> t, e;
  for (std::size_t i = 1; i <= n; ++i) {
    t.push_back(rows.t[i]);
    e.push_back(rows.u[i * dof + mass] - reference.u[i * dof + mass]);
  }
  Departure found;
  double tt = 0.0, te = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    found.offset += e[i] / double(n);
    tt += t[i] * t[i];
    te += t[i] * e[i];
  }
  found.rate = tt > 0.0 ? te / tt : 0.0;
  const auto rms = [&](double offset, double rate) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) sum += std::pow(e[i] - offset - rate * t[i], 2);
    return std::sqrt(sum / double(n));
  };
  found.whole = rms(0.0, 0.0);
  found.beside_offset = rms(found.offset, 0.0);
  found.beside_rate = rms(0.0, found.rate);
  return found;
}

std::optional<Diagnosis> of_mass(const std::vector<FileSample>& files, std::size_t mass) {
  constexpr std::size_t least_rows = 30;
  const auto& finest = files.front();
  if (finest.rows().t.size() < least_rows) return {};
  const auto found = departure(finest, mass);
  const double scale = finest.scale().u[Eigen::Index(mass)];
  if (!(found.whole >
        above_printing * scale * std::max(finest.history().facts.floor, 64.0 * epsilon)))
    return {};
  const bool drifts = found.beside_rate < found.beside_offset;
  const double rest = drifts ? found.beside_rate : found.beside_offset;
  const double value = drifts ? found.rate : found.offset;
  if (!(rest < largest_rest * found.whole)) return {};
  double count = 1.0;
  for (const auto& file : files) {
    if (&file == &finest || file.rows().t.size() < least_rows) continue;
    const auto other = departure(file, mass);
    const double again = drifts ? other.rate : other.offset;
    // The method's own error hides it in coarse files.
    if (!((drifts ? other.beside_rate : other.beside_offset) < largest_rest * other.whole))
      continue;
    if (!(std::abs(again - value) < same_value * std::abs(value))) return {};
    ++count;
  }
  if (files.size() > 1 && count < 2.0) return {};
  Diagnosis cause;
  cause.code = drifts ? "output-drifts" : "output-offset";
  cause.value = value;
  cause.unit = drifts ? "m/s" : "m";
  cause.text = "u" + std::to_string(mass + 1);
  cause.confidence = files.size() > 1 ? 0.95 : 0.8;
  cause.evidence = {{"gain", found.whole / std::max(rest, 1e-300)}, {"files", count}};
  return cause;
}

}  // namespace

// A structure that returns to its rest leaves no displacement behind, whatever is wrong with it; of
// one under loads velocities must be right.
std::vector<Diagnosis> output_causes(const std::vector<FileSample>& files,
                                     const DiagnosisInput& question) {
  const auto& system = question.problem.system;
  if (!(system.stiffness.diagonal().minCoeff() > 0.0)) return {};
  const auto& finest = files.front();
  if (system.add_load &&
      !(finest.has_v() && finest.distance().v < largest_rest * finest.distance().u))
    return {};
  std::vector<Diagnosis> all;
  for (std::size_t mass = 0; mass < std::size_t(question.problem.dof()); ++mass)
    if (auto cause = of_mass(files, mass)) all.push_back(std::move(*cause));
  return all;
}

}  // namespace clackers::diagnose
