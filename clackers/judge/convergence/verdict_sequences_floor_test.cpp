#include <cmath>

#include "clackers/base/constants.hpp"
#include "clackers/judge/testing/verdict_sequence.hpp"

namespace clackers::judge {
namespace {

using namespace synthetic;
using enum Behaviour;
using std::exp, std::pow;

// Rounding of a run to 20 s that adds up, every step one way, or at random.
double adds_up(double h) { return 2.0 * epsilon * 20.0 / h; }

// Errors read off numbers printed with six decimals: whole units of the last one.
std::vector<ErrorLevel> printed(const std::function<double(double)>& error) {
  auto made = ladder([&](double h) { return 1e-6 * std::round(error(h) / 1e-6); });
  for (auto& level : made)
    for (auto& point : level) point.floor = 5e-7;
  return made;
}

std::vector<ErrorLevel> without_floors(std::vector<ErrorLevel> made) {
  for (auto& level : made)
    for (auto& point : level) point.floor = 0.0;
  return made;
}

// clang-format off
const VerdictSequence floor_rows[] = {
    {.name = "order two above a rounding floor is proper",
     .make = [] { return ladder([](double h) { return 3e-6 * h * h + adds_up(h); }); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 0.05},
    {.name = "order four above rounding that grows at random is proper",
     .make = [] {
       Scatter drift(4.0, 3);
       return ladder([=](double h) mutable {
         return 20.0 * pow(h, 4) + drift() * epsilon * std::sqrt(20.0 / h);
       });
     },
     .claim = claims(4), .behaviour = proper, .verdict = Verdict::agrees, .order = 4.0,
     .within = 0.05},
    {.name = "a rounding floor after three levels leaves too few",
     .make = [] { return ladder([](double h) { return 1e-2 * pow(h, 4) + adds_up(h); }); },
     .claim = claims(4), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "too-few-levels"},
    {.name = "errors that grow below some step by known rounding stay proper",
     .make = [] { return ladder([](double h) { return 1e-5 * h * h + 3.0 * adds_up(h); }); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 0.1},
    {.name = "errors that grow in the last two levels for no known cause are not proper",
     .make = [] { return without_floors(ladder([](double h) { return h * h + 2e-9 / h; })); },
     .claim = claims(2), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "error-grows-again"},
    {.name = "errors that grow over four levels for no known cause diverge",
     .make = [] { return without_floors(ladder([](double h) { return h * h + 4e-7 / h; })); },
     .claim = claims(2), .behaviour = divergent, .verdict = Verdict::disagrees,
     .reason = "error-growth", .order = -1.0, .within = 0.05},
    {.name = "an iteration tolerance is the floor that was claimed",
     .make = [] { return ladder([](double h) { return 5.0 * h * h + 1e-4; }); },
     .claim = claims_floor("tolerance-floor"), .behaviour = stagnating, .verdict = Verdict::agrees,
     .reason = "tolerance-floor", .order = 2.0, .within = 0.1},
    {.name = "an iteration tolerance that is not stated is an unexplained floor",
     .make = [] { return ladder([](double h) { return 5.0 * h * h + 1e-4; }); },
     .claim = claims(2), .behaviour = stagnating, .verdict = Verdict::disagrees,
     .reason = "unexplained-floor", .order = 2.0, .within = 0.1},
    {.name = "a floor that only the finest level reaches leaves order two above it",
     .make = [] { return ladder([](double h) { return h * h + 2e-7; }); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees,
     .reason = "unexplained-floor", .order = 2.0, .within = 0.05},
    {.name = "five errors that begin to meet a floor keep the order above it",
     .make = [] { return ladder([](double h) { return h * h + 1.7e-6; }, {.levels = 5, .samples = 1}); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees,
     .reason = "unexplained-floor", .order = 2.0, .within = 0.02},
    {.name = "a smooth floor over more than two octaves is seen",
     .make = [] { return ladder([](double h) { return h * h + 1.1e-6; }); },
     .claim = claims(2), .behaviour = stagnating, .verdict = Verdict::disagrees,
     .reason = "unexplained-floor", .order = 2.0, .within = 0.05},
    {.name = "printed digits that end the line after five levels leave it proper",
     .make = [] { return printed([](double h) { return 5.0 * h * h; }); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 0.1},
    {.name = "printed digits that end the line after two levels leave too few",
     .make = [] { return printed([](double h) { return 0.01 * h * h; }); },
     .claim = claims(2), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "too-few-levels"},
    {.name = "printed digits that hide every error look exact and decide nothing",
     .make = [] { return printed([](double h) { return 4e-4 * h * h; }); },
     .claim = claims(2), .behaviour = exact, .verdict = Verdict::undecided},
    {.name = "errors that are all zero are exact and leave a claimed order open",
     .make = [] { return ladder([](double) { return 0.0; }); },
     .claim = claims(2), .behaviour = exact, .verdict = Verdict::undecided},
    {.name = "errors that are all zero agree where exactness is claimed",
     .make = [] { return ladder([](double) { return 0.0; }); },
     .claim = {exact, 0.0, ""}, .behaviour = exact, .verdict = Verdict::agrees},
    {.name = "one zero among the errors is left out",
     .make = [] {
       auto made = ladder([](double h) { return h * h; });
       made[5][2].error = 0.0;
       return made;
     },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 1e-9},
    {.name = "a level of zeros in the middle is left out",
     .make = [] {
       auto made = ladder([](double h) { return h * h; });
       for (auto& point : made[4]) point.error = 0.0;
       return made;
     },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 1e-9},
    {.name = "a constant error is a floor",
     .make = [] { return ladder([](double) { return 0.3; }); },
     .claim = claims(2), .behaviour = stagnating, .verdict = Verdict::disagrees,
     .reason = "unexplained-floor"},
    {.name = "a constant error is what a compliant contact claims",
     .make = [] { return ladder([](double h) { return 0.3 + h; }); },
     .claim = claims_floor("contact-stiffness"), .behaviour = stagnating,
     .verdict = Verdict::agrees, .reason = "contact-stiffness", .contact_time = 0.0157},
    {.name = "a line through a contact that no step resolves decides nothing",
     .make = [] { return ladder([](double h) { return h * h; }); },
     .claim = claims(2), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "contact-not-resolved", .contact_time = 1e-3},
    {.name = "an error that passes through zero before its floor stagnates",
     .make = [] { return ladder([](double h) { return 1e-2 * std::abs(1.0 - pow(h / 0.008, 2)); }); },
     .claim = claims(2), .behaviour = stagnating, .verdict = Verdict::disagrees,
     .reason = "unexplained-floor"},
    {.name = "errors that rise to a plateau settle and do not diverge",
     .make = [] { return ladder([](double h) { return 0.01 * (1.0 - exp(-0.01 / h)); }); },
     .claim = claims(2), .behaviour = stagnating, .verdict = Verdict::disagrees,
     .reason = "unexplained-floor"},
    {.name = "a contact that only the finest levels resolve shows its floor there",
     .make = [] {
       return ladder([](double h) { return h > 0.004 ? 0.5 * swing(h, 1.3, 0.7) : 0.02 + h * h; });
     },
     .claim = claims_floor("contact-stiffness"), .behaviour = stagnating,
     .verdict = Verdict::agrees, .reason = "contact-stiffness", .contact_time = 0.03},
    {.name = "a floor that is claimed with another cause disagrees",
     .make = [] { return ladder([](double h) { return 5.0 * h * h + 1e-4; }); },
     .claim = claims_floor("contact-stiffness"), .behaviour = stagnating,
     .verdict = Verdict::disagrees, .reason = "unexplained-floor", .order = 2.0, .within = 0.1},
    {.name = "exactness is not claimed by a method that only ends at the rounding floor",
     .make = [] { return ladder([](double h) { return 3e-6 * h * h + adds_up(h); }); },
     .claim = {exact, 0.0, ""}, .behaviour = proper, .verdict = Verdict::disagrees, .order = 2.0,
     .within = 0.05},
};
// clang-format on

INSTANTIATE_TEST_SUITE_P(Floor, VerdictSequences, testing::ValuesIn(floor_rows), name_of_row);

}  // namespace
}  // namespace clackers::judge
