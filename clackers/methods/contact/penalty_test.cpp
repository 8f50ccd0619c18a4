#include "clackers/methods/contact/penalty.hpp"

#include "clackers/base/testing/refusal.hpp"
#include "clackers/methods/contact/compliant_force.hpp"
#include "clackers/methods/testing/runs.hpp"
#include "clackers/methods/testing/stepper_checks.hpp"
#include "clackers/model/nonlinear_springs.hpp"

namespace clackers::methods {
namespace {

using runs::mass_on_stop;
using runs::RattlingMass;
using runs::run;

// A mass on a spring whose stop at equilibrium is a spring itself: half periods of two damped
// oscillators in turn, with one decay rate. A contact lasts pi / wc.
struct SpringStop {
  double sigma = 0.05, w = 1.0, stiffness = 300.0, m = 2.0;
  double wc() const { return std::sqrt(w * w + stiffness / m); }
  double cycle() const { return std::numbers::pi * (1 / w + 1 / wc()); }
  double touch(int k) const { return 0.5 * std::numbers::pi / w + (k - 1) * cycle(); }
  double u(double t) const {
    double s = t + 0.5 * std::numbers::pi / w;  // since the flight that ends at touch 1 began
    s -= std::floor(s / cycle()) * cycle();
    const double e = w * std::exp(-sigma * t), rest = s - std::numbers::pi / w;
    return rest < 0 ? e * std::sin(w * s) / w : -e * std::sin(wc() * rest) / wc();
  }
  model::ImpactProblem<> problem() const {
    auto p =
        mass_on_stop(m, 2 * m * sigma, m * (w * w + sigma * sigma), std::exp(-sigma) * std::cos(w),
                     -std::exp(-sigma) * (sigma * std::cos(w) + w * std::sin(w)), 1.0, 11.0);
    p.start.t = 1.0;
    return p;
  }
};

TEST(Penalty, ConvergesToTheMotionWithSpringsAtTheOrderOfTheIntegrator) {
  const SpringStop reference;
  for (const std::string name : {"newmark", "central-difference", "generalized-alpha:rho=0.8"}) {
    std::vector<model::Impact> touches;
    const auto fit = checks::observed_order(
        [&](double h) {
          const auto [path, outcome] = run(name + "+penalty:stiffness=300", reference.problem(),
                                           10.0 / std::round(10.0 / h));
          EXPECT_TRUE(outcome.finished) << outcome.detail;
          touches = *path.impacts;
          double worst = 0.0;
          for (std::size_t i = 0; i < path.t.size(); ++i)
            worst = std::max(worst, std::abs(path.u[i] - reference.u(path.t[i])));
          return worst;
        },
        1.0 / 128, 6);
    EXPECT_NEAR(fit.order, 2.0, 0.2) << name << " scatter " << fit.scatter;
    ASSERT_EQ(touches.size(), 3u);
    for (std::size_t k = 0; k < touches.size(); ++k) {
      EXPECT_NEAR(touches[k].t, reference.touch(int(k) + 1), 1e-3);  // h^2 wc^2 T at h = 1/4096
      EXPECT_NEAR(touches[k].u[0], 0.0, 1e-12);
      EXPECT_EQ(touches[k].v_before, touches[k].v_after);
      EXPECT_EQ(touches[k].impulse, 0.0);
    }
  }
}

TEST(Penalty, RunsTwoMassesAndAnyNumberAlike) {
  model::ImpactProblem<> two, three;
  two.system.mass = Eigen::Vector2d(1.0, 0.5).asDiagonal();
  two.system.damping = 0.1 * two.system.mass;
  two.system.stiffness = Eigen::Vector2d(1.0, 4.5).asDiagonal();
  two.contacts = {{Eigen::Vector2d(1.0, -1.0), 0.0, 1.0}};
  two.start = {0.0, Eigen::Vector2d(1.0, -0.5), Eigen::Vector2d(0.0, 0.0)};
  two.end = three.end = 10.0;
  three.system.mass = three.system.damping = three.system.stiffness = Eigen::Matrix3d::Identity();
  three.system.mass.topLeftCorner(2, 2) = two.system.mass;
  three.system.damping.topLeftCorner(2, 2) = two.system.damping;
  three.system.stiffness.topLeftCorner(2, 2) = two.system.stiffness;
  three.contacts = {{Eigen::Vector3d(1.0, -1.0, 0.0), 0.0, 1.0}};
  three.start = {0.0, Eigen::Vector3d(1.0, -0.5, 0.0), Eigen::Vector3d::Zero()};
  const auto one = run("newmark+penalty", two, 0.001).trajectory;
  const auto other = run("newmark+penalty", three, 0.001).trajectory;
  EXPECT_EQ(one.impacts->size(), other.impacts->size());
  EXPECT_GE(one.impacts->size(), 3u);
  // Two solvers with rounding 2^-53 each, condition k h² = 0.01, 10^4 steps through four contacts.
  EXPECT_NEAR(one.u[one.u.size() - 2], other.u[other.u.size() - 3], 1e-10);
}

TEST(Penalty, HasTheContactTimeOfAHalfPeriod) {
  model::ImpactProblem<> p = RattlingMass{}.problem(10.0);  // m = 2, k = 2.005
  EXPECT_NEAR(method("newmark+penalty:stiffness=50")->contact_time(p),
              std::numbers::pi * std::sqrt(2.0 / 50), 1e-15);
  EXPECT_NEAR(method("newmark+penalty")->contact_time(p), std::numbers::pi * std::sqrt(2.0 / 20050),
              1e-15);
  p.contacts.push_back({Eigen::VectorXd::Constant(1, -2.0), -9.0, 1.0});  // m_e = m / 4
  EXPECT_NEAR(method("newmark+penalty:stiffness=50")->contact_time(p),
              std::numbers::pi * std::sqrt(0.5 / 50), 1e-15);
  p.contacts.clear();
  EXPECT_EQ(method("newmark+penalty")->contact_time(p), 0.0);
  EXPECT_EQ(method("newmark")->contact_time(p), 0.0);
}

TEST(Penalty, TakesItsDefaultStiffnessFromTheFirstMassInTheRow) {
  model::ImpactProblem<> p;
  p.system.mass = p.system.damping = Eigen::Matrix2d::Identity();
  p.system.stiffness = Eigen::Vector2d(3.0, 7.0).asDiagonal();
  p.contacts = {{Eigen::Vector2d(1.0, -1.0), 0.0, 1.0}, {Eigen::Vector2d(0.0, 1.0), -5.0, 1.0}};
  p.start = {0.0, Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d::Zero()};
  p.end = 1.0;
  EXPECT_EQ(Penalty{}.stiffnesses(p), (std::vector<double>{3e4, 7e4}));
  EXPECT_EQ(Penalty{.stiffness = 5.0}.stiffnesses(p), (std::vector<double>{5.0, 5.0}));
}

TEST(Penalty, TakesAStifferDefaultBesideAFastMass) {
  // Mass 2 alone swings at sqrt(160000) = 400 rad/s; both in contact have 1/200 of the unit mass.
  // pi sqrt((1/201) / k) = (2 pi / 400) / 40 for k = 400 * 160000 / 201.
  model::ImpactProblem<> p;
  p.system.mass = Eigen::Vector2d(1.0, 0.005).asDiagonal();
  p.system.stiffness = Eigen::Vector2d(1.0, 800.0).asDiagonal();
  p.system.damping = Eigen::Matrix2d::Zero();
  p.contacts = {{Eigen::Vector2d(1.0, -1.0), 0.0, 1.0}};
  EXPECT_NEAR(Penalty{}.stiffnesses(p).at(0), 64e6 / 201.0, 1e-8);
  EXPECT_NEAR(method("newmark+penalty")->contact_time(p), 2.0 * M_PI / 400.0 / 40.0, 1e-17);
}

TEST(Penalty, ElasticLawsStandForElasticImpactsOnly) {
  const auto p = RattlingMass{.eta = 0.5}.problem(10.0);
  for (const std::string law : {"linear", "hertz"}) {
    const auto chosen = method("newmark+penalty:law=" + law);
    const auto no = chosen->objection(p);
    ASSERT_TRUE(no);
    EXPECT_EQ(no->code, Code("penalty-needs-elastic"));
    EXPECT_EQ(no->sentence, chosen->facts().name + " with eta = 0.5: the law " + law +
                                " is elastic, so it models only eta = 1. Use "
                                "penalty:law=kelvin-voigt or event-driven.");
    EXPECT_REFUSED(chosen->prepare(p, 0.1), "penalty-needs-elastic", "with eta = 0.5");
  }
}

TEST(Penalty, LawsWithoutCoefficientsForARestitutionAreRefused) {
  const auto p = RattlingMass{.eta = 0.0}.problem(10.0);
  for (const std::string law : {"ye", "jankowski"})
    EXPECT_REFUSED(method("newmark+penalty:law=" + law)->prepare(p, 0.1), "law-needs-restitution",
                   "with eta = 0: the law " + law + " has infinite damping there");
  EXPECT_FALSE(method("newmark+penalty:law=hunt-crossley")->objection(p));
}

TEST(Penalty, ModelErrorFallsAsTheContactTime) {
  const auto order = [](const char* text) { return method(text)->facts().model_order; };
  EXPECT_EQ(order("newmark+penalty"), 0.5);
  EXPECT_EQ(order("newmark+penalty:law=kelvin-voigt"), 0.5);
  EXPECT_EQ(order("newmark+penalty:law=hertz"), 0.4);
  EXPECT_EQ(order("newmark+event-driven"), 0.0);
  EXPECT_EQ(order("moreau-jean"), 0.0);
}

TEST(Penalty, WrongLawsAreRefusedWithAGuess) {
  EXPECT_REFUSED(method("newmark+penalty:law=herz"), "unknown-name",
                 "no law of penalty \"herz\". Did you mean \"hertz\"?");
}

TEST(Penalty, AsksForAStiffnessWhereThereIsNoDefault) {
  const auto p = mass_on_stop(1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0);
  const auto no = method("rk4+penalty")->objection(p);
  ASSERT_TRUE(no);
  EXPECT_EQ(no->code, Code("no-default-stiffness"));
  EXPECT_FALSE(method("rk4+penalty:stiffness=3")->objection(p));
}

TEST(Penalty, SpringsOfAPendulumSetTheDefault) {
  // 5 kg on 2 m of string: m g/l of stiffness at its lowest point, and the height that the angle 1 stores.
  auto p = mass_on_stop(5.0, 0.0, 0.0, 2.0, 0.0, 1.0, 1.0);
  p.system.nonlinear =
      std::make_shared<model::NonlinearSprings>(std::vector<model::NonlinearSprings::Row>{
          {Eigen::VectorXd::Ones(1), model::NonlinearSprings::Law::sine, 5.0 * 9.81 / 2.0, 2.0}});
  auto linear = mass_on_stop(5.0, 0.0, 5.0 * 9.81 / 2.0, 0.0,
                             2.0 * std::sqrt(9.81 * (1.0 - std::cos(1.0))), 1.0, 1.0);
  for (const auto* name : {"newmark+penalty", "newmark+penalty:law=hertz"}) {
    EXPECT_FALSE(method(name)->objection(p)) << name;
    EXPECT_NEAR(method(name)->contact_time(p), method(name)->contact_time(linear),
                1e-13 * method(name)->contact_time(p))
        << name;
  }
}

TEST(Penalty, NonlinearLawsNeedEnergyAtTheStartForADefault) {
  const auto p = mass_on_stop(1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0);
  EXPECT_REFUSED(method("rk4+penalty:law=hertz")->prepare(p, 0.1), "no-default-stiffness",
                 "the problem starts without energy", "N/m^1.5");
  EXPECT_FALSE(method("rk4+penalty:law=hertz,stiffness=3")->objection(p));
  EXPECT_EQ(method("rk4+penalty:law=hertz,stiffness=3")->contact_time(p), 0.0);
}

TEST(Penalty, DefaultsOfAllLawsHaveOneContactTime) {
  const auto p = RattlingMass{.eta = 1.0}.problem(10.0);
  const double time = method("rk4+penalty")->contact_time(p);
  for (const auto& law : compliant_laws())
    EXPECT_NEAR(method("rk4+penalty:law=" + std::string(law.name))->contact_time(p), time,
                1e-13 * time)
        << law.name;
}

// A free mass that meets a stop with speed 1: rebound speed, largest penetration and contact time.
struct Rebound {
  double speed = 0.0, penetration = 0.0, time = 0.0;
};

Rebound rebound(const std::string& integrator, std::string_view law, double eta) {
  const double h = 2e-6;  // 1/1500 of the shortest contact
  auto p = mass_on_stop(0.5, 0.0, 0.0, 0.31 * h, -1.0, eta, 0.02);
  const auto [path, outcome] =
      run(integrator + "+penalty:stiffness=5e5,law=" + std::string(law), p, h);
  EXPECT_TRUE(outcome.finished) << outcome.detail;
  EXPECT_EQ(path.impacts->size(), 1u);
  EXPECT_NEAR(path.impacts->at(0).t, 0.31 * h, 1e-12);
  Rebound found{path.v.back(), 0.0, 0.0};
  for (std::size_t i = 0; i < path.t.size(); ++i) {
    found.penetration = std::max(found.penetration, -path.u[i]);
    if (path.u[i] < 0.0) found.time = path.t[i];
  }
  return found;
}

TEST(Penalty, ReboundsOfLawsAreThoseOfAnIndependentTrial) {
  struct Expected {
    std::string_view law;
    double speeds[4];
  };
  constexpr double nominal[] = {0.9, 0.7, 0.5, 0.3};
  constexpr Expected all[] = {{"kelvin-voigt", {0.900, 0.700, 0.500, 0.300}},
                              {"kelvin-voigt-no-tension", {0.902, 0.718, 0.550, 0.397}},
                              {"hunt-crossley", {0.909, 0.768, 0.663, 0.581}},
                              {"lankarani-nikravesh", {0.913, 0.796, 0.725, 0.684}},
                              {"ye", {0.894, 0.683, 0.470, 0.256}},
                              {"jankowski", {0.900, 0.698, 0.495, 0.292}}};
  std::size_t laws = 0;
  for (const auto& law : compliant_laws()) laws += law.models(0.5);
  EXPECT_EQ(std::size(all), laws);
  for (const auto& [law, speeds] : all)
    for (std::size_t i = 0; i < 4; ++i)
      for (const std::string integrator : {"newmark", "central-difference"})
        EXPECT_NEAR(rebound(integrator, law, nominal[i]).speed, speeds[i], 6e-4)
            << law << " eta " << nominal[i] << ' ' << integrator;
}

TEST(Penalty, ElasticLawsReboundWithTheApproachSpeedAfterTheirContactTime) {
  for (const auto& law : compliant_laws()) {
    const auto found = rebound("newmark", law.name, 1.0);
    const double n = law.exponent, peak = std::pow(0.25 * (n + 1) / 5e5, 1 / (n + 1));
    EXPECT_NEAR(found.speed, 1.0, 1e-6) << law.name;
    EXPECT_NEAR(found.penetration, peak, 1e-6 * peak) << law.name;
    EXPECT_NEAR(found.time, law.contact_time(5e5, 0.5, 1.0), 4e-6) << law.name;  // rows 2e-6 apart
  }
}

TEST(Penalty, AContactThatIsPressedStaysClosedAndCarriesTheLoad) {
  for (const auto& law : compliant_laws()) {
    const double eta = law.models(0.5) ? 0.5 : 1.0;
    auto p = mass_on_stop(1.0, 2.0, 1.0, 0.0, 0.0, eta, 40.0);
    p.system.add_load = [](double, std::span<double> f) { f[0] -= 3.0; };
    const auto [path, outcome] =
        run("newmark+penalty:stiffness=100,law=" + std::string(law.name), p, 0.01);
    ASSERT_TRUE(outcome.finished) << outcome.detail;
    // At rest k d^n + K d = 3.
    const double d = -path.u.back();
    EXPECT_NEAR(100.0 * std::pow(d, law.exponent) + d, 3.0, 1e-9) << law.name;
    EXPECT_EQ(path.impacts->size(), 1u) << law.name;
  }
}

// Unloaded, the contact decays until it is lost in subnormal numbers.
TEST(Penalty, AContactThatDecaysToNothingEndsNoRun) {
  for (const std::string integrator : {"newmark", "central-difference"})
    for (const double h : {0.01, 0.005, 0.001}) {
      const auto [path, outcome] = run(integrator + "+penalty:law=kelvin-voigt",
                                       mass_on_stop(1.0, 0.1, 1.0, 1.0, 0.0, 0.0, 20.0), h);
      EXPECT_TRUE(outcome.finished) << integrator << " h " << h << ": " << outcome.detail;
      EXPECT_LT(std::abs(path.u.back()), 1e-300) << integrator << " h " << h;
    }
}

TEST(Penalty, TheLastShorterStepHasItsContactForce) {
  // The run is no multiple of the step, and its last one closes the contact.
  auto p = mass_on_stop(1.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.0105);
  p.start.u[0] = 0.0101;
  const auto path = run("newmark+penalty:stiffness=1e8", p, 0.001).trajectory;
  EXPECT_EQ(path.impacts->size(), 1u);
  EXPECT_GT(path.v.back(), -0.9);
}

TEST(CompliantForce, OfClosedContactsAddsToAForceThatIsThereAlready) {
  auto p = RattlingMass{}.problem(10.0);
  p.system.nonlinear = std::make_shared<checks::CubicForce<model::any_dof>>();
  CompliantForce<model::any_dof> force(compliant_law("linear"), p, std::vector{100.0});
  const Eigen::VectorXd u = Eigen::VectorXd::Constant(1, -0.5), v = Eigen::VectorXd::Zero(1);
  const auto total = [&] {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(1);
    force.add(u, v, sum);
    return sum[0];
  };
  EXPECT_NEAR(total(), -0.125, 1e-14);
  force.close(0, 1.0);
  EXPECT_TRUE(force.is_closed(0));
  EXPECT_NEAR(total(), -50.0 - 0.125, 1e-14);
  Eigen::MatrixXd du = Eigen::MatrixXd::Zero(1, 1), dv = du;
  force.add_tangent(u, v, du, dv);
  EXPECT_NEAR(du(0, 0), 100.0 + 0.75, 1e-13);
  force.open_all();
  EXPECT_NEAR(total(), -0.125, 1e-14);
}

}  // namespace
}  // namespace clackers::methods
