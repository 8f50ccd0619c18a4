#include "clackers/tables/listing/show_sheets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/exact/quantities/quantities.hpp"

namespace clackers::tables {
namespace {

// A pair in closed form, or null.
const exact::ClosedForm* pair_of(const cases::Case& test_case) {
  const auto* motion = exact::as_closed_form(*test_case.motion);
  return motion != nullptr && motion->pair() ? motion : nullptr;
}

double lost_after(const exact::ClosedForm& motion, double eps) {
  const auto& pair = *motion.pair();
  return exact::impacts_until_detuning(pair.ratio, pair.r, motion.flight().eta, eps);
}

}  // namespace

std::optional<record::Sheet> harmonic_sheet(const cases::Case& test_case, double threshold) {
  const auto* motion = pair_of(test_case);
  if (motion == nullptr) return std::nullopt;
  const auto& c = *motion->pair();
  const double odd = c.ratio.odd, omega = std::min(c.omega_D1, c.omega_D2);
  const double last = exact::indicators(odd, omega, 1.0, threshold).highest_harmonic;
  const double peak = exact::peak_harmonic(odd), size = exact::harmonic_amplitude(odd, peak);
  record::Sheet sheet{
      "clackers/harmonics/1",
      fmt::format("Harmonics of the fast mass, elastic and undamped; T_S counts those of at "
                  "least {:g} of the peak",
                  threshold),
      {{"n", "", "number of the harmonic"},
       {"omega", "rad/s", "2 n Omega, its frequency"},
       {"amplitude", "", "|a_n|, of the displacement over |u(0)| of the fast mass"},
       {"of_peak", "", "of the largest"},
       {"counts", "", "whether it reaches the threshold"}},
      {}};
  // Three on either side of the peak and of the last that counts.
  double next = 1.0;
  for (const double centre : {peak, last})
    for (double n = std::max(next, centre - 3.0); n <= centre + 3.0; n += 1.0) {
      const double amplitude = exact::harmonic_amplitude(odd, n);
      sheet.rows.push_back({static_cast<long long>(n), 2.0 * n * omega, amplitude, amplitude / size,
                            std::string(amplitude >= threshold * size ? "yes" : "no")});
      next = n + 1.0;
    }
  return sheet;
}

std::optional<record::Sheet> conditioning_sheet(const cases::Case& test_case) {
  const auto* motion = pair_of(test_case);
  if (motion == nullptr) return std::nullopt;
  record::Sheet sheet{"clackers/conditioning/1",
                      "Synchrony lost: impacts spaced wrongly by a tenth",
                      {{"disturbance", "", "of what"},
                       {"size", "", "relative"},
                       {"lost_after", "", "number of the impact; inf: never"}},
                      {}};
  for (const double size : {1e-3, 1e-6, 1e-9, 0x1p-53})
    sheet.rows.push_back({std::string("of the state at one impact"), size,
                          exact::impacts_until_perturbation(motion->flight().eta, size)});
  for (const double size : {1e-2, 1e-3, 1e-4, 1e-6})
    sheet.rows.push_back({std::string("of omega_D2/omega_D1, as caused by a solver's dispersion"),
                          size, std::min(lost_after(*motion, size), lost_after(*motion, -size))});
  return sheet;
}

}  // namespace clackers::tables
