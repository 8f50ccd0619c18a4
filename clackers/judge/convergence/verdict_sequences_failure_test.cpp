#include <cmath>

#include "clackers/judge/testing/verdict_sequence.hpp"

namespace clackers::judge {
namespace {

using namespace synthetic;
using enum Behaviour;
using std::exp;

// Order two with `bad` instead of the error at these levels.
std::vector<ErrorLevel> without(std::initializer_list<std::size_t> levels, double bad) {
  auto made = ladder([](double h) { return h * h; });
  for (const auto i : levels)
    for (auto& point : made[i]) point.error = bad;
  return made;
}

// Every run of the two finest levels.
auto at_the_end(void (*change)(measure::RunScore&)) {
  return [=](measure::Ladder& ladder) {
    for (auto level = ladder.end() - 2; level != ladder.end(); ++level)
      for (auto& run : level->runs) change(run);
  };
}

// clang-format off
const VerdictSequence failure_rows[] = {
    {.name = "a stability limit at coarse steps leaves the rest proper",
     .make = [] { return without({0, 1, 2}, nan); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 1e-9},
    {.name = "infinite errors at coarse steps leave the rest proper",
     .make = [] { return without({0, 1}, HUGE_VAL); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 1e-9},
    {.name = "huge errors at coarse steps leave the rest proper",
     .make = [] { return without({0, 1}, 1e218); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 1e-9},
    {.name = "failures at the finest steps are not passed over",
     .make = [] { return without({7}, nan); },
     .claim = claims(2), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "run-failed"},
    {.name = "infinite errors at the finest steps are not passed over",
     .make = [] { return without({6, 7}, HUGE_VAL); },
     .claim = claims(2), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "run-failed"},
    {.name = "a level of failures in the middle ends the window",
     .make = [] { return without({3}, nan); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 1e-9},
    {.name = "a level of failures with three levels behind it leaves too few",
     .make = [] { return without({4}, nan); },
     .claim = claims(2), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "too-few-levels"},
    {.name = "single failures on every level are left out",
     .make = [] {
       auto made = ladder([](double h) { return h * h; });
       for (std::size_t i = 0; i < made.size(); ++i) made[i][(3 * i) % 8].error = nan;
       return made;
     },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 1e-9},
    {.name = "nothing but failures decides nothing",
     .make = [] { return without({0, 1, 2, 3, 4, 5, 6, 7}, nan); },
     .claim = claims(2), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "run-failed"},
    {.name = "errors that grow with every refinement diverge",
     .make = [] { return ladder([](double h) { return 1e-6 / h; }); },
     .claim = claims(2), .behaviour = divergent, .verdict = Verdict::disagrees,
     .reason = "error-growth", .order = -1.0, .within = 1e-9},
    {.name = "errors that grow until the runs fail diverge",
     .make = [] { return ladder([](double h) { return h < 0.0008 ? nan : 1e-6 / (h * h); }); },
     .claim = claims(2), .behaviour = divergent, .verdict = Verdict::disagrees,
     .reason = "error-growth"},
    {.name = "a run that gains energy at its floor diverges",
     .make = [] { return ladder([](double h) { return 0.3 + h; }); },
     .claim = claims(2), .behaviour = divergent, .verdict = Verdict::disagrees,
     .reason = "energy-growth",
     .change = at_the_end([](measure::RunScore& run) {
       run.energy_ratio = 2.1;
       run.energy_error = 1.1;
     })},
    {.name = "a run that loses most energy at its floor stagnates",
     .make = [] { return ladder([](double h) { return 0.3 + h; }); },
     .claim = claims(2), .behaviour = stagnating, .verdict = Verdict::disagrees,
     .reason = "unexplained-floor",
     .change = at_the_end([](measure::RunScore& run) { run.energy_ratio = 0.4; })},
    {.name = "a line that misses an impact disagrees",
     .make = [] { return ladder([](double h) { return h * h; }); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::disagrees, .order = 2.0,
     .within = 1e-9,
     .change = at_the_end([](measure::RunScore& run) {
       run.impacts->found = run.impacts->matched = 5;
       run.impacts->missed = 1;
     })},
    {.name = "growth that is claimed agrees",
     .make = [] { return ladder([](double h) { return 1e-6 / h; }); },
     .claim = {divergent, 0.0, ""}, .behaviour = divergent, .verdict = Verdict::agrees,
     .reason = "error-growth", .order = -1.0, .within = 1e-9},
    {.name = "failures of more than half of the finest runs are not passed over",
     .make = [] {
       auto made = ladder([](double h) { return h * h; });
       for (std::size_t i = 0; i < 5; ++i) made[7][i].error = nan;
       return made;
     },
     .claim = claims(2), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "run-failed"},
    {.name = "failures of half of the finest runs leave a line of the others",
     .make = [] {
       auto made = ladder([](double h) { return h * h; });
       for (std::size_t i = 0; i < 4; ++i) made[7][i].error = nan;
       return made;
     },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 1e-9},
    {.name = "errors that fall while most energy is lost call for smaller steps",
     .make = [] { return ladder([](double h) { return 1.0 - exp(-60.0 * h); }, {.levels = 4}); },
     .claim = claims(1), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "numerical-damping",
     .change = at_the_end([](measure::RunScore& run) { run.energy_ratio = 0.4; })},
    {.name = "a floor whose impacts are late but all there agrees",
     .make = [] { return ladder([](double h) { return 0.3 + h; }); },
     .claim = claims_floor(""), .behaviour = stagnating, .verdict = Verdict::agrees,
     .reason = "unexplained-floor",
     .change = at_the_end([](measure::RunScore& run) {
       run.impacts->matched = 5;
       run.impacts->missed = run.impacts->extra = 1;
     })},
    {.name = "a floor with an impact too few disagrees",
     .make = [] { return ladder([](double h) { return 0.3 + h; }); },
     .claim = claims_floor(""), .behaviour = stagnating, .verdict = Verdict::disagrees,
     .reason = "unexplained-floor",
     .change = at_the_end([](measure::RunScore& run) {
       run.impacts->found = run.impacts->matched = 5;
       run.impacts->missed = 1;
     })},
};
// clang-format on

INSTANTIATE_TEST_SUITE_P(Failure, VerdictSequences, testing::ValuesIn(failure_rows), name_of_row);

}  // namespace
}  // namespace clackers::judge
