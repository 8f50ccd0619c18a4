#include "clackers/measure/errors/state_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "clackers/model/nonlinear_springs.hpp"
#include "clackers/numerics/testing/forced_target.hpp"

namespace clackers::measure {
namespace {

using numerics::simd::ForcedTarget;

struct Rows {
  std::vector<double> u, v, u_reference, v_reference;

  Rows(std::size_t dof, std::size_t count) {
    std::mt19937_64 random(dof * 1000 + count);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (auto* part : {&u, &v, &u_reference, &v_reference})
      for (std::size_t i = 0; i < dof * count; ++i) part->push_back(uniform(random));
  }
};

// Coupled masses and springs, with entries that are 0.
model::SmoothSystem<> system_of(Eigen::Index dof) {
  model::SmoothSystem<> system;
  system.mass = Eigen::VectorXd::LinSpaced(dof, 1.0, 2.5).asDiagonal();
  system.stiffness = 3.0 * Eigen::MatrixXd::Identity(dof, dof);
  for (Eigen::Index i = 1; i < dof; ++i)
    system.stiffness(i, i - 1) = system.stiffness(i - 1, i) = -0.7;
  system.damping = 0.0 * system.stiffness;
  return system;
}

// All that is measured, in one list.
std::vector<double> measured(std::size_t dof, std::size_t count, bool has_v = true) {
  const Rows rows(dof, count);
  StateErrors errors(dof, system_of(Eigen::Index(dof)));
  // In two parts, so that totals go on.
  const std::size_t first = (count + 1) / 2, at = first * dof;
  errors.take(first, rows.u.data(), has_v ? rows.v.data() : nullptr, rows.u_reference.data(),
              rows.v_reference.data());
  if (count > first)
    errors.take(count - first, &rows.u[at], has_v ? &rows.v[at] : nullptr, &rows.u_reference[at],
                &rows.v_reference[at]);
  auto all = errors.u();
  all.insert(all.end(), {errors.energy(), has_v ? errors.energy_ratio() : 0.0});
  const std::size_t last = count > first ? count - first : first;
  for (std::size_t j = 0; has_v && j < dof; ++j)
    all.insert(all.end(), errors.v(j), errors.v(j) + last);
  return all;
}

TEST(StateErrors, AreTheLargestOfAllStates) {
  for (const std::size_t dof : {std::size_t{1}, std::size_t{2}, std::size_t{5}})
    for (std::size_t count = 1; count < 40; ++count) {
      SCOPED_TRACE(testing::Message() << dof << " masses, " << count << " states");
      const Rows rows(dof, count);
      const auto system = system_of(Eigen::Index(dof));
      const auto vector = [&](const std::vector<double>& all, std::size_t i) -> Eigen::VectorXd {
        return Eigen::Map<const Eigen::VectorXd>(&all[i * dof], Eigen::Index(dof));
      };
      const auto energy = [&](const Eigen::VectorXd& u, const Eigen::VectorXd& v) {
        return 0.5 * (v.dot(system.mass * v) + u.dot(system.stiffness * u));
      };
      Eigen::VectorXd u = Eigen::VectorXd::Zero(Eigen::Index(dof));
      double largest = 0.0, ratio = 0.0;
      std::vector<Eigen::VectorXd> v;
      for (std::size_t i = 0; i < count; ++i) {
        u = u.cwiseMax((vector(rows.u, i) - vector(rows.u_reference, i)).cwiseAbs());
        v.emplace_back((vector(rows.v, i) - vector(rows.v_reference, i)).cwiseAbs());
        const double found = energy(vector(rows.u, i), vector(rows.v, i)),
                     expected = energy(vector(rows.u_reference, i), vector(rows.v_reference, i));
        largest = std::max(largest, std::abs(found - expected));
        ratio = found / expected;
      }
      const auto all = measured(dof, count);
      for (std::size_t j = 0; j < dof; ++j) EXPECT_EQ(all[j], u[Eigen::Index(j)]);
      EXPECT_NEAR(all[dof], largest, 1e-14 * largest);
      EXPECT_NEAR(all[dof + 1], ratio, 1e-14 * ratio);
      const std::size_t last = (all.size() - dof - 2) / dof;
      for (std::size_t j = 0; j < dof; ++j)
        for (std::size_t i = 0; i < last; ++i)
          EXPECT_EQ(all[dof + 2 + j * last + i], v[count - last + i][Eigen::Index(j)]);
      const auto u_alone = measured(dof, count, false);
      EXPECT_TRUE(std::equal(all.begin(), all.begin() + long(dof), u_alone.begin()));
      EXPECT_EQ(u_alone[dof], 0.0);
    }
}

TEST(StateErrors, TakeInWhatANonlinearSpringStores) {
  constexpr std::size_t count = 21;
  const Rows rows(2, count);
  auto system = system_of(2);
  system.nonlinear =
      std::make_shared<model::NonlinearSprings>(std::vector<model::NonlinearSprings::Row>{
          {Eigen::Vector2d(1.0, -1.0), model::NonlinearSprings::Law::cubic, 3.0}});
  const auto energy = [&](const std::vector<double>& u, const std::vector<double>& v,
                          std::size_t i) {
    const Eigen::Vector2d x(u[2 * i], u[2 * i + 1]), y(v[2 * i], v[2 * i + 1]);
    return 0.5 * (y.dot(system.mass * y) + x.dot(system.stiffness * x)) +
           0.75 * std::pow(x[0] - x[1], 4);
  };
  double largest = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    largest = std::max(largest, std::abs(energy(rows.u, rows.v, i) -
                                         energy(rows.u_reference, rows.v_reference, i)));
  StateErrors errors(2, system);
  errors.take(count, rows.u.data(), rows.v.data(), rows.u_reference.data(),
              rows.v_reference.data());
  EXPECT_NEAR(errors.energy(), largest, 1e-14 * largest);
  const double last = energy(rows.u, rows.v, count - 1),
               expected = energy(rows.u_reference, rows.v_reference, count - 1);
  EXPECT_NEAR(errors.energy_ratio(), last / expected, 1e-14 * last / expected);
}

TEST(StateErrors, HaveTheSameBitsInVectorsOfAllLengths) {
  for (const std::size_t dof : {std::size_t{1}, std::size_t{2}, std::size_t{5}})
    for (const std::size_t count : {std::size_t{3}, std::size_t{64}, std::size_t{261}}) {
      const auto known = measured(dof, count);
      for (const auto& target : numerics::simd::available_targets()) {
        const ForcedTarget forced(target);
        EXPECT_EQ(measured(dof, count), known) << target.name() << ' ' << dof << ' ' << count;
      }
    }
}

TEST(StateErrors, AreNotFiniteWhereOneNumberIsNot) {
  for (const std::size_t dof : {std::size_t{1}, std::size_t{2}, std::size_t{3}})
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
      for (std::size_t at = 0; at < 11 * dof; ++at)
        for (const bool in_u : {true, false}) {
          Rows rows(dof, 11);
          (in_u ? rows.u : rows.v)[at] = bad;
          StateErrors errors(dof, system_of(Eigen::Index(dof)));
          EXPECT_TRUE(errors.is_finite());
          errors.take(11, rows.u.data(), rows.v.data(), rows.u_reference.data(),
                      rows.v_reference.data());
          EXPECT_FALSE(errors.is_finite()) << at;
        }
}

TEST(Trapezoids, AreThoseOfEachInterval) {
  for (std::size_t count = 0; count < 40; ++count) {
    const Rows rows(1, count + 9);
    auto half = rows.u;
    std::fill(half.begin() + long(count), half.end(), 0.0);
    double sums[2] = {1.0, 2.0}, expected[2] = {1.0, 2.0};
    add_trapezoids(count, half.data(), rows.v.data(), sums);
    for (std::size_t i = 0; i < count; ++i) {
      const double left = rows.v[i], right = rows.v[i + 1];
      expected[0] += half[i] * (left + right);
      expected[1] += half[i] * (left * left + right * right);
    }
    EXPECT_NEAR(sums[0], expected[0], 1e-14);
    EXPECT_NEAR(sums[1], expected[1], 1e-14);
    for (const auto& target : numerics::simd::available_targets()) {
      const ForcedTarget forced(target);
      double others[2] = {1.0, 2.0};
      add_trapezoids(count, half.data(), rows.v.data(), others);
      EXPECT_EQ(others[0], sums[0]) << target.name();
      EXPECT_EQ(others[1], sums[1]) << target.name();
    }
  }
}

}  // namespace
}  // namespace clackers::measure
