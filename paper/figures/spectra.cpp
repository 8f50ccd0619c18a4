// Figure 6: responses for N = 1, 2, 10 beside their Fourier amplitudes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "clackers/exact/quantities/quantities.hpp"
#include "clackers/exact/quantities/spectrum.hpp"
#include "paper/catalogue.hpp"
#include "paper/figures/curves.hpp"

namespace clackers::paper {
namespace {

using Complex = std::complex<double>;

constexpr double sampling = 0.001;  // the paper's [s]
constexpr double end = 20.0;        // [s]

// Displacements of both masses at k * sampling, row-major.
std::vector<double> samples(const cases::Case& test_case) {
  const auto count = std::size_t(std::lround(end / sampling)) + 1;
  std::vector<double> times(count), u(2 * count), v(2 * count), none;
  for (std::size_t k = 0; k < count; ++k) times[k] = double(k) * sampling;
  times.back() = end;
  test_case.motion->sample(times, model::Side::right, {u, v, none});
  return u;
}

// The integral of u exp(-i omega t) over the run by the trapezoidal rule, as from recorded samples.
Complex discrete(const std::vector<double>& u, std::size_t mass, double omega) {
  const auto count = u.size() / 2;
  Complex sum = 0.0;
  // The turning pointer is set anew every 64 steps, so it drifts by less than 64 ulp.
  const Complex turn = std::polar(1.0, -omega * sampling);
  Complex pointer = 1.0;
  for (std::size_t k = 0; k < count; ++k) {
    if (k % 64 == 0) pointer = std::polar(1.0, -omega * double(k) * sampling);
    const double weight = k == 0 || k + 1 == count ? 0.5 : 1.0;
    sum += weight * u[2 * k + mass] * pointer;
    pointer *= turn;
  }
  return sum * sampling;
}

struct Peak {
  double omega = 0.0, amplitude = 0.0;
};

struct Compared {
  int N = 0;
  Panel time, frequency;
  double difference = 0.0;  // largest |discrete - closed form| [m s]
  double bound = 0.0;       // of the trapezoidal rule [m s]
  Peak peak;                // of mass 2 [rad/s, m s]
};

// Largest error of the trapezoidal rule: h^2/8 times the variation of the integrand's slope, its
// second derivative at most (w + omega)^2 |b| exp(-sigma t) in flight. The slope of each mass turns
// round at each impact: less than once more the same for w >= 1 and a flight of length T = 3 s.
double rule_bound(double amplitude, double w, double omega) {
  const double decay = (1.0 - std::exp(-0.05 * end)) / 0.05;
  return 2.0 * sampling * sampling / 8.0 * (w + omega) * (w + omega) * amplitude * decay;
}

Compared compare(int N, std::string label) {
  const auto test_case = cases::make("one-parameter", {{"N", double(N)}});
  const exact::Spectrum spectrum(*exact::as_closed_form(*test_case.motion));
  Compared out;
  out.N = N;
  out.time = response_panel(test_case, Quantity::displacement, std::move(label),
                            fmt::format("N = {}", N), {-0.6, 1.0});
  const double highest = N == 10 ? 50.0 : N == 2 ? 20.0 : 15.0;
  out.frequency = {"",
                   fmt::format("N = {}", N),
                   {.title = "angular frequency ω [rad/s]", .lowest = 0.0, .highest = highest},
                   {.title = "Fourier amplitude |F| [m s]",
                    .lowest = 1e-3,
                    .highest = 20.0,
                    .logarithmic = true},
                   {}};
  const auto u = samples(test_case);
  const double X = constant(test_case, "X"), d2 = std::abs(constant(test_case, "d2"));
  for (std::size_t mass = 0; mass < 2; ++mass) {
    Series line{fmt::format("mass {}", mass + 1), {}, {}, mass == 0 ? first_mass() : second_mass()};
    constexpr int fine = 1000;
    for (int i = 0; i <= fine; ++i) {
      const double omega = highest * i / fine, amplitude = std::abs(spectrum.at(omega)[mass]);
      line.x.push_back(omega);
      line.y.push_back(amplitude);
      if (mass == 1 && amplitude > out.peak.amplitude) out.peak = {omega, amplitude};
    }
    // The frequencies that a discrete transform of 20 s has; every so many as points.
    Series dots{
        fmt::format("mass {}, from samples", mass + 1), {}, {}, line.stroke, Series::Kind::points};
    const double spacing = 2.0 * std::numbers::pi / end;
    const int every = std::max(1, int(highest / spacing / 40.0));
    for (int j = 0; j * spacing <= highest; ++j) {
      const auto found = discrete(u, mass, j * spacing), exact = spectrum.at(j * spacing)[mass];
      out.difference = std::max(out.difference, std::abs(found - exact));
      if (j % every != 0) continue;
      dots.x.push_back(j * spacing);
      dots.y.push_back(std::abs(found));
    }
    out.bound = std::max(out.bound, rule_bound(mass == 0 ? 1.0 : d2, mass == 0 ? 1.0 : X, highest));
    out.frequency.series.push_back(std::move(line));
    out.frequency.series.push_back(std::move(dots));
  }
  return out;
}

// Eq. (11) for two thresholds of the spectral peak.
Claim upper_bound() {
  Claim claim{"Eq. (11): I_ms is an upper bound of T_L/T_S.", {}, false};
  bool everywhere = true;
  for (const double threshold : {cases::default_threshold, 0.001}) {
    claim.measured += fmt::format(
        "{}hreshold {} of the spectral peak:", claim.measured.empty() ? "T" : "; t", threshold);
    for (const int N : {0, 1, 2, 10}) {
      const double X = 4.0 * N + 1.0;
      const auto found = exact::indicators(X, 1.0, end, threshold);
      claim.measured += fmt::format("{} N = {}: {:.0f} {} {:.0f}", N == 0 ? "" : ",", N, X,
                                    found.bound_holds ? "≥" : "<", found.highest_harmonic);
      claim.holds = claim.holds || found.bound_holds;
      everywhere = everywhere && found.bound_holds;
    }
  }
  claim.measured += ". The open points have the condition.";
  claim.in_part = !everywhere;
  return claim;
}

}  // namespace

Figure spectra() {
  const std::vector<Compared> all{compare(1, "a"), compare(2, "b"), compare(10, "c")};
  Figure figure;
  figure.columns = 2;
  figure.width = 330.0;
  figure.height = 180.0;
  figure.caption =
      "Exact displacements (left) and the amplitudes of their Fourier transform over 0 ≤ t ≤ 20 s (right), lines from the closed form, points from samples every 0.001 s; ξ1 = 0.05.";
  std::string periods;
  bool falling = true;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& entry = all[i];
    figure.panels.push_back(entry.time);
    figure.panels.push_back(entry.frequency);
    figure.claims.push_back(
        {fmt::format(
             "Section 2.2: time steps of 0.001 s give accurate Fourier amplitudes (N = {}).",
             entry.N),
         fmt::format(
             "The transform of the samples and the closed form differ by at most {} m s, {} of the peak of mass 2. The trapezoidal rule allows {} m s.",
             number(entry.difference), number(entry.difference / entry.peak.amplitude),
             number(entry.bound)),
         entry.difference <= entry.bound});
    periods += fmt::format("{}N = {}: {:.4g} s with {:.4g} m s", i == 0 ? "" : ", ", entry.N,
                           2.0 * std::numbers::pi / entry.peak.omega, entry.peak.amplitude);
    if (i > 0)
      falling = falling && entry.peak.omega > all[i - 1].peak.omega &&
                entry.peak.amplitude < all[i - 1].peak.amplitude;
  }
  figure.claims.push_back(
      {"Section 2.2: as N increases, the smallest period and its Fourier amplitude decrease.",
       "Period and amplitude at the peak of mass 2: " + periods + ".", falling});
  figure.claims.push_back(upper_bound());
  figure.choices = {
      "The text names no scale of the amplitudes. A logarithmic one shows mass 2 beside mass 1.",
      "N = 1, 2, 10 belong to Eq. (19), so ξ1 = 0.05, as the reference to Fig. 4 asks."};
  return figure;
}

}  // namespace clackers::paper
