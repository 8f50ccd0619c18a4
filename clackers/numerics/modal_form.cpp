#include "clackers/numerics/modal_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clackers::numerics {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double size(const Mode& mode, const ModalState& now) {
  return std::sqrt(now.rate * now.rate + mode.omega * mode.omega * now.y * now.y);
}

}  // namespace

ModalForm::ModalForm(const ModalSystem& system, std::span<const double> b,
                     std::span<const double> d, double offset)
    : offset_(offset) {
  for (std::size_t j = 0; j < system.modes().size(); ++j) {
    const Mode& mode = system.modes()[j];
    // b . u + d . v = y_part y + rate_part y'
    double y_part = 0.0, rate_part = 0.0;
    for (std::size_t i = 0; i < b.size(); ++i) {
      const auto row = Eigen::Index(i), column = Eigen::Index(j);
      const double shape = system.shapes()(row, column);
      const double rate_shape = system.rate_shapes()(row, column);
      y_part += b[i] * shape;
      rate_part += b[i] * rate_shape;
      if (d.empty()) continue;
      y_part -= d[i] * rate_shape * mode.omega_square;
      rate_part += d[i] * (shape - 2.0 * mode.sigma * rate_shape);
    }
    if (y_part == 0.0 && rate_part == 0.0) continue;
    Part part{.mode = j, .y = {y_part}, .rate = {rate_part}, .bound = {}, .omega = mode.omega};
    for (int k = 0; k <= 4; ++k) {
      part.bound[k] = mode.omega > 0.0 ? std::hypot(rate_part, y_part / mode.omega)
                      : y_part != 0.0  ? infinity
                                       : std::abs(rate_part);
      if (k < 4) {
        part.y[k] = y_part;
        part.rate[k] = rate_part;
      }
      const double next = y_part - 2.0 * mode.sigma * rate_part;
      y_part = -mode.omega_square * rate_part;
      rate_part = next;
    }
    growth_ = std::max(growth_, mode.growth());
    parts_.push_back(part);
  }
  std::ranges::sort(parts_, {}, &Part::omega);
}

double ModalForm::amplitude(const ModalSystem& system, std::span<const ModalState> start,
                            double until) const {
  double sum = 0.0;
  for (const Part& part : parts_) {
    const Mode& mode = system.modes()[part.mode];
    const ModalState& now = start[part.mode];
    sum += part.omega > 0.0
               ? part.bound[0] * size(mode, now)
               : std::abs(part.y[0]) * std::abs(now.y) +
                     (std::abs(part.y[0]) * until + std::abs(part.rate[0])) * std::abs(now.rate);
  }
  return growth_ > 0.0 ? sum * std::exp(growth_ * until) : sum;
}

double ModalForm::rounding(const ModalSystem& system, std::span<const ModalState> start,
                           double s) const {
  double sum = std::abs(offset_);
  for (const Part& part : parts_) {
    const ModalState& now = start[part.mode];
    const double z = size(system.modes()[part.mode], now);
    sum += part.omega > 0.0 ? part.bound[0] * z * (1.0 + part.omega * s)
                            : std::abs(part.y[0] * now.y) + std::abs(part.y[0] * now.rate) * s +
                                  std::abs(part.rate[0] * now.rate);
  }
  return 4.0 * std::numeric_limits<double>::epsilon() * sum;
}

double ModalForm::derivative(std::span<const ModalState> now, int k) const {
  double sum = k == 0 ? offset_ : 0.0;
  for (const Part& part : parts_) {
    const auto& [y, rate] = now[part.mode];
    sum += part.y[k] * y + part.rate[k] * rate;
  }
  return sum;
}

double ModalForm::derivative_bound(const ModalSystem& system, std::span<const ModalState> now,
                                   int k) const {
  double sum = 0.0;
  for (const Part& part : parts_)
    sum += part.bound[k] * size(system.modes()[part.mode], now[part.mode]);
  return sum;
}

FormAhead::FormAhead(const ModalSystem& system, const ModalForm& form,
                     std::span<const ModalState> start, double sign,
                     std::vector<double>& amplitudes)
    : system_(system), form_(form), start_(start), sign_(sign) {
  amplitudes.resize(form.parts_.size());
  double sum = form.growth_ > 0.0 ? infinity : 0.0;
  for (std::size_t i = form.parts_.size(); i-- > 0;) {
    amplitudes[i] = sum;
    const auto& part = form.parts_[i];
    sum += part.bound[0] * size(system.modes()[part.mode], start[part.mode]);
  }
  amplitudes_ = amplitudes;
}

LocalBound FormAhead::operator()(double s) const {
  LocalBound ahead;
  ahead.value = sign_ * form_.offset_;
  const auto& parts = form_.parts_;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto& part = parts[i];
    const Mode& mode = system_.modes()[part.mode];
    const auto now = advance(mode, start_[part.mode], s);
    const double z = size(mode, now);
    ahead.value += sign_ * (part.y[0] * now.y + part.rate[0] * now.rate);
    ahead.slope += sign_ * (part.y[1] * now.y + part.rate[1] * now.rate);
    ahead.second += sign_ * (part.y[2] * now.y + part.rate[2] * now.rate);
    ahead.curvature += part.bound[2] * z;
    ahead.third += part.bound[3] * z;
    if (i + 1 == parts.size()) break;
    // The next mode, resolved, is good for two radians of it or so.
    const double above = ahead.value - amplitudes_[i];
    if (above > 0.0 &&
        first_zero(above, ahead.slope, -ahead.curvature) * parts[i + 1].omega > 1.0) {
      ahead.value = above;
      ahead.whole = false;
      break;
    }
  }
  if (form_.growth_ > 0.0) {
    ahead.reach = 0.5 / form_.growth_;
    constexpr double growth = 1.6488;  // more than e^(1/2)
    ahead.curvature *= growth;
    ahead.third *= growth;
  }
  return ahead;
}

}  // namespace clackers::numerics
