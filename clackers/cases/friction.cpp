#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numbers>

#include "clackers/base/check.hpp"
#include "clackers/cases/row.hpp"
#include "clackers/exact/friction/friction_motion.hpp"
#include "clackers/exact/friction/oblique_disk.hpp"

// Dry friction: docs/manual/explanation/derivations/friction.md.
namespace clackers::cases {
namespace {

void use(Case& test_case, std::shared_ptr<const exact::FrictionMotion> motion) {
  test_case.problem = motion->problem();
  const auto& system = test_case.problem.system;
  const double omega = std::sqrt(system.stiffness(0, 0) / system.mass(0, 0));
  test_case.damped_periods = {2.0 * std::numbers::pi / omega};
  auto& list = test_case.constants;
  list.insert(list.begin(), {"omega", omega, "rad/s", "frequency without friction"});
  list.push_back({"error_bound", motion->error_bound(motion->end()).u[0], "m",
                  "of the displacement of the reference solution at t_end"});
  list.push_back({"t_end", motion->end(), "s", "end of the run"});
  list.push_back({"impacts", 0.0, "", "nothing collides"});
  test_case.motion = std::move(motion);
}

void build_slider(Case& test_case, const Values& value, double) {
  const auto& who = test_case.entry->name;
  const exact::SliderParameters p{within(test_case, value, "m"), within(test_case, value, "k"),
                                  within(test_case, value, "F"), within(test_case, value, "x0"),
                                  end_of(test_case, value)};
  const auto motion = std::make_shared<const exact::Slider>(p, who);
  test_case.constants = {
      {"d", p.F / p.k, "m", "F/k, within which it may rest; each half swing is less wide by 2 d"},
      {"half_swings", motion->half_swings(), "", "before it rests for ever"},
      {"t_rest", motion->end_of_slip().nearest(), "s", "from then on it rests"},
      {"u_rest", motion->rest().nearest(), "m", "where it rests"},
      {"lost", motion->lost(), "J", "to friction, until it rests"}};
  use(test_case, motion);
}

void build_belt(Case& test_case, const Values& value, double) {
  const auto& who = test_case.entry->name;
  const exact::BeltParameters p{within(test_case, value, "m"),  within(test_case, value, "k"),
                                within(test_case, value, "Fs"), within(test_case, value, "Fd", 0.0),
                                within(test_case, value, "V"),  end_of(test_case, value)};
  const auto motion = std::make_shared<const exact::Belt>(p, who);
  const double stick = motion->stick().nearest(), slip = motion->slip().nearest();
  test_case.constants = {{"T_stick", stick, "s", "it moves with the belt"},
                         {"T_slip", slip, "s", "it slides back"},
                         {"T", stick + slip, "s", "period"},
                         {"u_slip", p.limit / p.k, "m", "where sliding begins"},
                         {"u_stick", (2.0 * p.kinetic - p.limit) / p.k, "m", "where it ends"}};
  use(test_case, motion);
}

void build_forced_slider(Case& test_case, const Values& value, double) {
  const auto& who = test_case.entry->name;
  const exact::ForcedSliderParameters p{
      within(test_case, value, "m"), within(test_case, value, "k"), within(test_case, value, "F"),
      within(test_case, value, "P"), within(test_case, value, "W"), end_of(test_case, value)};
  const auto motion = std::make_shared<const exact::ForcedSlider>(p, who);
  test_case.constants = {
      {"amplitude", motion->amplitude(), "m", "at the turning points, every pi/W"},
      {"phi", motion->phase(), "rad", "phase of the force at a turning point"},
      {"work", 4.0 * p.F * motion->amplitude(), "J", "of the force in a period, lost to friction"}};
  use(test_case, motion);
  test_case.damped_periods[0] = std::min(test_case.damped_periods[0], 2.0 * std::numbers::pi / p.W);
}

void build_disk(Case& test_case, const Values& value, double) {
  exact::ObliqueDiskParameters p;
  p.height.h0 = within(test_case, value, "h0", 0.0);
  p.height.v0 = within(test_case, value, "v0", -1e30);
  p.vx0 = within(test_case, value, "vx0", -1e30);
  p.w0 = within(test_case, value, "w0", -1e30);
  p.height.g = within(test_case, value, "g");
  p.height.eta = value("eta");
  p.mu = within(test_case, value, "mu", 0.0);
  p.beta = within(test_case, value, "beta");
  p.height.end = end_of(test_case, value);
  const auto motion = std::make_shared<const exact::ObliqueDisk>(p, test_case.entry->name);
  test_case.problem = motion->problem();
  test_case.motion = motion;
  test_case.plane = 0.0;
  test_case.damped_periods.assign(3, 2.0 * motion->speed() / p.height.g);
  const double end = motion->end();
  test_case.constants = {
      {"m", 1.0, "kg", "the mass, of no influence"},
      {"V", motion->speed(), "m/s", "speed before the first impact; V eta^j after the j-th"},
      {"t_rest", motion->rest().nearest(), "s",
       "the impacts accumulate here, and the contact stays closed"},
      {"slides", motion->slides(), "", "impacts through which it slides"},
      {"t_roll", motion->rolls(), "s", "from then on it rolls"},
      {"v_roll", motion->rolling_speed(), "m/s", "along the floor, when it rolls"},
      {"error_bound", motion->error_bound(end).u.maxCoeff(), "m",
       "of the displacements of the reference solution at t_end"}};
  add_run(test_case);
}

}  // namespace

std::vector<CaseRow> friction_rows() {
  const auto m = positive("m", 1.0, "kg", "mass"), k = positive("k", 1.0, "N/m", "stiffness");
  const auto speed = [](const char* name, double standard, const char* meaning) {
    return Parameter{name, standard, "m/s", fmt::format("-1e+30 <= {} <= 1e+30", name), meaning};
  };
  return {
      {{"slider",
        "A mass on a spring and a rough floor: some half swings under dry friction, then rest.",
        "none; m u'' + k u = -F sgn u' (C. A. Coulomb, 1785)",
        {m, k, positive("F", 0.09375, "N", "force of friction, F < k x0"),
         positive("x0", 1.0, "m", "initial displacement, at rest"), t_end(20.0)}},
       build_slider},
      {{"belt",
        "A mass on a spring that a rough belt drags along: stick and slip without end.",
        "none; static friction Fs, kinetic friction Fd",
        {m,
         k,
         positive("Fs", 1.0, "N", "static friction, Fs > Fd"),
         {"Fd", 0.5, "N", "0 <= Fd < Fs", "kinetic friction"},
         positive("V", 0.25, "m/s", "velocity of the belt"),
         t_end(40.0)}},
       build_belt},
      {{"forced-slider",
        "A mass on a spring under dry friction and a harmonic force: the periodic motion without stops.",
        "none; J. P. den Hartog (1931)",
        {m, k, positive("F", 0.4, "N", "force of friction"),
         positive("P", 1.0, "N", "amplitude of the force P cos(W t + phi)"),
         positive("W", 0.8, "rad/s", "its frequency"), t_end(40.0)}},
       build_forced_slider},
      {{"oblique-disk",
        "A turning disk or ball thrown on a rough floor: infinitely many impacts with friction, then it rolls.",
        "none; u1 along the floor, u2 the height, u3 = R times the angle; friction is no row of the problem, so that "
        "methods refuse it: for check and verify --exec",
        {{"h0", 1.0, "m", "0 <= h0 <= 1e+30", "initial height"},
         speed("v0", 0.0, "initial velocity, upwards"),
         speed("vx0", 4.0, "initial velocity along the floor"),
         speed("w0", 2.0, "R times the initial velocity of rotation; it slides with vx0 + w0"),
         positive("g", 9.81, "m/s^2", "gravity"),
         {"eta", 0.8, "", "0 <= eta <= 0.9995", "restitution"},
         {"mu", 0.1, "", "0 <= mu <= 1e+30", "coefficient of friction"},
         positive("beta", 0.5, "", "moment of inertia over m R^2: disk 1/2, ball 2/5"),
         t_end(5.0)}},
       build_disk},
  };
}

}  // namespace clackers::cases
