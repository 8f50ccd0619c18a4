#include <cmath>

#include "clackers/judge/testing/verdict_sequence.hpp"

namespace clackers::judge {
namespace {

using namespace synthetic;
using enum Behaviour;
using std::abs, std::exp, std::log, std::log2, std::pow;

// Steps of uneven ratio, one a level: 1.25, 2, 1.54, 3.25, 2, 2.5.
std::vector<ErrorLevel> uneven(const std::function<double(double)>& error) {
  std::vector<ErrorLevel> made;
  for (const double h : {0.05, 0.04, 0.02, 0.013, 0.004, 0.002, 0.0008})
    made.push_back({{h, error(h), 0.0}});
  return made;
}

// Rates 2 in the coarse levels, then `order` below step `from`.
std::function<double(double)> breaks(double from, double order) {
  return [=](double h) { return h > from ? h * h : from * from * pow(h / from, order); };
}

// As measured of kr-alpha on two pendula.
constexpr double kr_alpha[] = {
    0.964,   0.967,   0.958,   0.976,   0.97,    1.01,    0.981,   1.01,    0.98,    0.873,
    0.892,   0.84,    0.758,   0.665,   0.596,   0.575,   0.477,   0.405,   0.358,   0.323,
    0.263,   0.241,   0.193,   0.176,   0.156,   0.121,   0.11,    0.105,   0.0872,  0.0732,
    0.0624,  0.0569,  0.0523,  0.0417,  0.0358,  0.0322,  0.0279,  0.0247,  0.0238,  0.02,
    0.0183,  0.0163,  0.0143,  0.0133,  0.0116,  0.0101,  0.00929, 0.00814, 0.00756, 0.00673,
    0.00613, 0.00551, 0.00497, 0.00451, 0.00405, 0.00378, 0.00338, 0.00307, 0.0028,  0.00253,
    0.00233, 0.0021,  0.00191, 0.00175};

// clang-format off
const VerdictSequence smooth_rows[] = {
    {.name = "order two at every step is proper",
     .make = [] { return ladder([](double h) { return 3.0 * h * h; }); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 1e-9},
    {.name = "a bump before the asymptotic range stays outside the window",
     .make = [] {
       return ladder([](double h) {
         const double away = log(h / 0.03) / 0.4;
         return h * h * (1.0 + 30.0 * exp(-away * away));
       });
     },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 0.02},
    {.name = "a term of order one under one of order two ends as order one",
     .make = [] { return ladder([](double h) { return 1e-2 * h + h * h; }); },
     .claim = claims(2), .behaviour = reduced, .verdict = Verdict::disagrees, .order = 1.0,
     .within = 0.15},
    {.name = "a term of order one that only begins to show is no longer order two",
     .make = [] { return ladder([](double h) { return 1e-3 * h + h * h; }); },
     .claim = claims(2), .behaviour = reduced, .verdict = Verdict::disagrees, .order = 1.45,
     .within = 0.1},
    {.name = "order one behind order two and errors as large as the motion is no floor yet",
     .make = [] {
       int i = 0;
       return ladder([=](double) mutable { return kr_alpha[i++]; }, {.coarsest = 0.15});
     },
     .claim = claims(1), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "no-convergence-yet"},
    {.name = "leading terms that cancel at a coarse step leave order two",
     .make = [] { return ladder([](double h) { return abs(h * h - 30.0 * h * h * h); }); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 0.06},
    {.name = "an error that passes through zero leaves four octaves of order two below it",
     .make = [] { return ladder([](double h) { return abs(h * h - h * h * h / 0.004); }); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees,
     .reason = "errors-cancel", .order = 2.0, .within = 0.06},
    {.name = "an error that passes through zero at the finest steps is not a higher order",
     .make = [] { return ladder([](double h) { return abs(h * h - 4e-4 * h); }); },
     .claim = claims(4), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "errors-cancel"},
    {.name = "order four where two is claimed is better than claimed and disagrees",
     .make = [] { return ladder([](double h) { return pow(h, 4); }, {.levels = 6}); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::disagrees, .order = 4.0,
     .within = 0.01},
    {.name = "order four in the coarse levels and two in the fine ones is order two",
     .make = [] { return ladder([](double h) { return h * h + 4e3 * pow(h, 4); }); },
     .claim = claims(4), .behaviour = reduced, .verdict = Verdict::disagrees, .order = 2.0,
     .within = 0.1},
    {.name = "a fractional order is reduced where two is claimed",
     .make = [] { return ladder([](double h) { return pow(h, 1.5); }); },
     .claim = claims(2), .behaviour = reduced, .verdict = Verdict::disagrees, .order = 1.5,
     .within = 1e-9},
    {.name = "a fractional order agrees where it is claimed as reduced",
     .make = [] { return ladder([](double h) { return pow(h, 1.5); }); },
     .claim = {reduced, 1.5, ""}, .behaviour = reduced, .verdict = Verdict::agrees, .order = 1.5,
     .within = 1e-9},
    {.name = "a slope of one point nine is within a tenth of two",
     .make = [] { return ladder([](double h) { return pow(h, 1.9); }); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 1.9,
     .within = 1e-9},
    {.name = "a slope of one point seven five is beyond a tenth of two",
     .make = [] { return ladder([](double h) { return pow(h, 1.75); }); },
     .claim = claims(2), .behaviour = reduced, .verdict = Verdict::disagrees, .order = 1.75,
     .within = 1e-9},
    {.name = "order one half is reduced",
     .make = [] { return ladder([](double h) { return 0.3 * std::sqrt(h); }); },
     .claim = claims(1), .behaviour = reduced, .verdict = Verdict::disagrees, .order = 0.5,
     .within = 1e-9},
    {.name = "h times its logarithm is on the way to order one and not order zero point eight",
     .make = [] { return ladder([](double h) { return h * abs(log(h)); }); },
     .claim = claims(1), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "no-convergence-yet"},
    {.name = "an error that falls exponentially has no order",
     .make = [] { return ladder([](double h) { return exp(-0.004 / h); }); },
     .claim = claims(2), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "no-fixed-order"},
    {.name = "an order that breaks down below a step is reduced",
     .make = [] { return ladder(breaks(0.0124, 1.0)); },
     .claim = claims(2), .behaviour = reduced, .verdict = Verdict::disagrees, .order = 1.0,
     .within = 0.02},
    {.name = "an order that breaks down in the last two levels is no longer proper",
     .make = [] { return ladder(breaks(0.0008, 1.0)); },
     .claim = claims(2), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "no-convergence-yet"},
    {.name = "uneven ratios of the steps do not change the order",
     .make = [] { return uneven([](double h) { return 3.0 * h * h; }); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 1e-9},
    {.name = "uneven ratios do not make two of order one",
     .make = [] { return uneven([](double h) { return 3.0 * h; }); },
     .claim = claims(2), .behaviour = reduced, .verdict = Verdict::disagrees, .order = 1.0,
     .within = 1e-9},
    {.name = "two levels are too few",
     .make = [] { return ladder([](double h) { return h * h; }, {.levels = 2}); },
     .claim = claims(2), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "too-few-levels"},
    {.name = "three levels are too few",
     .make = [] { return ladder([](double h) { return h * h; }, {.levels = 3}); },
     .claim = claims(2), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "too-few-levels"},
    {.name = "four levels are enough",
     .make = [] { return ladder([](double h) { return h * h; }, {.levels = 4}); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 1e-9},
    {.name = "errors as large as the motion at coarse steps stay outside the window",
     .make = [] { return ladder([](double h) { return 1.9 * std::tanh(500.0 * h * h); }); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 0.03},
    {.name = "errors as large as the motion at every step decide nothing",
     .make = [] { return ladder([](double h) { return 1.9 + h; }); },
     .claim = claims(2), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "larger-than-motion"},
    {.name = "an order that rises from one to two once a stiff mode is resolved is two",
     .make = [] { return ladder([](double h) { return h * h / (1.0 + 20.0 * h); }); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 0.06},
    {.name = "a level of errors four times too large in the middle leaves too few behind it",
     .make = [] {
       auto made = ladder([](double h) { return h * h; });
       for (auto& point : made[5]) point.error *= 4.0;
       return made;
     },
     .claim = claims(2), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "too-few-levels"},
    {.name = "order one where one and a half is claimed as reduced is lower than claimed",
     .make = [] { return ladder([](double h) { return h; }); },
     .claim = {reduced, 1.5, ""}, .behaviour = reduced, .verdict = Verdict::disagrees, .order = 1.0,
     .within = 1e-9},
    {.name = "a line of order one point two is within a quarter of an envelope of order one",
     .make = [] { return ladder([](double h) { return pow(h, 1.2); }); },
     .claim = claims_envelope(1), .behaviour = proper, .verdict = Verdict::agrees, .order = 1.2,
     .within = 1e-9},
    {.name = "a line of order one point three is beyond a quarter of an envelope of order one",
     .make = [] { return ladder([](double h) { return pow(h, 1.3); }); },
     .claim = claims_envelope(1), .behaviour = proper, .verdict = Verdict::disagrees, .order = 1.3,
     .within = 1e-9},
    {.name = "rates that settle at order one with one step a level contradict order two",
     .make = [] {
       return ladder([](double h) { return h + 6.0 * h * h; }, {.levels = 6, .samples = 1});
     },
     .claim = claims(2), .behaviour = reduced, .verdict = Verdict::disagrees, .order = 1.0,
     .within = 0.1},
};
// clang-format on

INSTANTIATE_TEST_SUITE_P(Smooth, VerdictSequences, testing::ValuesIn(smooth_rows), name_of_row);

}  // namespace
}  // namespace clackers::judge
