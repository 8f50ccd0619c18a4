#include "clackers/methods/testing/stepper_checks.hpp"

namespace clackers::methods {
namespace {

// The same step written on the first-order system, with and without a load: two paths of the code.
TEST(Rk4, IsTheTableOfKuttaOnTheFirstOrderSystem) {
  checks::Ramps<2> problem(2, 0.3);
  for (const bool is_loaded : {true, false}) {
    if (!is_loaded) problem.system.add_load = nullptr;
    const auto& s = problem.system;
    using Pair = std::pair<Eigen::Vector2d, Eigen::Vector2d>;
    const auto slope = [&](double t, const Eigen::Vector2d& u, const Eigen::Vector2d& v) -> Pair {
      Eigen::Vector2d f = Eigen::Vector2d::Zero();
      if (is_loaded) s.add_load(t, {f.data(), 2});
      return {v, s.mass.inverse() * (f - s.damping * v - s.stiffness * u)};
    };
    const double h = 0.3;
    const auto x = problem.exact(1.0);
    const auto k1 = slope(1.0, x.u, x.v);
    const auto k2 = slope(1.0 + h / 2, x.u + h / 2 * k1.first, x.v + h / 2 * k1.second);
    const auto k3 = slope(1.0 + h / 2, x.u + h / 2 * k2.first, x.v + h / 2 * k2.second);
    const auto k4 = slope(1.0 + h, x.u + h * k3.first, x.v + h * k3.second);
    auto now = x;
    checks::SingleSteps<2> stepper("rk4", s, h, now);
    stepper.step(now);
    EXPECT_LT((now.u - x.u - h / 6 * (k1.first + 2 * k2.first + 2 * k3.first + k4.first)).norm(),
              1e-14);
    EXPECT_LT(
        (now.v - x.v - h / 6 * (k1.second + 2 * k2.second + 2 * k3.second + k4.second)).norm(),
        1e-14);
    model::Work work;
    stepper->add_work(work);
    EXPECT_EQ(work.force_evaluations, 4);
  }
}

}  // namespace
}  // namespace clackers::methods
