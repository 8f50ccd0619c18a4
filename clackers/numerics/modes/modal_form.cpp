#include "clackers/numerics/modes/modal_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/constants.hpp"
#include "clackers/numerics/sine_cosine.hpp"

namespace clackers::numerics {
namespace {

double size(const Mode& mode, const ModalState& now) {
  return std::sqrt(now.rate * now.rate + mode.omega * mode.omega * now.y * now.y);
}

bool acts(const ModalState& push) { return push.y != 0.0 || push.rate != 0.0; }

// A bound on the size of a mode with omega > 0 that a constant force pushes, for `reach` seconds, omega reach <= 1/8:
// |y'| <= |y0'| + m (|push.rate| + omega^2 |y|) with m <= reach, 1/(2 sigma), and |y| grows by as much a second.
double pushed_size(const Mode& mode, const ModalState& now, const ModalState& push, double reach) {
  const double square = mode.omega * mode.omega;
  const double m = mode.sigma > 0.0 ? std::min(reach, 0.5 / mode.sigma) : reach;
  const double y = std::abs(now.y) + reach * std::abs(push.y);
  const double rate = (std::abs(now.rate) + m * (std::abs(push.rate) + square * y)) * (64.0 / 63.0);
  return std::hypot(rate, mode.omega * (y + reach * rate));
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
      const double rate_shape = system.is_coupled() ? system.rate_shapes()(row, column) : 0.0;
      y_part += b[i] * shape;
      rate_part += b[i] * rate_shape;
      if (d.empty()) continue;
      y_part -= d[i] * rate_shape * mode.omega_square;
      rate_part += d[i] * (shape - 2.0 * mode.sigma * rate_shape);
    }
    add(system.modes()[j], j, y_part, rate_part);
  }
  std::ranges::sort(parts_, {}, &Part::omega);
}

ModalForm::ModalForm(const ModalSystem& system, const Eigen::VectorXd& row, double offset)
    : offset_(offset) {
  const auto n = std::ssize(system.modes());
  for (Eigen::Index j = 0; j < n; ++j)
    add(system.modes()[std::size_t(j)], std::size_t(j), row[j], row[n + j]);
  std::ranges::sort(parts_, {}, &Part::omega);
}

