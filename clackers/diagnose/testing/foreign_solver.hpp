#pragma once

// A small time-stepping program with one contact and the usual mistakes, for tests only: nothing of
// it comes from methods/.

#include <Eigen/LU>
#include <cmath>
#include <memory>
#include <random>

#include "clackers/measure/errors/mechanics.hpp"
#include "clackers/measure/errors/vectors.hpp"
#include "clackers/model/impact_problem.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers::diagnose::testing {

enum class Integrator { implicit_euler, newmark, explicit_euler, rk4, exact };
enum class Location { bisection, end_of_step, start_of_step, linear, spring, none };

/// One solver. Parameters of the problem may be changed before it is given.
struct ForeignSolver {
  Integrator integrator = Integrator::rk4;
  Location location = Location::bisection;
  double tolerance = 0.0;  ///< of the bisection [s]; 0: down to rounding
  double spring = 0.0;     ///< [N/m] of Location::spring, for rk4 alone
  double dashpot = 0.0;    ///< [N s/m] beside it; acts in tension, too
  double noise = 0.0;      ///< standard deviation of u and v as printed
  unsigned seed = 1;
  bool reports_impacts = false;
  double closed_below = 0.0;  ///< gap that counts as closed [m]
};

/// Force of a spring and a dashpot while a gap is closed.
struct SpringContact : model::NonlinearForce<model::any_dof> {
  model::Contact<> contact;
  double spring, dashpot;
  SpringContact(model::Contact<> which, double k, double c)
      : contact(std::move(which)), spring(k), dashpot(c) {}
  void add(const Eigen::VectorXd& u, const Eigen::VectorXd& v, Eigen::VectorXd& p) const override {
    const double gap = contact.gap_at(u);
    if (gap < 0.0) p += (spring * gap + dashpot * contact.gap_rate(v)) * contact.direction;
  }
  void add_tangent(const Eigen::VectorXd&, const Eigen::VectorXd&, Eigen::MatrixXd&,
                   Eigen::MatrixXd&) const override {}
};

class ForeignRun {
 public:
  using State = measure::FreeState;

  ForeignRun(const model::ImpactProblem<>& problem, const ForeignSolver& solver)
      : problem_(problem), solver_(solver), system_(problem.system), random_(solver.seed) {
    if (solver.location == Location::spring)
      system_.nonlinear =
          std::make_shared<SpringContact>(problem.contacts.front(), solver.spring, solver.dashpot);
    motion_ = std::make_unique<measure::FreeMotion>(system_);
  }

  /// Rows at n h, n = 0, 1, ..., as far as the problem's end.
  model::Trajectory run(double h) {
    rows_.dof = int(problem_.dof());
    if (solver_.reports_impacts) rows_.impacts.emplace();
    State now{0.0, problem_.start.u, problem_.start.v};
    const auto steps = (long long)(std::floor(problem_.end / h * (1.0 + 1e-12)));
    add(now);
    for (long long n = 1; n <= steps; ++n) {
      now = advanced(now, h);
      now.t = double(n) * h;
      if (!now.u.allFinite()) break;
      add(now);
    }
    return std::move(rows_);
  }

 private:
  void add(const State& now) {
    rows_.t.push_back(now.t);
    for (auto [from, to] : {std::pair{&now.u, &rows_.u}, std::pair{&now.v, &rows_.v}})
      for (const double x : *from)
        to->push_back(x + (solver_.noise > 0.0 ? solver_.noise * normal_(random_) : 0.0));
  }

