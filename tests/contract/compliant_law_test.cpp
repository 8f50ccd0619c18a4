// The error of every compliant law's model against rigid impacts: how it falls with the stiffness.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "clackers/cases/case.hpp"
#include "clackers/measure/errors/error_sink.hpp"
#include "clackers/methods/contact/compliant_law.hpp"
#include "clackers/methods/registry.hpp"

namespace clackers {
namespace {

class LawOrder : public testing::TestWithParam<methods::CompliantLaw> {
 protected:
  static std::string specification(double stiffness) {
    return "newmark+penalty:law=" + std::string(GetParam().name) +
           ",stiffness=" + std::to_string(stiffness);
  }

  // Two impacts; with so many steps a contact the error is that of the model.
  static double error_of(double stiffness, double eta, double steps_per_contact) {
    const auto test_case = cases::make("stop", {{"eta", eta}, {"t_end", 5.0}});
    const auto method = methods::method(specification(stiffness));
    const double steps = std::round(
        steps_per_contact * test_case.problem.end / method->contact_time(test_case.problem) + 0.37);
    const double h = test_case.problem.end / steps;
    measure::ErrorSink sink(*test_case.motion, test_case.problem, h);
    const auto outcome = method->prepare(test_case.problem, h)->advance(sink);
    EXPECT_TRUE(outcome.finished) << outcome.detail;
    EXPECT_EQ(sink.score(outcome).impacts->matched, 2);
    return sink.score(outcome).u_error;
  }

  static double observed_order(double soft, double eta, double steps_per_contact) {
    constexpr double ratio = 64.0;
    return std::log(error_of(soft, eta, steps_per_contact) /
                    error_of(ratio * soft, eta, steps_per_contact)) /
           std::log(ratio);
  }

  static double claimed() { return methods::method(specification(1.0))->facts().model_order; }
};

TEST_P(LawOrder, OfElasticImpactsIsThatOfTheFacts) {
  EXPECT_NEAR(observed_order(1e5, 1.0, 60), claimed(), 0.05 * claimed());
}

TEST_P(LawOrder, OfOtherImpactsIsTheSameWhereTheReboundIsExactAndElseTheLimitIsAnotherMotion) {
  if (!GetParam().models(0.5)) return;
  // A damper acts at once, so the error of a step at a touch is of first order.
  if (GetParam().restitution_is_exact)
    EXPECT_NEAR(observed_order(1e3, 0.5, 400), claimed(), 0.05 * claimed());
  else
    EXPECT_LT(observed_order(1e7, 0.5, 60), 0.5 * claimed());
}

INSTANTIATE_TEST_SUITE_P(Table, LawOrder,
                         testing::ValuesIn(methods::compliant_laws().begin(),
                                           methods::compliant_laws().end()),
                         [](const auto& row) {
                           std::string name(row.param.name);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace clackers
