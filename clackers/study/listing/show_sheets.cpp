#include "clackers/study/listing/show_sheets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clackers/exact/pair/exact_data_pair.hpp"
#include "clackers/exact/pair/synchronized_pair.hpp"
#include "clackers/exact/quantities/conditioning.hpp"
#include "clackers/exact/quantities/harmonics.hpp"
#include "clackers/exact/quantities/indicators.hpp"

namespace clackers::study {
namespace {

struct Pair {
  exact::PairConstants constants;
  double r = 1.0, eta = 1.0;
};

std::optional<Pair> pair_of(const cases::Case& which) {
  if (const auto* pair = dynamic_cast<const exact::SynchronizedPair*>(which.motion.get()))
    return Pair{pair->constants(), pair->parameters().r, pair->parameters().eta};
  if (const auto* pair = dynamic_cast<const exact::ExactDataPair*>(which.motion.get()))
    return Pair{pair->constants(), pair->parameters().r, pair->parameters().eta};
  return std::nullopt;
}

double lost_after(const Pair& pair, double eps) {
  return exact::collisions_until_detuning(pair.constants.ratio, pair.r, pair.eta, eps);
}

}  // namespace

std::optional<Sheet> harmonic_sheet(const cases::Case& which, double threshold) {
  const auto pair = pair_of(which);
  if (!pair) return std::nullopt;
  const auto& c = pair->constants;
  const double odd = c.ratio.odd, omega = std::min(c.omega_D1, c.omega_D2);
  const double last = exact::indicators(odd, omega, 1.0, threshold).highest_harmonic;
  const double peak = exact::peak_harmonic(odd), size = exact::harmonic_amplitude(odd, peak);
  Sheet sheet{
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

std::optional<Sheet> conditioning_sheet(const cases::Case& which) {
  const auto pair = pair_of(which);
  if (!pair) return std::nullopt;
  Sheet sheet{"clackers/conditioning/1",
              "Synchrony lost: collisions spaced wrongly by a tenth",
              {{"disturbance", "", "of what"},
               {"size", "", "relative"},
               {"lost_after", "", "number of the collision; inf: never"}},
              {}};
  for (const double size : {1e-3, 1e-6, 1e-9, 0x1p-53})
    sheet.rows.push_back({std::string("of the state at one collision"), size,
                          exact::collisions_until_perturbation(pair->eta, size)});
  for (const double size : {1e-2, 1e-3, 1e-4, 1e-6})
    sheet.rows.push_back({std::string("of omega_D2/omega_D1, as a solver's dispersion makes"), size,
                          std::min(lost_after(*pair, size), lost_after(*pair, -size))});
  return sheet;
}

}  // namespace clackers::study
