// The error of every compliant law's model against rigid impacts: how it falls with the stiffness.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "clackers/assess/errors/error_sink.hpp"
#include "clackers/cases/case.hpp"
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

  // With 60 steps a contact it is that of the model.
  static double error_of(double stiffness, double eta) {
    const auto which = cases::make("stop", {{"eta", eta}});
    const auto method = methods::method(specification(stiffness));
    const double steps =
        std::round(60.0 * which.problem.end / method->contact_time(which.problem) + 0.37);
    const double h = which.problem.end / steps;
    assess::ErrorSink sink(*which.motion, which.problem, h);
    const auto outcome = method->prepare(which.problem, h)->advance(sink);
    EXPECT_TRUE(outcome.finished) << outcome.detail;
    return sink.score(outcome).u_error;
  }

  static double observed_order(double eta) {
    constexpr double soft = 1e5, ratio = 64.0;
    return std::log(error_of(soft, eta) / error_of(ratio * soft, eta)) / std::log(ratio);
  }
};

TEST_P(LawOrder, OfElasticImpactsIsThatOfTheFacts) {
  const double claimed = methods::method(specification(1e5))->facts().model_order;
  EXPECT_NEAR(observed_order(1.0), claimed, 0.05 * claimed);
}

TEST_P(LawOrder, OfOtherImpactsIsTheSameWhereTheReboundIsExactAndOtherwiseNone) {
  if (!GetParam().models(0.7)) return;
  const double claimed = GetParam().restitution_is_exact
                             ? methods::method(specification(1e5))->facts().model_order
                             : 0.0;
  EXPECT_NEAR(observed_order(0.7), claimed, 0.05);
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