  State step(const State& from, double h) const {
    const Eigen::MatrixXd &M = system_.mass, &C = system_.damping, &K = system_.stiffness;
    switch (solver_.integrator) {
      case Integrator::rk4:
        return motion_->moved(from, h);
      case Integrator::exact: {
        // Closed form of each underdamped mass; the matrices of these problems are diagonal.
        State now = from;
        now.t += h;
        for (Eigen::Index i = 0; i < now.u.size(); ++i) {
          const double sigma = 0.5 * C(i, i) / M(i, i), omega2 = K(i, i) / M(i, i);
          const double w = std::sqrt(omega2 - sigma * sigma), decay = std::exp(-sigma * h);
          const double cosine = std::cos(w * h), sine = std::sin(w * h) / w;
          now.u[i] = decay * (from.u[i] * (cosine + sigma * sine) + from.v[i] * sine);
          now.v[i] = decay * (from.v[i] * (cosine - sigma * sine) - from.u[i] * omega2 * sine);
        }
        return now;
      }
      case Integrator::explicit_euler:
        return {from.t + h, from.u + h * from.v,
                from.v + h * motion_->acceleration(from.t, from.u, from.v)};
      case Integrator::implicit_euler: {
        const Eigen::MatrixXd A = M + h * C + h * h * K;
        const Eigen::VectorXd v = A.lu().solve(M * from.v - h * K * from.u);
        return {from.t + h, from.u + h * v, v};
      }
      default: {
        const Eigen::MatrixXd A = M + 0.5 * h * C + 0.25 * h * h * K;
        const Eigen::VectorXd a0 = motion_->acceleration(from.t, from.u, from.v);
        const Eigen::VectorXd u = from.u + h * from.v + 0.25 * h * h * a0,
                              v = from.v + 0.5 * h * a0;
        const Eigen::VectorXd a = A.lu().solve(-(C * v + K * u));
        return {from.t + h, u + 0.25 * h * h * a, v + 0.5 * h * a};
      }
    }
  }

  void strike(State& now) {
    const auto& contact = problem_.contacts.front();
    const Eigen::VectorXd push = motion_->response(contact.direction);
    const auto before = now.v;
    now.v -=
        (1.0 + contact.restitution) * contact.gap_rate(now.v) / contact.direction.dot(push) * push;
    if (rows_.impacts)
      rows_.impacts->push_back({now.t, 0, measure::entries(now.u), measure::entries(before),
                                measure::entries(now.v), std::nan("")});
  }

  bool strikes(const State& now) const {
    const auto& contact = problem_.contacts.front();
    return contact.gap_at(now.u) < solver_.closed_below && contact.gap_rate(now.v) < 0.0;
  }

  // After `most_impacts` of them in one step, masses pass through each other to its end.
  State advanced(const State& from, double h, int impacts = 0) {
    constexpr int most_impacts = 20;
    auto next = step(from, h);
    const bool rigid = solver_.location != Location::spring && solver_.location != Location::none;
    if (!rigid || problem_.contacts.empty() || !strikes(next) || impacts == most_impacts)
      return next;
    const auto& contact = problem_.contacts.front();
    if (solver_.location == Location::end_of_step) {
      strike(next);
      return next;
    }
    if (solver_.location == Location::start_of_step) {
      auto reversed = from;
      strike(reversed);
      return step(reversed, h);
    }
    double s = 0.0;
    State at = from;
    if (solver_.location == Location::linear) {
      const double g0 = contact.gap_at(from.u), g1 = contact.gap_at(next.u);
      s = h * g0 / (g0 - g1);
      at = {from.t + s, from.u + s / h * (next.u - from.u), from.v + s / h * (next.v - from.v)};
    } else {
      double high = h;
      while (high - s > std::max(solver_.tolerance, 1e-15 * (1.0 + from.t))) {
        const double middle = 0.5 * (s + high);
        (strikes(step(from, middle)) ? high : s) = middle;
      }
      s = high;
      at = step(from, s);
    }
    strike(at);
    return advanced(at, h - s, impacts + 1);
  }

  const model::ImpactProblem<>& problem_;
  ForeignSolver solver_;
  model::SmoothSystem<> system_;
  std::unique_ptr<measure::FreeMotion> motion_;
  model::Trajectory rows_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

inline model::Trajectory history_of(const ForeignSolver& solver,
                                    const model::ImpactProblem<>& problem, double h) {
  return ForeignRun(problem, solver).run(h);
}

}  // namespace clackers::diagnose::testing
