#include "clackers/diagnose/system/flight_changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/model/harmonic_load.hpp"

namespace clackers::diagnose {
namespace {

using System = model::SmoothSystem<>;

std::string place_of(Eigen::Index i, Eigen::Index j) {
  return i == j ? fmt::format("between mass {} and the ground", i + 1)
                : fmt::format("between masses {} and {}", i + 1, j + 1);
}

// A spring or damper between i and j, or i and the ground for i = j, by its share, and all of them by one.
void add_links(std::vector<FlightChange>& all, Code code, const char* text_of_all,
               Eigen::MatrixXd System::*member, const System& system) {
  const Eigen::MatrixXd& matrix = system.*member;
  const auto before = all.size();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = i; j < matrix.rows(); ++j) {
      const double size = i == j ? matrix.row(i).sum() : -matrix(i, j);
      if (!(std::abs(size) > 1e-9 * matrix.cwiseAbs().maxCoeff())) continue;
      FlightChange one{diagnosis_of(code, NAN, "%"), {}};
      one.cause.text = place_of(i, j);
      one.parameters.push_back([=](System& changed, double d) {
        auto& to = changed.*member;
        to(i, i) += d * size;
        if (i == j) return;
        to(j, j) += d * size;
        to(i, j) -= d * size;
        to(j, i) -= d * size;
      });
      all.push_back(std::move(one));
    }
  if (all.size() < before + 2) return;
  FlightChange whole{diagnosis_of(code, NAN, "%"), {}, 0.0, true};
  whole.cause.text = text_of_all;
  whole.parameters.push_back([=](System& changed, double d) { changed.*member *= 1.0 + d; });
  all.push_back(std::move(whole));
}

void add_force(System& system, const model::HarmonicForce& force) {
  system.add_load = [before = system.add_load, added = model::HarmonicLoad({force})](
                        double t, std::span<double> sum) {
    if (before) before(t, sum);
    added(t, sum);
  };
}

}  // namespace

std::vector<FlightChange> changes_of(const System& system) {
  std::vector<FlightChange> all;
  add_links(all, Code("stiffness-differs"), "of all springs", &System::stiffness, system);
  add_links(all, Code("damping-differs"), "of all dampers", &System::damping, system);
  const auto add = [&](Code code, std::string unit, int mass) -> FlightChange& {
    all.push_back({diagnosis_of(code, NAN, std::move(unit)), {}});
    all.back().cause.evidence.push_back({"mass", mass + 1.0});
    return all.back();
  };
  const auto* load = system.add_load.target<model::HarmonicLoad>();
  for (int mass = 0; mass < system.dof(); ++mass) {
    add(Code("mass-differs"), "%", mass).parameters.push_back([=](System& changed, double d) {
      changed.mass(mass, mass) /= 1.0 - d;  // forces act by 1 / mass
    });
    const auto is_here = [&](const model::HarmonicForce& force) {
      return force.dof == mass && force.frequency == 0.0;
    };
    if (load != nullptr && std::ranges::any_of(load->forces(), is_here)) continue;
    add(Code("constant-force"), "N", mass).parameters.push_back([=](System& changed, double d) {
      add_force(changed, {mass, d, 0.0, 0.0});
    });
  }
  if (load == nullptr) return all;
  const auto& forces = load->forces();
  // More of some forces, and the same a quarter of a period later: as much later as the fastest.
  const auto add_parameters = [](FlightChange& one, std::vector<model::HarmonicForce> some) {
    one.frequency = std::ranges::max(some, {}, &model::HarmonicForce::frequency).frequency;
    one.parameters.push_back([=](System& changed, double d) {
      for (const auto& f : some) add_force(changed, {f.dof, d * f.amplitude, f.frequency, f.phase});
    });
    if (!(one.frequency > 0.0)) return;
    one.parameters.push_back([=, fastest = one.frequency](System& changed, double d) {
      for (const auto& f : some)
        if (f.frequency > 0.0)
          add_force(changed, {f.dof, d * f.amplitude * f.frequency / fastest, f.frequency,
                              f.phase - 0.5 * M_PI});
    });
  };
  for (const auto& force : forces)
    add_parameters(add(Code("load-differs"), "1", force.dof), {force});
  if (forces.size() > 1) {
    all.push_back({diagnosis_of(Code("load-differs"), NAN, "1"), {}, 0.0, true});
    add_parameters(all.back(), {forces.begin(), forces.end()});
  }
  return all;
}

Diagnosis diagnosis_by(const FlightChange& change, std::span<const double> values,
                       double uncertainty) {
  auto cause = change.cause;
  const double scale = cause.unit == "%" ? 100.0 : 1.0;
  cause.value = scale * values[0];
  if (cause.code == Code("mass-differs").name()) cause.value /= 1.0 - values[0];
  if (cause.code == Code("load-differs").name()) {
    // (1 + a) cos + b sin: amplitude and lateness.
    constexpr double noticeable_lag = 1e-4;  // [rad]
    const double lag = values.size() > 1 ? values[1] : 0.0;
    cause.value = std::hypot(1.0 + values[0], lag);
    const double late = std::atan2(lag, 1.0 + values[0]) / change.frequency;
    if (std::abs(lag) > noticeable_lag && cause.value > 0.1)
      cause.evidence.push_back({"time", late});
    if (cause.value < std::max(0.02, 3.0 * uncertainty)) cause.text = "missing";
  }
  cause.evidence.push_back({"uncertainty", scale * uncertainty});
  return cause;
}

}  // namespace clackers::diagnose
