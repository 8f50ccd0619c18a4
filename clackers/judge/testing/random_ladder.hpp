#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>
#include <random>
#include <string_view>
#include <vector>

#include "clackers/judge/testing/synthetic_ladder.hpp"

// Ladders with errors of a known order, drawn at random, for tests.
namespace clackers::judge::synthetic {

using Random = std::mt19937;

inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Uniform in its logarithm.
inline double scale(Random& random, double low, double high) {
  return std::exp(uniform(random, std::log(low), std::log(high)));
}

/// One of the values.
inline double any(Random& random, std::initializer_list<double> values) {
  return *(values.begin() + std::uniform_int_distribution<int>(0, int(values.size()) - 1)(random));
}

/// A ladder and the order that its errors have as the step goes to zero.
struct RandomLadder {
  std::vector<ErrorLevel> levels;
  double order = 0.0;
};

/// Draws a shape of 4 to 8 levels with one of these numbers of samples.
inline Shape any_shape(Random& random, std::initializer_list<double> samples) {
  return {.levels = std::uniform_int_distribution<int>(4, 8)(random),
          .samples = int(any(random, samples)),
          .coarsest = scale(random, 0.005, 0.05)};
}

inline double finest_of(const Shape& shape) {
  return shape.coarsest * std::exp2(-shape.levels + 1.0 / shape.samples);
}

/// a h^p with factors up to `scatter` either way: what is left of methods that locate impacts.
inline RandomLadder scattered_line(Random& random) {
  const double p = any(random, {1.0, 2.0, 3.0, 4.0}), factor = uniform(random, 1.02, 1.18);
  const auto shape = any_shape(random, {1, 2, 4, 8});
  return {ladder(
              [&](double h) {
                return 0.5 * std::pow(h / shape.coarsest, p) *
                       std::pow(factor, uniform(random, -1.0, 1.0));
              },
              shape),
          p};
}

/// A line with the bend of the next term, at most half as large at the coarsest step.
inline RandomLadder bent_line(Random& random) {
  const double p = any(random, {1.0, 2.0, 4.0}), next = any(random, {1.0, 2.0});
  const double share = uniform(random, -0.4, 0.5), factor = uniform(random, 1.0, 1.05);
  const auto shape = any_shape(random, {1, 2, 4, 8});
  return {ladder(
              [&](double h) {
                const double s = h / shape.coarsest;
                return 0.3 * std::pow(s, p) * (1.0 + share * std::pow(s, next)) *
                       std::pow(factor, uniform(random, -1.0, 1.0));
              },
              shape),
          p};
}

/// A line that meets the rounding of its number of steps.
inline RandomLadder line_to_rounding(Random& random) {
  const double p = any(random, {2.0, 4.0}), size = scale(random, 1e-8, 1e-3);
  const auto shape = any_shape(random, {2, 4, 8});
  return {ladder(
              [&](double h) {
                const double n = shape.end / h;
                return size * std::pow(h / shape.coarsest, p) *
                           std::pow(1.03, uniform(random, -1.0, 1.0)) +
                       n * 2.2e-16 * uniform(random, 0.1, 2.0);
              },
              shape),
          p};
}

/// A line that ends in noise.
inline RandomLadder line_to_noise(Random& random) {
  const double p = any(random, {1.0, 2.0, 4.0});
  const auto shape = any_shape(random, {2, 4, 8});
  const double bottom = finest_of(shape) / shape.coarsest;
  const double noise = 0.5 * std::pow(bottom * scale(random, 1.0, 4.0), p);
  return {ladder(
              [&](double h) {
                return 0.5 * std::pow(h / shape.coarsest, p) + noise * uniform(random, 0.3, 2.0);
              },
              shape),
          p};
}

/// a h + b h^2, the second term at most as large as the first at the finest steps.
inline RandomLadder blend(Random& random) {
  const auto shape = any_shape(random, {1, 2, 4, 8});
  const double ratio = scale(random, 0.01, 0.5) / finest_of(shape);
  const double factor = uniform(random, 1.0, 1.05), size = 0.9 / (1.0 + ratio * shape.coarsest);
  return {ladder(
              [&](double h) {
                return size * h / shape.coarsest * (1.0 + ratio * h) *
                       std::pow(factor, uniform(random, -1.0, 1.0));
              },
              shape),
          1.0};
}

/// Impacts noticed at the end of a step: a share of the step that varies from step to step.
inline RandomLadder late_impact_shares(Random& random, std::initializer_list<double> samples) {
  const auto shape = any_shape(random, samples);
  const double size = scale(random, 0.5, 5.0);
  std::vector<double> times;
  for (int i = 0; i < 5; ++i) times.push_back(uniform(random, 1.0, 20.0));
  return {ladder(
              [&](double h) {
                double sum = 0.0;
                for (const double t : times)
                  sum += std::sin(std::numbers::pi * (t / h - std::floor(t / h)));
                return size * h * std::abs(sum - 3.0) / 2.0 + 1e-3 * h;
              },
              shape),
          1.0};
}

/// A power of the step times |sin| of a phase that varies from step to step.
inline RandomLadder sine_shares(Random& random, std::initializer_list<double> samples) {
  const auto shape = any_shape(random, samples);
  const double p = any(random, {1.0, 2.0}), t = uniform(random, 5.0, 20.0);
  return {ladder(
              [&](double h) {
                return 0.5 * std::pow(h / shape.coarsest, p) *
                       std::abs(std::sin(std::numbers::pi * t / h));
              },
              shape),
          p};
}

/// A power of the step times a lognormal factor.
inline RandomLadder lognormal_shares(Random& random) {
  const auto shape = any_shape(random, {1, 2, 4, 8});
  const double p = any(random, {1.0, 2.0}), sigma = uniform(random, 0.4, 1.2);
  std::normal_distribution<double> normal(0.0, sigma);
  return {ladder(
              [&](double h) {
                return 0.01 * std::pow(h / shape.coarsest, p) * std::exp(normal(random));
              },
              shape),
          p};
}

/// One kind of ladders.
struct RandomKind {
  std::string_view name;
  std::function<RandomLadder(Random&)> draw;
};

/// For messages of tests.
inline void PrintTo(const RandomKind& kind, std::ostream* out) { *out << kind.name; }

inline std::vector<RandomKind> random_kinds() {
  return {{"scattered line", scattered_line},
          {"line with the bend of the next term", bent_line},
          {"line that meets rounding", line_to_rounding},
          {"line that ends in noise", line_to_noise},
          {"blend of orders one and two", blend},
          {"late impacts, 1 sample", [](Random& r) { return late_impact_shares(r, {1}); }},
          {"late impacts, 2 samples", [](Random& r) { return late_impact_shares(r, {2}); }},
          {"late impacts, 4 samples", [](Random& r) { return late_impact_shares(r, {4}); }},
          {"late impacts, 8 samples", [](Random& r) { return late_impact_shares(r, {8}); }},
          {"sine shares, 1 sample", [](Random& r) { return sine_shares(r, {1}); }},
          {"sine shares, 2 samples", [](Random& r) { return sine_shares(r, {2}); }},
          {"sine shares, 4 samples", [](Random& r) { return sine_shares(r, {4}); }},
          {"sine shares, 8 samples", [](Random& r) { return sine_shares(r, {8}); }},
          {"lognormal shares", lognormal_shares}};
}

}  // namespace clackers::judge::synthetic
