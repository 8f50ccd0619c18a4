#include "clackers/exact/flights/event_driven_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clackers/base/error.hpp"
#include "clackers/numerics/linear_algebra.hpp"
#include "clackers/numerics/modal_form.hpp"

namespace clackers::exact {

using Eigen::Index;
using Eigen::VectorXd;
using numerics::FirstRoot;
using numerics::ModalSystem;

namespace {

constexpr const char* event_driven_name = "event-driven motion";
constexpr int most_root_steps = 100000;
/// Gaps and rates below this share of their sizes are those of a contact without speed.
constexpr double rounding_share = 1e-12;

std::span<double> entries(VectorXd& x) { return {x.data(), std::size_t(x.size())}; }

}  // namespace

/// Goes from impact to impact.
class EventDrivenMotion::Builder {
 public:
  Builder(const model::ImpactProblem<>& problem, const ImpactLaw& law, EventDrivenMotion& motion)
      : problem_(problem), law_(law), motion_(motion), t_(problem.start.t) {}

  bool build(int most_impacts) {
    const auto& system = problem_.system;
    if (system.add_load || system.nonlinear) return false;
    if (!add_system(system.damping)) return false;
    if (law_.damping_after_impact != 1.0 && !add_system(law_.damping_after_impact * system.damping))
      return false;
    prepare_contacts();
    u_ = problem_.start.u;
    v_ = problem_.start.v;
    begin_flight();
    for (const auto& contact : contacts_)
      if (gap(contact) < -rounding_share * size(contact).gap) return false;
    while (const auto hit = next_contact()) {
      // Passing through and coming back starts flights without an impact.
      if (undecided_ || std::ssize(motion_.flights_) > most_impacts) return false;
      move_to(hit->t);
      if (!collide(*hit) || undecided_) break;
      begin_flight();
      if (at_rest()) break;
    }
    return !undecided_;
  }

 private:
  struct Row {
    const model::Contact<>* law = nullptr;
    int index = 0;
    double inverse_effective_mass = 0.0;     // b' M^-1 b [1/kg]
    VectorXd response;                       // M^-1 b
    std::vector<numerics::ModalForm> forms;  // of the gap, of each system
    bool inside = false;                     // passed through, not yet back
  };
  struct Hit {
    double t = 0.0;
    Row* row = nullptr;
  };

  bool add_system(const Eigen::MatrixXd& damping) {
    auto system = ModalSystem::make(problem_.system.mass, damping, problem_.system.stiffness);
    if (!system) return false;
    motion_.systems_.push_back(std::move(*system));
    return true;
  }
  void prepare_contacts() {
    const auto inverse_mass = numerics::inverse(problem_.system.mass);
    for (const auto& contact : problem_.contacts) {
      Row row;
      row.law = &contact;
      row.index = int(contacts_.size());
      row.response = inverse_mass * contact.direction;
      row.inverse_effective_mass = contact.direction.dot(row.response);
      const std::span<const double> b{contact.direction.data(),
                                      std::size_t(contact.direction.size())};
      for (const auto& system : motion_.systems_)
        row.forms.emplace_back(system, b, std::span<const double>(), -contact.gap);
      contacts_.push_back(std::move(row));
    }
  }
  std::size_t form_index() const {
    return motion_.systems_.size() > 1 && !motion_.impacts_.empty() ? 1 : 0;
  }
  const ModalSystem& system() const { return motion_.systems_[form_index()]; }
  std::span<const numerics::ModalState> modal_state() const {
    return std::span(motion_.states_).last(std::size_t(motion_.dof_));
  }
  double gap(const Row& row) const { return row.law->gap_at(u_); }
  double rate(const Row& row) const { return row.law->gap_rate(v_); }
  // Amplitudes of the gap and of its rate in the present flight.
  struct Size {
    double gap = 0.0, rate = 0.0;
  };
  Size size(const Row& row) const {
    const auto& form = row.forms[form_index()];
    return {std::abs(row.law->gap) + form.amplitude(system(), modal_state(), 0.0),
            form.derivative_bound(system(), modal_state(), 1)};
  }
  // A plastic impact at equilibrium leaves nothing but rounding of the speed before it.
  bool at_rest() const {
    return v_.cwiseAbs().maxCoeff() <= rounding_share * speed_ &&
           u_.cwiseAbs().maxCoeff() * system().fastest() <= rounding_share * speed_;
  }

  void begin_flight() {
    motion_.flights_.push_back({t_, form_index() == 1});
    motion_.states_.resize(motion_.states_.size() + std::size_t(motion_.dof_));
    system().to_modes(entries(u_), entries(v_),
                      std::span(motion_.states_).last(std::size_t(motion_.dof_)));
  }
  void move_to(double t) {
    system().sample(modal_state(), t - motion_.flights_.back().t, entries(u_), entries(v_));
    t_ = t;
  }

