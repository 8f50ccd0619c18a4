#include <cmath>

#include "clackers/judge/testing/verdict_sequence.hpp"

namespace clackers::judge {
namespace {

using namespace synthetic;
using enum Behaviour;
using std::pow;

// Errors of an adaptive solver at tolerances from 1e-3, a decade a run; one level each.
std::vector<ErrorLevel> decades(const std::function<double(double)>& error, int runs = 10) {
  std::vector<ErrorLevel> made;
  for (int i = 0; i < runs; ++i) {
    const double tolerance = pow(10.0, -3 - i);
    made.push_back({{tolerance, error(tolerance), 1e-14}});
  }
  return made;
}

// clang-format off
const VerdictSequence tolerance_rows[] = {
    {.name = "an error a hundred times the tolerance is proportional to it",
     .make = [] { return decades([](double tol) { return 100.0 * tol; }, 8); },
     .claim = claims(1), .behaviour = proper, .verdict = Verdict::agrees, .order = 1.0,
     .within = 1e-9, .by_tolerance = true},
    {.name = "an error that is the power four fifths of the tolerance is proportional enough",
     .make = [] { return decades([](double tol) { return pow(tol, 0.8); }); },
     .claim = claims(1), .behaviour = proper, .verdict = Verdict::agrees, .order = 0.8,
     .within = 1e-9, .by_tolerance = true},
    {.name = "an error that is the root of the tolerance falls too slowly",
     .make = [] { return decades([](double tol) { return std::sqrt(tol); }); },
     .claim = claims(1), .behaviour = reduced, .verdict = Verdict::disagrees, .order = 0.5,
     .within = 1e-9, .by_tolerance = true},
    {.name = "scatter by eight between tolerances is what step control leaves",
     .make = [] {
       Scatter scatter(8.0, 4);
       return decades([=](double tol) mutable { return 20.0 * tol / scatter(); });
     },
     .claim = claims(1), .behaviour = proper, .verdict = Verdict::agrees, .order = 1.0,
     .within = 0.1, .by_tolerance = true},
    {.name = "scatter by a thousand between tolerances is no line",
     .make = [] {
       Scatter scatter(1e3, 2);
       return decades([=](double tol) mutable { return 1e3 * tol / scatter(); });
     },
     .claim = claims(1), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "no-convergence-yet", .by_tolerance = true},
    {.name = "a fixed tolerance of the event search ends the line of the tolerances",
     .make = [] { return decades([](double tol) { return 3.0 * tol + 2e-8; }); },
     .claim = claims(1), .behaviour = proper, .verdict = Verdict::agrees, .reason = "noise-floor",
     .order = 1.0, .within = 0.1, .by_tolerance = true},
    {.name = "an error that no tolerance changes stagnates",
     .make = [] { return decades([](double tol) { return 0.02 + tol; }); },
     .claim = claims(1), .behaviour = stagnating, .verdict = Verdict::disagrees,
     .reason = "noise-floor", .by_tolerance = true},
    {.name = "an error that grows with every tighter tolerance diverges",
     .make = [] { return decades([](double tol) { return 1e-4 / std::sqrt(tol); }, 6); },
     .claim = claims(1), .behaviour = divergent, .verdict = Verdict::disagrees,
     .reason = "error-growth", .by_tolerance = true},
    {.name = "three tolerances are too few",
     .make = [] { return decades([](double tol) { return 100.0 * tol; }, 3); },
     .claim = claims(1), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "too-few-levels", .by_tolerance = true},
    {.name = "tolerances too loose to follow the motion stay outside the line",
     .make = [] { return decades([](double tol) { return 1.5 * std::tanh(2e4 * tol); }); },
     .claim = claims(1), .behaviour = proper, .verdict = Verdict::agrees, .order = 1.0,
     .within = 0.1, .by_tolerance = true},
    {.name = "errors as large as the motion at every tolerance decide nothing",
     .make = [] { return decades([](double tol) { return 1.5 + tol; }); },
     .claim = claims(1), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "larger-than-motion", .by_tolerance = true},
    {.name = "tolerances that span one octave are too few",
     .make = [] {
       std::vector<ErrorLevel> made;
       for (const double tol : {1e-4, 8e-5, 6.5e-5, 5e-5}) made.push_back({{tol, 20.0 * tol, 0.0}});
       return made;
     },
     .claim = claims(1), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "too-few-levels", .by_tolerance = true},
};
// clang-format on

INSTANTIATE_TEST_SUITE_P(Tolerance, VerdictSequences, testing::ValuesIn(tolerance_rows),
                         name_of_row);

}  // namespace
}  // namespace clackers::judge
