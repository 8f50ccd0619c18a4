#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "clackers/numerics/double_double.hpp"
#include "clackers/numerics/triple_double.hpp"

namespace clackers::exact {

/// One mass of a motion u = b E cos(p theta), with theta = Omega t - k pi in [-pi/2, pi/2),
/// E = eta^k exp(-sigma t) and k the impacts so far. Per unit of E:
///     u = b C,   v = v_cos C + v_sin S,   a = a_cos C + a_sin S,   C, S = cos, sin(p theta).
struct MassConstants {
  double multiple = 1.0;         ///< p = damped frequency / Omega, odd
  numerics::DoubleDouble b;      ///< u(0) [m]
  numerics::DoubleDouble v_cos;  ///< -b sigma
  numerics::DoubleDouble v_sin;  ///< -b p Omega
  numerics::DoubleDouble a_cos;  ///< b (sigma^2 - p^2 Omega^2)
  numerics::DoubleDouble a_sin;  ///< 2 b sigma p Omega
  numerics::DoubleDouble v_hit;  ///< velocity before an impact: -b p Omega sin(p pi/2)
  numerics::DoubleDouble a_hit;  ///< acceleration there: -2 sigma v_hit
  double u_envelope = 0.0;       ///< |b|
  double v_envelope = 0.0;       ///< |b| omega, omega^2 = p^2 Omega^2 + sigma^2
  double a_envelope = 0.0;       ///< |b| omega^2
};

/// All that evaluating a motion needs, each constant to its full length.
struct FlightConstants {
  std::vector<MassConstants> masses;  ///< one or two
  bool collides = true;               ///< false: the free mass
  double eta = 1.0;
  double end = 0.0;                     ///< [s]
  double first_impact = 0.5;            ///< t_1 / T: 1/2, or 1 for a start just after an impact
  numerics::TripleDouble turns;         ///< Omega / pi, half turns a second
  numerics::TripleDouble period;        ///< T = pi / Omega [s], time between impacts
  numerics::DoubleDouble decay;         ///< sigma / ln 2, halvings a second
  numerics::DoubleDouble period_decay;  ///< sigma T / ln 2
  numerics::DoubleDouble log2_eta;      ///< 0 when eta = 0, where it is not used
  numerics::DoubleDouble impulse;       ///< (1 + eta) m1 |v_hit| of mass 1 [N s]
  numerics::DoubleDouble energy;        ///< sum of m v_hit^2 / 2 [J]
};

/// How many times sample_block() takes at most: a bit each in its result.
inline constexpr std::size_t most_in_block = 64;

/// What all masses share at the times of a block, a lane each.
struct FlightBlock {
  using Lanes = double[most_in_block];
  alignas(64) Lanes flight;  ///< k, the impacts so far; without a stop the half turns
  alignas(64) Lanes y_hi,
      y_lo;  ///< theta / pi: from -1/2, just after an impact, to 1/2, just before
  alignas(64) Lanes e_hi, e_lo;  ///< E without a power of two
  alignas(64) Lanes scale;       ///< and that
};

/// Fills a block, its unused lanes with the first time. Returns what sample_block() returns.
std::uint64_t flight_block(const FlightConstants& c, const double* times, std::size_t count,
                           FlightBlock& block);

/// Evaluates a motion at `count` times with the widest vectors of the processor, chosen when the
/// program first comes here. Writes row-major (time, mass); `a` may be null. Returns a bit for each
/// time (the first the lowest) that was left out and is to be evaluated alone: outside [0, end], beside
/// an impact, where E < 2^-1000, and at rest. The others hold the bits that the same operations on
/// single numbers give.
std::uint64_t sample_block(const FlightConstants& c, const double* times, std::size_t count,
                           double* u, double* v, double* a);

/// The factors r = E exp(i p Omega t) by which a motion turns in 0 to most_in_block - 1 equal steps.
struct StepTable {
  using Lanes = FlightBlock::Lanes;
  /// Both parts of r as a multiple of 2^-26 and its rest, and their derivatives [1/s].
  struct Factor {
    alignas(64) Lanes cosine, sine, cosine_rest, sine_rest, cosine_rate, sine_rate;
  };
  alignas(64) Lanes t;  ///< [s]
  alignas(64) Lanes y;  ///< half turns beyond a whole number, less 1/2
  double whole;         ///< that number for all steps
  double most_delta;    ///< how far a time may be from its place [s]
  Factor factors[2];    ///< of each mass
};

/// Fewer times are not worth a table, which takes as long as 64 times by themselves.
inline constexpr std::size_t least_equidistant = 320;
/// How many blocks sample_steps() takes at most.
inline constexpr std::size_t most_anchors = 8;

/// Fills the table where `times` begin equidistant but for rounding, the motion decays by no more than
/// 2^-12 in a block and does not come to rest. Returns whether it did.
bool tabulate_steps(const FlightConstants& c, std::span<const double> times, StepTable& table);

/// As sample_block(), for `blocks` times most_in_block times that go on in steps of the table from the
/// first of each block: left_out[i] is of block i. Times out of place are left out. Returns whether
/// in some block most are in place.
bool sample_steps(const FlightConstants& c, const StepTable& table, const double* times,
                  std::size_t blocks, double* u, double* v, double* a, std::uint64_t* left_out);

}  // namespace clackers::exact
