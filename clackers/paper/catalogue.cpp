#include "clackers/paper/catalogue.hpp"

#include <algorithm>
#include <array>

#include "clackers/base/suggest.hpp"

namespace clackers::paper {
namespace {

constexpr auto table = std::to_array<Entry>({
    {"fig1", "Response of the linear system, Eq. (3)", free_mass},
    {"fig2", "A mass on spring and dashpot with a stop at its equilibrium", mass_and_stop},
    {"fig3", "Response of the mass at the stop, Eq. (5)", response_at_stop},
    {"fig4", "Response of two equal colliding masses, Eq. (7)-(8)", symmetric_pair},
    {"fig5", "A sample extension: the second mass five times as fast", sample_extension},
    {"fig6", "Responses in the time and frequency domain for N = 1, 2, 10", spectra},
    {"fig7", "One parameter: responses for N = 2, 5, 20, Eq. (19)", effect_of_N},
    {"fig8", "Two parameters: the effect of damping, Eq. (21)", effect_of_damping},
    {"fig9", "Three parameters: the effect of the duration", effect_of_duration},
    {"fig10", "Ten responses of the three-parameter system, Eq. (25)-(26)", three_parameters},
    {"fig11", "A collision mirrors the response", mirrored_response},
    {"fig12", "Coincidence with the response without collisions", coincidence},
    {"figA1", "No contact away from equilibrium: D' is positive", positive_definite},
    {"figA2", "Smaller initial displacements of mass 2 are safe too", amplitudes},
    {"figA3", "The nearest miss before a collision", near_miss},
    {"validation", "Six methods converge to Eq. (26)", validation},
});

}  // namespace

std::span<const Entry> entries() { return table; }

std::vector<Entry> chosen(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const auto& entry : table) known.emplace_back(entry.name);
  for (const auto& name : names)
    if (std::ranges::find(known, name) == known.end())
      refuse_name("figure", name, known, "clackers list figures");
  std::vector<Entry> out;
  for (const auto& entry : table)
    if (names.empty() || std::ranges::find(names, entry.name) != names.end()) out.push_back(entry);
  return out;
}

Figure make(const Entry& entry) {
  auto figure = entry.build();
  figure.name = entry.name;
  figure.title = entry.title;
  return figure;
}

}  // namespace clackers::paper
