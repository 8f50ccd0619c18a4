#pragma once

#include <Eigen/Core>
#include <complex>
#include <span>
#include <vector>

#include "clackers/numerics/first_root.hpp"
#include "clackers/numerics/modes/beat.hpp"
#include "clackers/numerics/modes/modal_flight.hpp"

namespace clackers::numerics {

/// f = offset + b . u + d . v of a modal motion as a function of time, with what first_root() needs
/// to know of it ahead. For every mode and z = sqrt(y'^2 + omega^2 y^2), which does not grow where
/// sigma >= 0 and omega^2 >= 0 and grows by e^(growth s) at most elsewhere, the k-th derivative of
/// its part is at most a constant times z.
class ModalForm {
 public:
  ModalForm() = default;
  /// `d` may be empty.
  ModalForm(const ModalSystem& system, std::span<const double> b, std::span<const double> d,
            double offset);
  /// row . (y_1, y_2, ..., y_1', y_2', ...) + offset
  ModalForm(const ModalSystem& system, const Eigen::VectorXd& row, double offset);

  double offset() const { return offset_; }
  /// How far from its value s seconds after `start` it can be by rounding alone: 4 units a term and
  /// those of the phase omega s.
  double rounding(const ModalSystem& system, std::span<const ModalState> start, double s) const;
  /// The k-th derivative, k = 0 ... 3, at a state.
  double derivative(std::span<const ModalState> now, int k) const;
  /// Bound of the k-th derivative, k = 0 ... 4, at this state and, without growth, after it.
  double derivative_bound(const ModalSystem& system, std::span<const ModalState> now, int k) const;

 private:
  friend class FormAhead;
  struct Part {
    std::size_t mode;
    double y[4], rate[4];  // f^(k) = sum y[k] y + rate[k] y'
    double bound[5];       // |f^(k)| <= bound[k] z
    double omega;
  };
  void add(const Mode& mode, std::size_t index, double y_part, double rate_part);

  std::vector<Part> parts_;  // by ascending omega
  double offset_ = 0.0, growth_ = 0.0;
};

/// One flight of a form from modal states `start`, `sign` times it. Modes are added from the slowest
/// to the fastest and only as far as needed: as long as the sum of the slow ones is above the
/// amplitudes of the others, their bounds say how far it stays so, whatever the fast ones do.
class FormAhead {
 public:
  FormAhead() = default;
  /// `system` and `form` must outlive it, or the next begin().
  FormAhead(const ModalSystem& system, const ModalForm& form, std::span<const ModalState> start,
            double sign) {
    begin(system, form, start, sign);
  }
  /// Another flight. Allocates only for more modes than ever before. `push` of each mode as for
  /// pushed(), or empty.
  void begin(const ModalSystem& system, const ModalForm& form, std::span<const ModalState> start,
             double sign, std::span<const ModalState> push = {});
  /// Adds `sign` times the real part of y e^(i frequency s) to the flight.
  void add(std::complex<double> y, double frequency) {
    harmonics_.push_back({sign_ * y, frequency});
  }

  /// And of this form of a beat that began t before the flight.
  void add(const Beat& beat, const BeatForm& form, double t);

  /// What is known of it, less `level`, ahead of s.
  LocalBound operator()(double s, double level = 0.0) const { return ahead(s, level, false); }
  /// Of all modes.
  LocalBound whole(double s) const { return ahead(s, 0.0, true); }

 private:
  // A mode of the flight. Where it oscillates its part of the k-th derivative is
  // e^(-sigma s) (cosine[k] cos w s + sine[k] sin w s), |z| <= size e^(-sigma s).
  struct Part {
    bool oscillates;
    double sigma, w, size;
    double cosine[4], sine[4];
    double curvature, third;  // bounds over z
    double faster;            // amplitudes of all parts after this one
    double radian_of_next;    // 1/omega of the next part
    const Mode* mode;         // of one that does not oscillate, with its state and its form
    ModalState start, push;
    const ModalForm::Part* form;
  };
  struct Harmonic {
    std::complex<double> y;
    double frequency;
  };
  struct Growing {
    Beat beat;
    double t;
    BeatForm derivatives[4];
  };
  LocalBound ahead(double s, double level, bool is_whole) const;

  std::vector<Part> parts_;
  std::vector<Harmonic> harmonics_;
  std::vector<Growing> growing_;
  double constants_[4];  // the offset, and what pushes add to the derivatives
  double sign_ = 1.0, growth_ = 0.0;
};

}  // namespace clackers::numerics
