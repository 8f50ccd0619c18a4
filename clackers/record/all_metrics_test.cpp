#include "clackers/record/all_metrics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "clackers/base/error.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/measure/metrics/metric.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/model/trajectory.hpp"
#include "clackers/tables/case_summary.hpp"

namespace clackers::record {
namespace {

// What a run of a method on a case shows.
struct Shown {
  std::vector<MetricResult> all;
  double value(std::string_view name) const { return row(name).value; }
  std::string reason(std::string_view name) const { return row(name).reason; }
  const MetricResult& row(std::string_view name) const {
    const auto found = std::ranges::find(all, name, &MetricResult::name);
    if (found == all.end()) throw std::out_of_range("no metric " + std::string(name));
    return *found;
  }
};

Shown shown(const char* method, const char* name, const cases::Settings& settings, double h) {
  const auto one = cases::make(name, settings);
  const auto made = methods::method(method);
  model::TrajectorySink sink(true);
  made->prepare(one.problem, h)->advance(sink);
  const auto contact_time = made->contact_time(one.problem);
  const measure::Comparison comparison(
      sink.trajectory(), *one.motion, one.problem,
      facts_of(tables::summary_of(one), one.problem, contact_time));
  return {*all_metrics(comparison)};
}

TEST(CauseMetrics, AreAllThereInTheirOrder) {
  const auto run = shown("rk4", "three-parameter", {}, 0.01);
  ASSERT_EQ(run.all.size(), measure::metrics().size());
  for (std::size_t i = 0; i < run.all.size(); ++i) {
    EXPECT_EQ(run.all[i].name, measure::metrics()[i].name);
    EXPECT_EQ(std::isnan(run.all[i].value), !run.all[i].reason.empty()) << run.all[i].name;
  }
}

TEST(CauseMetrics, ExplainALossOfSynchronyByTheMethodsFrequencies) {
  // Elastic, r > 1: a detuned frequency grows at every impact. 20 steps a fast period.
  const double h = 2.0 * std::numbers::pi / 9.0 / 20.0;
  const auto run = shown("newmark", "synchronized-pair",
                         {{"X", 9.0}, {"r", 3.0}, {"xi1", 0.0}, {"t_end", 700.0}}, h);
  // Average acceleration turns a mass by 2 atan(W/2) a step, W = omega h.
  const auto own = [&](double omega) { return 2.0 * std::atan(0.5 * omega * h) / (omega * h); };
  const double eps = own(9.0) / own(1.0) - 1.0;
  EXPECT_NEAR(run.value("detuning-fit"), eps, 0.05 * std::abs(eps));
  EXPECT_NEAR(run.value("detuning-share"), 1.0, 0.1);
  // Started from rest the first disturbance is smaller than eps, so the loss comes later.
  EXPECT_GT(run.value("synchrony-loss-index"), run.value("detuning-loss-index"));
  EXPECT_NEAR(run.value("detuning-loss-index"), 64.0, 6.0);
  EXPECT_NEAR(run.value("momentum-growth-fit"), 1.5 * std::numbers::pi * std::abs(eps),
              0.1 * run.value("momentum-growth-fit"));
}

TEST(CauseMetrics, SayWhereSynchronyIsKept) {
  const auto run = shown("rk4", "three-parameter", {}, 0.01);
  EXPECT_EQ(run.reason("synchrony-loss-index"), "Synchrony is kept over all 6 impacts.");
  EXPECT_EQ(run.reason("momentum-growth-fit"), run.reason("synchrony-loss-index"));
  const auto calm = shown("newmark", "synchronized-pair", {{"r", 0.5}}, 0.01);
  EXPECT_EQ(calm.reason("detuning-share"), "On this case no detuning grows.");
  const auto single = shown("newmark", "stop", {}, 0.01);
  EXPECT_EQ(single.reason("detuning-fit"), "There is no pair of masses.");
}

TEST(CauseMetrics, SeparateTheErrorOfASpringFromThatOfTheStep) {
  const auto coarse = shown("rk4+penalty", "three-parameter", {}, 0.001);
  const auto fine = shown("rk4+penalty", "three-parameter", {}, 0.00025);
  for (const auto& [model, integration] :
       {std::pair{"u-penalty-model-max-relative", "u-penalty-integration-max-relative"},
        {"v-penalty-model-l1-relative", "v-penalty-integration-l1-relative"}}) {
    EXPECT_NEAR(fine.value(model), coarse.value(model), 1e-2 * fine.value(model));
    EXPECT_LT(fine.value(integration), coarse.value(integration) / 8.0);
    EXPECT_LT(fine.value(integration), 1e-3 * fine.value(model));
  }
  EXPECT_EQ(shown("rk4", "three-parameter", {}, 0.01).reason("u-penalty-model-max-relative"),
            "No contact spring of the run is known.");
}

TEST(CauseMetrics, TellWhyThePenalizedMotionIsNotKnown) {
  const auto pair = cases::make("three-parameter", {});
  auto problem = pair.problem;
  problem.contacts[0].restitution = 0.5;
  model::TrajectorySink sink(true);
  methods::method("rk4")->prepare(pair.problem, 0.01)->advance(sink);
  const measure::Comparison comparison(sink.trajectory(), *pair.motion, problem,
                                       facts_of(tables::summary_of(pair), problem, 0.01));
  const Shown run{*all_metrics(comparison)};
  const auto reason = run.reason("u-penalty-model-max-relative");
  EXPECT_NE(reason.find("restitution"), std::string::npos) << reason;
}

}  // namespace
}  // namespace clackers::record
