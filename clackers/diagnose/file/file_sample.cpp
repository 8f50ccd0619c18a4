#include "clackers/diagnose/file/file_sample.hpp"

#include <algorithm>
#include <cmath>

#include "clackers/diagnose/file/reading.hpp"

namespace clackers::diagnose {
namespace {

// Square differences of one mass, from row `first` on, over the scale; the `left_out` share of the
// largest does not count.
double rms(const std::vector<double>& found, const std::vector<double>& reference, std::size_t mass,
           std::size_t masses, std::size_t first, double scale, double left_out) {
  std::vector<double> squares;
  for (auto i = first * masses + mass; i < found.size(); i += masses) {
    const double part = (found[i] - reference[i]) / scale;
    squares.push_back(part * part);
  }
  if (squares.empty()) return 0.0;
  const auto kept = squares.size() - std::size_t(left_out * double(squares.size()));
  std::ranges::nth_element(squares, squares.begin() + std::ptrdiff_t(kept - 1));
  double sum = 0.0;
  for (std::size_t i = 0; i < kept; ++i) sum += squares[i];
  return std::sqrt(sum / double(kept));
}

}  // namespace

FileSample::FileSample(const Observation& history, const model::Motion& motion)
    : history_(history),
      motion_(motion),
      scale_(motion.peak()),
      reference_(reference_rows(motion, history.sample.t)),
      distance_(distance(rows(), reference_, 0)) {
  const auto masses = std::size_t(rows().dof);
  std::vector<double> errors(rows().t.size(), 0.0);
  for (std::size_t i = 0; i < rows().u.size(); ++i)
    errors[i / masses] = std::max(errors[i / masses], std::abs(rows().u[i] - reference_.u[i]) /
                                                          scale_.u[Eigen::Index(i % masses)]);
  largest_ = std::ranges::max(errors);
  const auto middle = errors.begin() + std::ssize(errors) / 2;
  std::ranges::nth_element(errors, middle);
  median_ = *middle;
}

RowDistance FileSample::distance(const model::Trajectory& found, const model::Trajectory& reference,
                                 std::size_t first) const {
  constexpr double near_impacts = 0.1;
  const auto masses = std::size_t(found.dof);
  RowDistance result;
  for (std::size_t mass = 0; mass < masses; ++mass) {
    const auto at = Eigen::Index(mass);
    result.u =
        std::max(result.u, rms(found.u, reference.u, mass, masses, first, scale_.u[at], 0.0));
    if (found.v.empty()) continue;
    result.v = std::max(result.v,
                        rms(found.v, reference.v, mass, masses, first, scale_.v[at], near_impacts));
  }
  return result;
}

RowDistance FileSample::distance_at(const std::vector<double>& times) const {
  return distance(rows(), reference_rows(motion_, times), 0);
}

RowDistance FileSample::distance_of(const model::Trajectory& other) const {
  return distance(other, reference_, 1);
}

std::vector<FileSample> samples_of(const DiagnosisInput& question) {
  constexpr std::size_t most = 8;
  std::vector<FileSample> files;
  const auto count = question.histories.size(), kept = std::min(count, most);
  for (std::size_t i = 0; i < kept; ++i) {
    const auto from_finest = kept == 1 ? 0 : i * (count - 1) / (kept - 1);
    files.emplace_back(question.histories[count - 1 - from_finest], question.motion);
  }
  return files;
}

}  // namespace clackers::diagnose
