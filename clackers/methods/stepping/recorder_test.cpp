#include "clackers/methods/stepping/recorder.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "clackers/model/trajectory.hpp"

namespace clackers::methods {
namespace {

model::State<1> state(double t, double u = 1.0) {
  return {t, model::Vector<1>(u), model::Vector<1>(-u)};
}

// Writes down what came: the sizes of blocks, and 0 for an impact.
struct Log : model::Sink {
  std::vector<std::size_t> calls;
  std::size_t allowed = 1000000;
  double last = -1.0;
  bool take(const model::SampleBlock& block) override {
    calls.push_back(block.t.size());
    last = block.t.back();
    return calls.size() < allowed;
  }
  bool take(const model::ReportedImpact& impact) override {
    EXPECT_LE(last, impact.t);
    calls.push_back(0);
    return calls.size() < allowed;
  }
};

TEST(Recorder, SendsBlocksAndTheRestAtTheEnd) {
  Recorder<1> recorder(1);
  Log log;
  recorder.begin(log);
  for (int i = 0; i < 600; ++i) ASSERT_TRUE(recorder.append(state(i)));
  model::Work work;
  work.steps = 599;
  const auto outcome = recorder.finish(work);
  EXPECT_EQ(log.calls, (std::vector<std::size_t>{256, 256, 88}));
  EXPECT_TRUE(outcome.finished);
  EXPECT_FALSE(outcome.failed());
  EXPECT_EQ(outcome.work.steps, 599);
}

TEST(Recorder, SendsAllStatesBeforeAnImpactFirst) {
  Recorder<1> recorder(1);
  Log log;
  recorder.begin(log);
  for (int i = 0; i < 3; ++i) recorder.append(state(i));
  ASSERT_TRUE(recorder.impact(state(2.5), 0, model::Vector<1>(-1.0), 2.0));
  recorder.append(state(3));
  recorder.finish({});
  EXPECT_EQ(log.calls, (std::vector<std::size_t>{3, 0, 1}));
}

TEST(Recorder, EndsWhereTheSinkSaysSo) {
  for (const std::size_t allowed : {std::size_t{1}, std::size_t{2}}) {
    Recorder<1> recorder(1);
    Log log;
    log.allowed = allowed;
    recorder.begin(log);
    recorder.append(state(0));
    EXPECT_FALSE(recorder.impact(state(0.5), 0, model::Vector<1>(1.0), 1.0));
    EXPECT_FALSE(recorder.fail("diverged", 1.0, "not this"));
    const auto outcome = recorder.finish({});
    EXPECT_EQ(log.calls.size(), allowed);
    EXPECT_FALSE(outcome.finished);
    EXPECT_TRUE(outcome.stopped_by_sink);
    EXPECT_FALSE(outcome.failed());
    EXPECT_TRUE(outcome.detail.empty());
  }
}

TEST(Recorder, EndsAsDivergedAtTheFirstStateThatIsNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Recorder<1> recorder(1);
    model::TrajectorySink sink(true);
    recorder.begin(sink);
    for (int i = 0; i < 300; ++i)
      if (!recorder.append(state(i, i < 40 ? 1.0 : bad))) break;
    const auto outcome = recorder.finish({});
    EXPECT_TRUE(outcome.failed());
    EXPECT_EQ(outcome.reason, Code("diverged"));
    EXPECT_EQ(outcome.detail, "t = 40 s: the motion is no longer finite");
    EXPECT_EQ(sink.trajectory().t.size(), 40u);
  }
}

TEST(Recorder, StartsANewRunAfresh) {
  Recorder<model::any_dof> recorder(3);
  Log log;
  recorder.begin(log);
  recorder.append({0.0, Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(4, 5, 6)});
  recorder.fail("newton-failed", 1.0, "x");
  EXPECT_TRUE(recorder.finish({}).failed());
  model::TrajectorySink sink(true);
  recorder.begin(sink);
  recorder.append({0.5, Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(4, 5, 6)});
  EXPECT_FALSE(recorder.finish({}).failed());
  EXPECT_EQ(sink.trajectory().dof, 3);
  EXPECT_EQ(sink.trajectory().u, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(sink.trajectory().v, (std::vector<double>{4, 5, 6}));
}

}  // namespace
}  // namespace clackers::methods
