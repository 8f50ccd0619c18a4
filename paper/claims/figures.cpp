// What is measured of the series of a figure, and of a figure.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "clackers/cases/case.hpp"
#include "clackers/exact/quantities/spectrum.hpp"
#include "paper/claims/claim.hpp"
#include "paper/figures/validation.hpp"

namespace clackers::paper {
namespace {

double top(const Series& line) { return std::ranges::max(line.y); }
double zeros(const Series& line) {
  double count = 0.0;
  for (std::size_t i = 1; i < line.y.size(); ++i) count += line.y[i - 1] * line.y[i] < 0.0;
  return count;
}
// Where a line is highest beyond x = 1.
double summit(const Series& line) {
  std::size_t best = line.x.size() - 1;
  for (std::size_t i = 0; i < line.x.size(); ++i)
    if (line.x[i] > 1.0 && line.y[i] > line.y[best]) best = i;
  return line.x[best];
}
// The step at which an error is 1 %, between levels.
double step_of_percent(const Series& line) {
  const auto& [x, y] = std::tie(line.x, line.y);
  std::size_t i = 1;
  while (i + 1 < y.size() && y[i] > 0.01) ++i;
  return x[i - 1] *
         std::pow(x[i] / x[i - 1], std::log(0.01 / y[i - 1]) / std::log(y[i] / y[i - 1]));
}
// By what half the step divides an error, beyond the three coarsest levels.
std::vector<double> factors(const Series& line) {
  std::vector<double> out;
  for (std::size_t i = 3; i < line.y.size(); ++i) out.push_back(line.y[i - 1] / line.y[i]);
  return out;
}

// Richardson's estimates of the error of u1 at the end, over the true one, from steps h, h/2, ...
std::vector<double> estimates(const char* method, double order) {
  const Pair pair(1.0, 0.05);
  std::vector<double> u, out;
  for (double steps = 4000.0; steps < 1e5; steps *= 2.0)
    u.push_back(*(history(pair.problem(20.0), method, 20.0 / steps).u.end() - 2));
  for (std::size_t i = 1; i < u.size(); ++i)
    out.push_back((u[i] - u[i - 1]) / (1.0 - std::pow(2.0, order)) /
                  (u[i] - pair.written(20.0, 0)));
  return out;
}

// Fig. 6 from its samples against the closed form, of the peak of mass 2.
std::vector<double> errors_of_samples(const Figure& figure) {
  std::vector<double> out;
  for (const int N : {1, 2, 10}) {
    const auto& lines = figure.panels.at(2 * out.size() + 1).series;
    const auto system = cases::make("one-parameter", {{"N", double(N)}});
    const exact::Spectrum spectrum(*exact::as_closed_form(*system.motion));
    double off = 0.0;
    for (std::size_t mass = 0; mass < 2; ++mass)
      for (std::size_t i = 0; i < lines[1].x.size(); ++i)
        off = std::max(
            off, std::abs(lines[2 * mass + 1].y[i] - std::abs(spectrum.at(lines[1].x[i])[mass])));
    out.push_back(off / top(lines[2]));
  }
  return out;
}

// How many of the parameters that panels name change from each to the next.
std::vector<double> changed_parameters(const Figure& figure) {
  std::vector<double> out;
  std::vector<std::string> before, now;
  for (const auto& panel : figure.panels) {
    now.clear();
    std::istringstream in(panel.note);
    for (std::string part; std::getline(in, part, ',');) now.push_back(part);
    if (!before.empty())
      out.push_back(double(now.size()) - std::inner_product(now.begin(), now.end(), before.begin(),
                                                            0.0, std::plus<>(), std::equal_to<>()));
    before = now;
  }
  return out;
}

}  // namespace

std::span<const Measure> measures_of_figures() {
  using Of = const Figure&;
  using Values = std::vector<double>;
  static const Measure table[] = {
      {"top", top},
      {"zeros", zeros},
      {"summit", summit},
      {"last y", [](const Series& line) { return line.y.back(); }},
      {"last maximum",
       [](const Series& line) {
         return *std::max_element(line.y.end() - std::ptrdiff_t(line.y.size() / 10), line.y.end());
       }},
      {"step of 1 %", step_of_percent},
      {"least factor", [](const Series& line) { return std::ranges::min(factors(line)); }},
      {"most factor", [](const Series& line) { return std::ranges::max(factors(line)); }},
      {"converged error", [](const Series& line) { return converges(line) ? line.y.back() : 1e9; }},
      {"least y", [](const Series& line) { return std::ranges::min(line.y); }},
      {"errors of samples", errors_of_samples},
      {"estimates of newmark", [](Of) { return estimates("newmark", 2.0); }},
      {"estimates of reversal", [](Of) { return estimates("newmark+reversal", 1.0); }},
      {"e", [](Of) { return Values{std::abs(std::exp(1.0) - 2.718281828459)}; }},
      {"changed parameters", changed_parameters},
      {"quarter periods before",
       [](Of f) {
         return Values{(f.panels[0].series[4].x[0] - f.panels[0].series[3].x[0]) * 42.0 *
                       std::sqrt(0.9975) / std::acos(-1.0)};
       }},
  };
  return table;
}

}  // namespace clackers::paper
