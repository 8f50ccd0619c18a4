#include "clackers/methods/stepping/time_loop.hpp"

#include "clackers/methods/testing/stepper_checks.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers::methods {
namespace {

using State = model::State<1>;

// A treatment that does something at given steps.
struct Scripted {
  std::unique_ptr<AnyStepper<1>> own;
  std::vector<double> times;  ///< ends of the steps with an event
  Handled answer = Handled::unchanged;
  int handled = 0;

  AnyStepper<1>& stepper() { return *own; }
  bool is_open() const { return false; }
  bool is_quiet(const State&, const State& now) const {
    for (const double t : times)
      if (now.t == t) return false;
    return true;
  }
  Handled handle(const State& before, State& now, Recorder<1>&) {
    ++handled;
    // The stepper is at `before`.
    const State again = own->partial(before, now.t - before.t);
    EXPECT_NEAR(again.u[0], now.u[0], 1e-14);
    if (answer == Handled::changed) {
      now.v = -now.v;
      own->restart(now);
    }
    return answer;
  }
};

struct Run {
  model::Trajectory path;
  model::Work work;
  long long steps;
  int handled;
};

Run run(double end, std::vector<double> times, Handled answer, model::Sink* other = nullptr) {
  const auto system = checks::oscillator();
  const auto plan = plan_steps("who", 0.0, end, 0.01);
  Scripted treatment{integrator("newmark")->stepper(system, plan), std::move(times), answer};
  treatment.own->reset();
  model::TrajectorySink sink(true);
  Recorder<1> recorder(1);
  recorder.begin(other != nullptr ? *other : sink);
  const auto start = checks::displaced();
  treatment.own->restart(start);
  TimeLoop<1> loop(plan, {system, {}, start});
  const auto steps = loop.run(treatment, start, recorder);
  model::Work work;
  treatment.own->add_work(work);
  recorder.finish(work);
  return {sink.trajectory(), work, steps, treatment.handled};
}

TEST(TimeLoop, MakesTheSameStepsInBlocksAsOneByOne) {
  const auto found = run(10.0, {}, Handled::unchanged);
  EXPECT_EQ(found.steps, 1000);
  EXPECT_EQ(found.work.force_evaluations, 1001);
  const auto system = checks::oscillator();
  auto now = checks::displaced();
  checks::SingleSteps<1> stepper("newmark", system, 0.01, now);
  ASSERT_EQ(found.path.t.size(), 1001u);
  for (std::size_t i = 1; i <= 1000; ++i) {
    stepper.step(now);
    EXPECT_EQ(found.path.u[i], now.u[0]);
  }
}

TEST(TimeLoop, EndsWithAShorterStep) {
  const auto found = run(1.005, {}, Handled::unchanged);
  EXPECT_EQ(found.steps, 101);
  EXPECT_EQ(found.path.t.back(), 1.005);
  EXPECT_NEAR(found.path.u.back(), std::cos(1.005), 1e-5);  // t h²/24
  EXPECT_EQ(run(1.005, {1.005}, Handled::changed).handled, 1);
}

// Near each other, and more than a block apart.
const std::vector<double> events{3 * 0.01, 4 * 0.01, 90 * 0.01, 400 * 0.01};

TEST(TimeLoop, GoesOnAsBeforeWhereNothingIsChanged) {
  const auto quiet = run(10.0, {}, Handled::unchanged);
  const auto found = run(10.0, events, Handled::unchanged);
  EXPECT_EQ(found.handled, 4);
  EXPECT_EQ(found.path.u, quiet.path.u);
  EXPECT_EQ(found.path.v, quiet.path.v);
  // An event: the step seen, a partial step, the step again. What blocks make beyond is not counted.
  EXPECT_EQ(found.work.force_evaluations, quiet.work.force_evaluations + 4 * 2);
}

TEST(TimeLoop, GoesOnFromAChangedState) {
  const auto found = run(10.0, events, Handled::changed);
  const auto system = checks::oscillator();
  auto now = checks::displaced();
  checks::SingleSteps<1> stepper("newmark", system, 0.01, now);
  for (std::size_t i = 1; i <= 1000; ++i) {
    stepper.step(now);
    if (i == 3 || i == 4 || i == 90 || i == 400) {
      now.v = -now.v;
      stepper->restart(now);
    }
    ASSERT_EQ(found.path.u[i], now.u[0]) << i;
  }
  EXPECT_EQ(found.work.force_evaluations, 1001 + 4 * 2);  // a partial step and a restart
}

TEST(TimeLoop, StopsWhereTheTreatmentEndsTheRun) {
  const auto found = run(10.0, {90 * 0.01}, Handled::ended);
  EXPECT_EQ(found.steps, 89);
  EXPECT_EQ(found.path.t.size(), 90u);
}

TEST(TimeLoop, CountsWhatASinkHasSeenThatStopsTheRun) {
  struct Stop : model::Sink {
    bool take(const model::SampleBlock&) override { return false; }
    bool take(const model::ReportedImpact&) override { return true; }
  } stop;
  const auto found = run(10.0, {}, Handled::unchanged, &stop);
  EXPECT_EQ(found.steps, static_cast<long long>(Recorder<1>::block) - 1);
  EXPECT_EQ(found.work.force_evaluations, found.steps + 1);
}

}  // namespace
}  // namespace clackers::methods