void ModalForm::add(const Mode& mode, std::size_t index, double y_part, double rate_part) {
  if (y_part == 0.0 && rate_part == 0.0) return;
  Part part{.mode = index, .y = {y_part}, .rate = {rate_part}, .bound = {}, .omega = mode.omega};
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

void FormAhead::begin(const ModalSystem& system, const ModalForm& form,
                      std::span<const ModalState> start, double sign,
                      std::span<const ModalState> push) {
  std::ranges::fill(constants_, 0.0);
  constants_[0] = sign * form.offset_;
  harmonics_.clear();
  growing_.clear();
  sign_ = sign;
  growth_ = form.growth_;
  parts_.resize(form.parts_.size());
  double faster = growth_ > 0.0 ? infinity : 0.0, radian = 0.0;
  for (std::size_t i = parts_.size(); i-- > 0;) {
    const auto& from = form.parts_[i];
    const Mode& mode = system.modes()[from.mode];
    const ModalState& now = start[from.mode];
    Part& to = parts_[i];
    to.push = push.empty() ? ModalState{} : push[from.mode];
    to.oscillates = mode.oscillates() && !acts(to.push);
    to.sigma = mode.sigma;
    to.w = mode.w;
    to.curvature = from.bound[2];
    to.third = from.bound[3];
    to.faster = faster;
    to.radian_of_next = radian;
    if (to.oscillates) {
      // y = e^(-sigma s) (p cos w s + q sin w s)
      const double p = now.y, q = (now.rate + mode.sigma * now.y) / mode.w;
      const double p_rate = mode.w * q - mode.sigma * p, q_rate = -mode.w * p - mode.sigma * q;
      for (int k = 0; k < 4; ++k) {
        to.cosine[k] = sign * (from.y[k] * p + from.rate[k] * p_rate);
        to.sine[k] = sign * (from.y[k] * q + from.rate[k] * q_rate);
      }
      // With y = R cos x: z^2 = R^2 (omega^2 + sigma^2 cos 2x + sigma w sin 2x).
      to.size =
          std::sqrt((p * p + q * q) * (mode.omega_square + std::abs(mode.sigma) * mode.omega));
    } else {
      to.size = numerics::size(mode, now);
      to.mode = &mode;
      to.start = now;
      to.form = &from;
      if (acts(to.push)) {
        for (int k = 1; k < 4; ++k)
          constants_[k] += sign * (from.y[k - 1] * to.push.y + from.rate[k - 1] * to.push.rate);
        to.size = mode.omega == 0.0 && mode.sigma > 0.0
                      ? std::max(to.size, std::abs(to.push.rate) / (2.0 * mode.sigma))
                      : infinity;
      }
    }
    faster += from.bound[0] * to.size;
    radian = 1.0 / from.omega;
  }
}

void FormAhead::add(const Beat& beat, const BeatForm& form, double t) {
  auto& to = growing_.emplace_back(Growing{beat, t, {{sign_ * form.e, sign_ * form.r}}});
  for (int k = 1; k < 4; ++k) to.derivatives[k] = to.derivatives[k - 1].derivative(beat);
}

LocalBound FormAhead::ahead(double s, double level, bool is_whole) const {
  LocalBound ahead{constants_[0] - level, constants_[1],           constants_[2],
                   constants_[3],         std::abs(constants_[2]), std::abs(constants_[3])};
  for (const auto& [y, frequency] : harmonics_) {
    const auto [sine, cosine] = sine_cosine(frequency * s);
    const double real = y.real() * cosine - y.imag() * sine;
    const double imaginary = y.real() * sine + y.imag() * cosine;
    const double square = frequency * frequency, size = std::abs(y);
    ahead.value += real;
    ahead.slope -= frequency * imaginary;
    ahead.second -= square * real;
    ahead.third += square * frequency * imaginary;
    ahead.curvature += square * size;
    ahead.third_bound += square * frequency * size;
  }
  for (const auto& [beat, t, derivatives] : growing_) {
    const auto now = beat.at(t + s);
    // For as long as the beat has lasted, or a radian.
    const double reach = std::max(t + s, 1.0 / std::abs(beat.mu)), most = beat.most(t + s + reach);
    ahead.value += derivatives[0].value(now);
    ahead.slope += derivatives[1].value(now);
    ahead.second += derivatives[2].value(now);
    ahead.third += derivatives[3].value(now);
    ahead.curvature += derivatives[2].bound(most);
    ahead.third_bound += derivatives[3].bound(most);
    ahead.reach = std::min(ahead.reach, reach);
  }
  double sigma = 0.0, decay = 1.0;
  for (const Part& part : parts_) {
    double z = 0.0;
    if (part.oscillates) {
      if (part.sigma != sigma) {
        sigma = part.sigma;
        decay = std::exp(-sigma * s);
      }
      const auto [sine, cosine] = sine_cosine(part.w * s);
      const double c = decay * cosine, n = decay * sine;
      ahead.value += part.cosine[0] * c + part.sine[0] * n;
      ahead.slope += part.cosine[1] * c + part.sine[1] * n;
      ahead.second += part.cosine[2] * c + part.sine[2] * n;
      ahead.third += part.cosine[3] * c + part.sine[3] * n;
      z = decay * part.size;
    } else {
      auto now = advance(*part.mode, part.start, s);
      z = size(*part.mode, now);
      if (acts(part.push)) {
        const auto more = pushed(*part.mode, part.push, s);
        now.y += more.y;
        now.rate += more.rate;
        if (part.mode->omega > 0.0) {
          const double reach = 0.125 / part.mode->omega;
          ahead.reach = std::min(ahead.reach, reach);
          z = pushed_size(*part.mode, now, part.push, reach);
        } else if (part.mode->sigma > 0.0) {
          // The rate goes to its limit without turning.
          z = std::max(std::abs(now.rate), part.size);
        }
      }
      const auto& form = *part.form;
      ahead.value += sign_ * (form.y[0] * now.y + form.rate[0] * now.rate);
      ahead.slope += sign_ * (form.y[1] * now.y + form.rate[1] * now.rate);
      ahead.second += sign_ * (form.y[2] * now.y + form.rate[2] * now.rate);
      ahead.third += sign_ * (form.y[3] * now.y + form.rate[3] * now.rate);
    }
    ahead.curvature += part.curvature * z;
    ahead.third_bound += part.third * z;
    // The next mode, resolved, is good for two radians of it or so: is the sum of these above the
    // amplitudes of the others for one?
    const double above = ahead.value - part.faster, x = part.radian_of_next;
    if (!is_whole && x > 0.0 && above > 0.0 &&
        above + x * (ahead.slope - 0.5 * x * ahead.curvature) > 0.0) {
      ahead.value = above;
      ahead.whole = false;
      break;
    }
  }
  if (growth_ > 0.0) {
    ahead.reach = std::min(ahead.reach, 0.5 / growth_);
    constexpr double growth = 1.6488;  // more than e^(1/2)
    ahead.curvature *= growth;
    ahead.third_bound *= growth;
  }
  return ahead;
}

}  // namespace clackers::numerics
