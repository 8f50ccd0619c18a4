#include "paper/catalogue.hpp"

#include <algorithm>
#include <array>

#include "clackers/base/check.hpp"
#include "paper/claims/claim.hpp"

namespace clackers::paper {
namespace {

// A builder that takes less than 0.1 s.
template <Figure (*builder)()>
Figure short_one(const std::atomic<bool>*) {
  return builder();
}

constexpr auto table = std::to_array<Entry>({
    {"fig1", "Response of the linear system, Eq. (3)", short_one<free_mass>},
    {"fig2", "A mass on spring and dashpot with a stop at its equilibrium",
     short_one<mass_and_stop>},
    {"fig3", "Response of the mass at the stop, Eq. (5)", short_one<response_at_stop>},
    {"fig4", "Response of two equal colliding masses, Eq. (7)-(8)", short_one<symmetric_pair>},
    {"fig5", "A sample extension: the second mass five times as fast", short_one<sample_extension>},
    {"fig6", "Responses in the time and frequency domain for N = 1, 2, 10", short_one<spectra>},
    {"fig7", "One parameter: responses for N = 2, 5, 20, Eq. (19)", short_one<effect_of_N>},
    {"fig8", "Two parameters: the effect of damping, Eq. (21)", short_one<effect_of_damping>},
    {"fig9", "Three parameters: the effect of the duration", short_one<effect_of_duration>},
    {"fig10", "Ten responses of the three-parameter system, Eq. (25)-(26)",
     short_one<three_parameters>},
    {"fig11", "An impact mirrors the response", short_one<mirrored_response>},
    {"fig12", "Coincidence with the response without impacts", short_one<coincidence>},
    {"figA1", "No contact away from equilibrium: D' is positive", short_one<positive_definite>},
    {"figA2", "Smaller initial displacements of mass 2 are safe too", short_one<amplitudes>},
    {"figA3", "The nearest miss before an impact", short_one<near_miss>},
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

Figure make(const Entry& entry, const std::atomic<bool>* interrupt) {
  auto figure = entry.build(interrupt);
  figure.name = entry.name;
  figure.title = entry.title;
  figure.claims = claims_beside(figure, interrupt);
  return figure;
}

}  // namespace clackers::paper
