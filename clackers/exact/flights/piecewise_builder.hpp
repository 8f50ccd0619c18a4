#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/numerics/first_root.hpp"
#include "clackers/numerics/lcp.hpp"

namespace clackers::exact {

/// Goes from impact to impact: piecewise_builder.cpp has the regimes, impact_search.cpp what closes next,
/// impacts.cpp the impacts.
class PiecewiseMotion::Builder {
  using Index = Eigen::Index;
  using MatrixXd = Eigen::MatrixXd;
  using VectorXd = Eigen::VectorXd;

 public:
  /// Both outlive it.
  Builder(const model::ImpactProblem<>& problem, PiecewiseMotion& motion);

  void build();

 private:
  /// Speeds below this share of their sizes are those of masses that stay together.
  static constexpr double touching_share = 1e-12;

  /// Of a contact: its gap and three derivatives by z, and the change of z by a unit impulse.
  struct Row {
    MatrixXd by_state;  // a column each
    VectorXd impulse;
    auto gap() const { return by_state.col(0); }
    auto rate() const { return by_state.col(1); }
  };
  /// A contact that closes s seconds into the flight.
  struct Closing {
    std::size_t contact = 0;
    double s = 0.0, gap_error = 0.0, time_error = 0.0;
    double first() const { return s - time_error; }
    double last() const { return s + time_error; }
  };

  const Flight& flight() const { return m_.flights_.back(); }
  const ForcedModes& modes() const { return m_.modes(flight()); }
  const Row& row(std::size_t i) const { return rows_[flight().regime][i]; }
  /// Contacts from here on are springs.
  std::size_t springs() const { return problem_.contacts.size(); }
  double factor() const { return m_.factor(m_.flights_.size() - 1); }
  double delassus(std::size_t i, std::size_t j) const { return row(i).rate().dot(row(j).impulse); }

  /// The structure with these springs closed.
  std::size_t regime(const std::vector<bool>& closed);
  /// A spring closes or opens. Displacements, velocities and forces are continuous.
  void change_regime();
  void begin(std::size_t regime, double t, const VectorXd& z, MatrixXd covariance);

  /// The gap of contact i, s seconds into the flight; the energy of no mode grows.
  numerics::LocalBound gap_ahead(std::size_t i, double s) const;
  double gap_error(std::size_t i, const MatrixXd& covariance, double s) const;
  double gap_rounding(std::size_t i, const ForcedModes::Sizes& size) const;
  /// The flight is searched in windows, each twice as long as the one before, so that the error of
  /// gaps is bounded by about what it is.
  std::vector<Closing> next_contacts();
  /// The spring that closes or opens first, and when.
  std::optional<std::pair<std::size_t, double>> next_switching(double from, double until,
                                                               double fastest) const;
  [[noreturn]] void refuse_length() const;
  /// certain_gap times a bound on the error of each gap up to s seconds into the flight.
  std::vector<double> levels(double s) const;
  /// From where on contact i is open for certain.
  double opening(std::size_t i, double level) const;
  std::vector<Closing> search(const std::vector<double>& level, const std::vector<double>& from,
                              double to) const;
  double highest_force() const;
  [[noreturn]] void refuse_graze(std::size_t i, double t, double gap, double error) const;
  /// A closed contact that does not open, or by less than the error.
  [[noreturn]] void refuse_closed(std::size_t i, const numerics::LocalBound& gap,
                                  double level) const;

  /// The contacts that close first. Those that act on each other and whose order the errors do not
  /// show belong to them only if they close together for certain; the others come in flights of
  /// their own.
  std::vector<Closing> closing_first(const std::vector<Closing>& closings) const;
  /// Whether an impulse of one changes the gap rate of the other.
  bool act_on_each_other(const Closing& a, const Closing& b) const;
  /// Newton's law for contacts that close together.
  void collide(const std::vector<Closing>& closings);
  /// Nothing but rounding of the speed before the impact is left: a plastic impact at equilibrium.
  bool at_rest(const VectorXd& after, const VectorXd& before, const VectorXd& z) const;
  VectorXd solve(const std::vector<std::size_t>& closed, const VectorXd& z, double t);
  /// S = R + sum over contacts of g_c n_c'/(n_c . f-): contact c, whose gap a perturbation changes
  /// by n_c . dx, comes that over its gap rate earlier, and g_c is its part of f+ - R f-. Of
  /// contacts that close together this holds while they stay together, or do not act on each other.
  void add_saltation(const std::vector<std::size_t>& closed, const VectorXd& impulses,
                     const VectorXd& z, const VectorXd& a_before, MatrixXd& saltation,
                     VectorXd& time_error) const;

  const model::ImpactProblem<>& problem_;
  PiecewiseMotion& m_;
  numerics::LcpSolver lcp_;
  std::vector<model::Contact<>> contacts_;         // those of the problem, then springs
  std::vector<double> stiffnesses_;                // of the springs
  std::vector<std::vector<bool>> closed_springs_;  // of each regime
  std::vector<std::vector<Row>> rows_;             // of each regime
  std::optional<std::pair<std::size_t, double>> switching_;
  double stiffest_ = 0.0;  // frequency of a spring and the masses that it joins
  std::vector<bool> is_closed_;
  bool rests_ = false;
};

}  // namespace clackers::exact
