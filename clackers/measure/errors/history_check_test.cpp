#include "clackers/measure/errors/comparison.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "clackers/base/constants.hpp"
#include "clackers/measure/testing/toy_motion.hpp"

namespace clackers::measure {
namespace {

struct Refusal {
  const char* code;
  const char* words;  // somewhere in the message
  std::function<void(model::Trajectory&)> spoil;
};

const std::vector<Refusal> refusals = {
    {"wrong-size", "masses = 1", [](auto& h) { h.dof = 1; }},
    {"wrong-size", "entries of u = 9", [](auto& h) { h.u.pop_back(); }},
    {"wrong-size", "entries of v = 9", [](auto& h) { h.v.pop_back(); }},
    {"wrong-size", "entries of a = 9", [](auto& h) { h.a.pop_back(); }},
    {"not-a-number", "t in row 2", [](auto& h) { h.t[1] = nan; }},
    {"not-a-number", "u2 in row 3", [](auto& h) { h.u[5] = nan; }},
    {"not-finite", "v1 in row 2", [](auto& h) { h.v[2] = infinity; }},
    {"not-a-number", "a1 in row 1", [](auto& h) { h.a[0] = nan; }},
    {"time-outside", "t in row 5 = 4.5", [](auto& h) { h.t[4] = 4.5; }},
    {"time-outside", "t in row 1 = -0.1", [](auto& h) { h.t[0] = -0.1; }},
    {"not-sorted", "t in row 3 = 0.5", [](auto& h) { h.t[2] = 0.5; }},
    {"three-limits", "t in row 5 = 2", [](auto& h) { h.t[4] = 2.0; }},
    {"wrong-size", "of impact 1",
     [](auto& h) {
       h.impacts = {{1.0, 0, {1.0}, {}, {}, nan}};
     }},
    {"wrong-size", "of impact 1",
     [](auto& h) {
       h.impacts = {{1.0, 0, {}, {1.0}, {}, nan}};
     }},
    {"wrong-size", "of impact 1",
     [](auto& h) {
       h.impacts = {{1.0, 0, {}, {}, {1.0}, nan}};
     }},
    {"out-of-range", "contact of impact 1",
     [](auto& h) {
       h.impacts = {{1.0, 1, {}, {}, {}, nan}};
     }},
    {"not-a-number", "t of impact 1",
     [](auto& h) {
       h.impacts = {{nan, 0, {}, {}, {}, nan}};
     }},
};

TEST(HistoryCheck, RefusesInWordsWhatCannotBeCompared) {
  const ToyMotion reference(4.0);
  const auto problem = toy_problem(4.0);
  const auto sound = history_of(reference, {0.0, 1.0, 2.0, 2.0, 4.0});
  EXPECT_NO_THROW(require_comparable(sound, reference, problem));
  for (const auto& refusal : refusals) {
    auto history = sound;
    refusal.spoil(history);
    try {
      require_comparable(history, reference, problem);
      ADD_FAILURE() << "accepted: " << refusal.words;
    } catch (const InputError& error) {
      EXPECT_EQ(error.code().name(), refusal.code) << error.what();
      EXPECT_NE(std::string(error.what()).find(refusal.words), std::string::npos) << error.what();
    }
  }
}

TEST(HistoryCheck, AsksForTwoDifferentTimes) {
  const ToyMotion reference(4.0);
  const auto problem = toy_problem(4.0);
  for (const auto& times : {std::vector<double>{}, {1.0}, {1.0, 1.0}}) {
    try {
      require_comparable(history_of(reference, times), reference, problem);
      ADD_FAILURE() << times.size();
    } catch (const InputError& error) {
      EXPECT_EQ(error.code().name(), "too-short") << error.what();
    }
  }
}

TEST(HistoryCheck, LetsVelocitiesAndAccelerationsBeMissing) {
  const ToyMotion reference(4.0);
  auto history = history_of(reference, {0.0, 4.0});
  history.v.clear();
  history.a.clear();
  history.impacts.reset();
  EXPECT_NO_THROW(require_comparable(history, reference, toy_problem(4.0)));
}

TEST(HistoryCheck, LetsTheLastTimePassTheEndByARounding) {
  const ToyMotion reference(4.0);
  auto history = history_of(reference, {0.0, 4.0});
  history.t.back() = 4.0 * (1.0 + 0x1p-50);
  EXPECT_NO_THROW(require_comparable(history, reference, toy_problem(4.0)));
  history.t.back() = 4.0 * (1.0 + 0x1p-49);
  EXPECT_THROW(require_comparable(history, reference, toy_problem(4.0)), InputError);
}

TEST(HistoryCheck, RefusesAProblemOfAnotherSize) {
  const ToyMotion reference(4.0);
  auto problem = toy_problem(4.0);
  problem.system.mass = Eigen::MatrixXd::Identity(3, 3);
  EXPECT_THROW(require_comparable(history_of(reference, {0.0, 4.0}), reference, problem),
               InputError);
}

}  // namespace
}  // namespace clackers::measure