  FirstRoot crossing(const Row& row, double sign, double span) {
    ahead_.begin(system(), row.forms[form_index()], modal_state(), sign);
    const double shortest =
        1e-6 / std::max({system().fastest(), 1e-3 / span, std::numeric_limits<double>::min()});
    return numerics::first_root(ahead_, 0.0, span, shortest, most_root_steps);
  }

  std::optional<Hit> next_contact() {
    const double span = motion_.until_ - t_;
    if (!(span > 0.0)) return std::nullopt;
    std::optional<Hit> first;
    for (auto& row : contacts_) {
      if (!row.inside && rests(row)) {
        undecided_ = true;
        continue;
      }
      const auto root = crossing(row, row.inside ? -1.0 : 1.0, span);
      if (root.status == FirstRoot::Status::undecided) undecided_ = true;
      if (root.status == FirstRoot::Status::found && (!first || t_ + root.s < first->t))
        first = Hit{t_ + root.s, &row};
    }
    return first;
  }
  // Touches without speed.
  bool rests(const Row& row) const {
    const auto whole = size(row);
    return gap(row) <= rounding_share * whole.gap && rate(row) <= rounding_share * whole.rate;
  }

  // What happens at a crossing; false where the simulation ends before it happens.
  bool collide(const Hit& hit) {
    Row& row = *hit.row;
    speed_ = v_.cwiseAbs().maxCoeff();
    if (row.inside) {
      row.inside = false;
      return true;
    }
    if (law_.grid > 0.0 && !wait_for_grid()) return false;
    if (!(rate(row) < 0.0)) {
      undecided_ = law_.grid == 0.0;
      row.inside = gap(row) < 0.0;
      return true;
    }
    const int count = int(motion_.impacts_.size()) + 1;
    double impulse = -(1.0 + row.law->restitution) * rate(row) / row.inverse_effective_mass;
    if (count == law_.missed) impulse = 0.0;
    if (count == law_.doubled) impulse *= 2.0;
    for (Index i = 0; i < v_.size(); ++i)
      v_[i] += impulse * row.response[i] *
               (law_.impulse_factor.empty() ? 1.0 : law_.impulse_factor[std::size_t(i)]);
    motion_.impacts_.push_back({t_, row.index, impulse});
    row.inside = rate(row) < 0.0 || (law_.grid > 0.0 && gap(row) < 0.0);
    return true;
  }

  // Moves on to the grid; false where it has no time left for an impact.
  bool wait_for_grid() {
    const double start = problem_.start.t;
    // A contact within a rounding of a grid time acts there.
    const double next = start + law_.grid * std::ceil((t_ - start) / law_.grid - 1e-9);
    if (next > motion_.until_) return false;
    if (next > t_) move_to(next);
    return true;
  }

  const model::ImpactProblem<>& problem_;
  const ImpactLaw& law_;
  EventDrivenMotion& motion_;
  std::vector<Row> contacts_;
  double t_ = 0.0;
  VectorXd u_, v_;
  numerics::FormAhead ahead_;
  double speed_ = 0.0;  // before the last crossing
  bool undecided_ = false;
};

std::optional<EventDrivenMotion> EventDrivenMotion::make(const model::ImpactProblem<>& problem,
                                                         const ImpactLaw& law, double until,
                                                         int most_impacts) {
  EventDrivenMotion motion;
  motion.dof_ = int(problem.dof());
  motion.until_ = until;
  if (!Builder(problem, law, motion).build(most_impacts)) return std::nullopt;
  return motion;
}

void EventDrivenMotion::sample(std::span<const double> times, std::span<double> u,
                               std::span<double> v) const {
  const auto n = std::size_t(dof_);
  std::size_t flight = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double t = times[i];
    if (!(t >= start() && t <= until_))
      refuse(event_driven_name, "t", t, "within the simulated time");
    if (t < flights_[flight].t) flight = 0;
    if (flight + 1 < flights_.size() && flights_[flight + 1].t <= t) {
      const auto after = std::upper_bound(flights_.begin() + std::ptrdiff_t(flight), flights_.end(),
                                          t, [](double x, const Flight& f) { return x < f.t; });
      flight = std::size_t(after - flights_.begin()) - 1;
    }
    systems_[flights_[flight].after_impact ? 1 : 0].sample(
        std::span(states_).subspan(flight * n, n), t - flights_[flight].t, u.subspan(i * n, n),
        v.empty() ? v : v.subspan(i * n, n));
  }
}

}  // namespace clackers::exact
