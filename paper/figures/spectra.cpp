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

struct Compared {
  Panel time, frequency;
};

Compared compare(int N, std::string label) {
  const auto test_case = cases::make("one-parameter", {{"N", double(N)}});
  const exact::Spectrum spectrum(*exact::as_closed_form(*test_case.motion));
  Compared out;
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
  for (std::size_t mass = 0; mass < 2; ++mass) {
    Series line{fmt::format("mass {}", mass + 1), {}, {}, mass == 0 ? first_mass() : second_mass()};
    constexpr int fine = 1000;
    for (int i = 0; i <= fine; ++i) {
      const double omega = highest * i / fine, amplitude = std::abs(spectrum.at(omega)[mass]);
      line.x.push_back(omega);
      line.y.push_back(amplitude);
    }
    // The frequencies that a discrete transform of 20 s has; every so many as points.
    Series dots{
        fmt::format("mass {}, from samples", mass + 1), {}, {}, line.stroke, Series::Kind::points};
    const double spacing = 2.0 * std::numbers::pi / end;
    const int every = std::max(1, int(highest / spacing / 40.0));
    for (int j = 0; j * spacing <= highest; j += every) {
      dots.x.push_back(j * spacing);
      dots.y.push_back(std::abs(discrete(u, mass, j * spacing)));
    }
    out.frequency.series.push_back(std::move(line));
    out.frequency.series.push_back(std::move(dots));
  }
  return out;
}

}  // namespace

Figure spectra() {
  Figure figure;
  figure.columns = 2;
  figure.width = 330.0;
  figure.height = 180.0;
  figure.caption =
      "Exact displacements (left) and the amplitudes of their Fourier transform over 0 ≤ t ≤ 20 s (right), lines from the closed form, points from samples every 0.001 s; ξ1 = 0.05.";
  for (const auto& [time, frequency] : {compare(1, "a"), compare(2, "b"), compare(10, "c")}) {
    figure.panels.push_back(time);
    figure.panels.push_back(frequency);
  }
  figure.choices = {
      "The text names no scale of the amplitudes. A logarithmic one shows mass 2 beside mass 1.",
      "N = 1, 2, 10 belong to Eq. (19), so ξ1 = 0.05, as the reference to Fig. 4 asks."};
  return figure;
}

}  // namespace clackers::paper
