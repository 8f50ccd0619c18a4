#include <cmath>

#include "clackers/judge/testing/verdict_sequence.hpp"

namespace clackers::judge {
namespace {

using namespace synthetic;
using enum Behaviour;
using std::pow;

// Order `order` on the average, in stairs of ratio `ratio`.
double stairs(double h, double order, double ratio) {
  return pow(0.05 * pow(ratio, -std::floor(std::log(0.0500001 / h) / std::log(ratio))), order);
}

std::vector<ErrorLevel> scattered(double order, double factor, unsigned seed,
                                  const Shape& shape = {}) {
  Scatter scatter(factor, seed);
  return ladder([=](double h) mutable { return 2.0 * pow(h, order) / scatter(); }, shape);
}

// Eight levels, of which the coarsest two scatter by ten and the next three by `factor`; the last are
// rounding.
std::vector<ErrorLevel> of_order_six(double factor) {
  Scatter rough(10.0, 7), fine(factor, 3);
  return ladder(
      [=](double h) mutable {
        const double scatter = h > 0.0251 ? 10.0 / rough() : 1.0 / fine();
        return std::max(2e4 * pow(h, 6.0) * scatter, 1e-14 / h);
      },
      {.coarsest = 0.1});
}

std::vector<ErrorLevel> with_one_factor(double factor) {
  auto made = ladder([](double h) { return h * h; });
  made[5][4].error *= factor;
  return made;
}

// Four levels whose largest errors lie a factor e^0.2 above, below, below and above order one: the
// slope is 1 and its spread 0.78.
std::vector<ErrorLevel> uncertain() {
  auto made = ladder([](double h) { return h; }, {.levels = 4});
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 8; ++j)
      made[i][j].error = made[i][0].step * std::exp(i % 3 == 0 ? 0.2 : -0.2) /
                         (j == 0       ? 1.0
                          : j % 2 == 0 ? 3.0
                                       : 10.0);
  return made;
}

// clang-format off
const VerdictSequence scatter_rows[] = {
    {.name = "scatter by ten under an envelope of order one agrees with such a claim",
     .make = [] { return scattered(1.0, 10.0, 5); },
     .claim = claims_envelope(1), .behaviour = irregular, .verdict = Verdict::agrees, .order = 1.0,
     .within = 0.3},
    {.name = "scatter by ten under an envelope of order one is not order two",
     .make = [] { return scattered(1.0, 10.0, 5); },
     .claim = claims(2), .behaviour = irregular, .verdict = Verdict::disagrees, .order = 1.0,
     .within = 0.3},
    {.name = "scatter by thirty on top of order two is not an envelope of order one",
     .make = [] { return scattered(2.0, 30.0, 6); },
     .claim = claims_envelope(1), .behaviour = irregular, .verdict = Verdict::disagrees,
     .order = 2.0, .within = 0.4},
    {.name = "scatter by thirty on top of order two is no line of order two",
     .make = [] { return scattered(2.0, 30.0, 7); },
     .claim = claims(2), .behaviour = irregular, .verdict = Verdict::disagrees, .order = 2.0,
     .within = 0.4},
    {.name = "twelve errors that scatter by ten at one sample a level leave the order open",
     .make = [] { return scattered(1.0, 10.0, 5, {.levels = 12, .samples = 1}); },
     .claim = claims(2), .reason = "one-sample-a-level"},
    {.name = "four rough levels whose largest errors go up and down leave the order open",
     .make = [] { return uncertain(); },
     .claim = claims_envelope(1), .behaviour = irregular, .verdict = Verdict::undecided,
     .order = 1.0, .within = 1.0},
    {.name = "errors that go up and down between neighbouring steps are irregular",
     .make = [] {
       int i = 0;
       return ladder([=](double h) mutable { return ++i % 2 == 0 ? h : 0.3 * h; });
     },
     .claim = claims(1), .behaviour = irregular, .verdict = Verdict::disagrees, .order = 1.0,
     .within = 0.05},
    {.name = "three levels of order six between rough ones and rounding are proper",
     .make = [] { return of_order_six(1.0); },
     .claim = claims(6), .behaviour = proper, .verdict = Verdict::agrees, .order = 6.0,
     .within = 0.3},
    {.name = "three levels of another order than claimed are no line of it",
     .make = [] { return of_order_six(1.0); },
     .claim = claims(5), .behaviour = irregular, .verdict = Verdict::disagrees, .order = 6.8,
     .within = 0.3},
    {.name = "three levels of order six that scatter by four as the others do are irregular",
     .make = [] { return of_order_six(4.0); },
     .claim = claims(6), .behaviour = irregular, .verdict = Verdict::disagrees, .order = 7.0,
     .within = 1.0},
    {.name = "scatter by a tenth is still a line",
     .make = [] { return scattered(2.0, 1.2, 8); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 0.05},
    {.name = "a swing with one period a level is irregular although all levels lie on a line",
     .make = [] { return ladder([](double h) { return h * h * swing(h, 3.0, 1.0); }); },
     .claim = claims(2), .behaviour = irregular, .verdict = Verdict::disagrees, .order = 2.0,
     .within = 0.1},
    {.name = "a swing with a period of three levels is irregular",
     .make = [] { return ladder([](double h) { return h * h * swing(h, 2.0, 3.0); }); },
     .claim = claims(2), .behaviour = irregular, .verdict = Verdict::disagrees, .order = 2.0,
     .within = 0.3},
    {.name = "a swing by a tenth is still a line",
     .make = [] { return ladder([](double h) { return h * h * swing(h, 1.03, 1.0); }); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 0.05},
    {.name = "stairs as wide as a level are irregular",
     .make = [] { return ladder([](double h) { return stairs(h, 2.0, 2.0); }); },
     .claim = claims(2), .behaviour = irregular, .verdict = Verdict::disagrees, .order = 2.0,
     .within = 0.1},
    {.name = "stairs as wide as two levels are irregular",
     .make = [] { return ladder([](double h) { return stairs(h, 1.0, 4.0); }); },
     .claim = claims(1), .behaviour = irregular, .verdict = Verdict::disagrees, .order = 1.0,
     .within = 0.3},
    {.name = "one error far above a line of sixty four is not passed over",
     .make = [] { return with_one_factor(3.0); },
     .claim = claims(2), .behaviour = irregular, .verdict = Verdict::disagrees, .order = 2.0,
     .within = 0.1},
    {.name = "one error far below a line of sixty four is left out",
     .make = [] { return with_one_factor(1e-5); },
     .claim = claims(2), .behaviour = proper, .verdict = Verdict::agrees, .order = 2.0,
     .within = 0.01},
    {.name = "scatter around a constant is a floor",
     .make = [] {
       Scatter scatter(2.0, 9);
       return ladder([=](double) mutable { return 1e-3 * scatter(); });
     },
     .claim = claims(1), .behaviour = stagnating, .verdict = Verdict::disagrees,
     .reason = "noise-floor"},
    {.name = "rough errors as large as the motion stay outside the envelope",
     .make = [] {
       Scatter coarse(1.2, 1), fine(10.0, 2);
       return ladder(
           [=](double h) mutable { return h > 0.0065 ? 1.2 * coarse() : 50.0 * h / fine(); });
     },
     .claim = claims_envelope(1), .behaviour = irregular, .verdict = Verdict::agrees, .order = 1.0,
     .within = 0.25},
    {.name = "impacts noticed at the end of a step are irregular of order one",
     .make = [] { return ladder([](double h) { return late_impacts(h, 6); }); },
     .claim = claims_envelope(1), .behaviour = irregular, .verdict = Verdict::agrees, .order = 1.0,
     .within = 0.25},
    {.name = "a step that divides the time of an impact errs less than its neighbours",
     .make = [] { return ladder([](double h) { return late_impacts(h, 1, 1.6); }); },
     .claim = claims(2), .behaviour = irregular, .verdict = Verdict::disagrees, .order = 1.0,
     .within = 0.25},
    {.name = "late impacts seen at one step a level make noise of the rates",
     .make = [] { return ladder([](double h) { return late_impacts(h, 6); }, single); },
     .claim = claims(1), .behaviour = undecided, .verdict = Verdict::undecided,
     .reason = "one-sample-a-level"},
    {.name = "scatter by ten whose envelope grows diverges",
     .make = [] { return scattered(-1.0, 10.0, 12, {.coarsest = 0.5}); },
     .claim = claims_envelope(1), .behaviour = divergent, .verdict = Verdict::disagrees,
     .reason = "error-growth"},
    {.name = "rough errors of two steps a level still have an envelope",
     .make = [] { return scattered(1.0, 6.0, 13, {.samples = 2}); },
     .claim = claims_envelope(1), .behaviour = irregular, .verdict = Verdict::agrees, .order = 1.0,
     .within = 0.3},
};
// clang-format on

INSTANTIATE_TEST_SUITE_P(Scatter, VerdictSequences, testing::ValuesIn(scatter_rows), name_of_row);

}  // namespace
}  // namespace clackers::judge
