#include "clackers/measure/metrics/definitions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clackers/base/constants.hpp"
#include "clackers/measure/testing/toy_motion.hpp"

namespace clackers::measure {
namespace {

using std::numbers::pi;
const ToyMotion flight_reference(12.0);
const auto flight_problem = toy_problem(12.0);

// The reference up to its first impact, and from there 0.1 s late: rows 0 and 1 before, two at the
// impact, 5 and 6 in the flight after it, two at the next, 9 behind.
model::Trajectory late() {
  auto history = history_of(flight_reference,
                            {0.0, 1.0, pi / 2, pi / 2, 2.0, 4.0, 3 * pi / 2, 3 * pi / 2, 6.0});
  for (std::size_t i = 2; i < history.t.size(); ++i) history.t[i] += 0.1;
  history.impacts = {{history.t[2], 0, {}, {}, {}, nan}, {history.t[6], 0, {}, {}, {}, nan}};
  return history;
}

TEST(FlightError, VanishesWhereTheHistoryIsTheReferenceLate) {
  const auto history = late();
  const Comparison comparison(history, flight_reference, flight_problem);
  const auto flights = flight_errors(comparison);
  ASSERT_EQ(flights.size(), 3u);
  const long long after[] = {0, 1, 2};
  const double shift[] = {0.0, 0.1, 0.1};
  const std::size_t rows[] = {2, 4, 2};  // what closes flight 0 lies behind the true impact
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(flights[k].after, after[k]);
    EXPECT_NEAR(flights[k].shift, shift[k], 1e-15);
    EXPECT_EQ(flights[k].rows, rows[k]) << k;
    for (const double error : {flights[k].u[0], flights[k].u[1], flights[k].v[0], flights[k].v[1]})
      EXPECT_LE(error, 1e-14) << k;
  }
}

TEST(FlightError, IsTheLargestOfAFlight) {
  auto history = late();
  history.u[2 * 4 + 1] -= 0.03;
  history.v[2 * 5] += 0.2;
  history.v[2 * 3] += 0.1;
  const Comparison comparison(history, flight_reference, flight_problem);
  const auto flights = flight_errors(comparison);
  ASSERT_EQ(flights.size(), 3u);
  EXPECT_NEAR(flights[1].u[0], 0.0, 1e-14);
  EXPECT_NEAR(flights[1].u[1], 0.03, 1e-14);
  EXPECT_NEAR(flights[1].v[0], 0.2, 1e-14);
  EXPECT_NEAR(flight_u_error(comparison).value, 0.03, 1e-14);
  const auto v = flight_v_error(comparison);
  EXPECT_NEAR(v.masses[0], 0.2, 1e-14);
  EXPECT_NEAR(v.masses[1], 0.0, 1e-14);
}

TEST(FlightError, ComparesTheLimitsThatOpenAndCloseAFlight) {
  for (const std::size_t row : {3u, 6u, 7u}) {
    auto history = late();
    history.v[2 * row] += 0.5;
    EXPECT_NEAR(flight_v_error({history, flight_reference, flight_problem}).value, 0.5, 1e-14)
        << row;
  }
}

TEST(FlightError, LeavesOutRowsInWhichAContactIsClosed) {
  auto history = late();
  history.u[2 * 4] = history.u[2 * 4 + 1] - 1e-3;
  history.v[2 * 4] = -7.0;
  const Comparison comparison(history, flight_reference, flight_problem);
  EXPECT_LE(flight_v_error(comparison).value, 1e-14);
  EXPECT_EQ(flight_errors(comparison)[1].rows, 3u);
}

TEST(FlightError, LeavesOutARowAloneAtAnImpact) {
  auto history = history_of(flight_reference, {0.0, 1.0, pi / 2, 2.0, 4.0});
  history.v[4] = 3.0;
  history.impacts = {{history.t[2], 0, {}, {}, {}, nan}};
  EXPECT_LE(flight_v_error({history, flight_reference, flight_problem}).value, 1e-14);
}

TEST(FlightError, DoesNotCompareWhatFollowsAnExtraImpact) {
  auto history = late();
  history.impacts = {{history.t[2], 0, {}, {}, {}, nan}, {3.0, 0, {}, {}, {}, nan}};
  history.u[2 * 5] += 5.0;  // t = 4.1, after the extra one
  const Comparison comparison(history, flight_reference, flight_problem);
  const auto flights = flight_errors(comparison);
  ASSERT_EQ(flights.size(), 2u);
  EXPECT_EQ(flights[1].rows, 2u);
  EXPECT_LE(flight_u_error(comparison).value, 1e-14);
}

// A contact that lasts from 1.5 to 1.7: the flight starts when it is over.
TEST(FlightError, StartsWhenTheImpactIsOver) {
  auto history = late();
  history.impacts = {{history.t[2] - 0.05, 0, {}, {}, {}, nan}, {history.t[2], 0, {}, {}, {}, nan}};
  const Comparison comparison(history, flight_reference, flight_problem);
  ASSERT_EQ(comparison.impacts().size(), 1u);
  EXPECT_NEAR(flight_errors(comparison)[1].shift, 0.1, 1e-15);
}

TEST(FlightError, NeedsVelocitiesForThoseAlone) {
  auto history = late();
  history.v.clear();
  const Comparison comparison(history, flight_reference, flight_problem);
  EXPECT_LE(flight_u_error(comparison).value, 1e-14);
  EXPECT_EQ(flight_v_error(comparison).reason, "The history has no velocities.");
}

TEST(FlightError, OfAHistoryThatStartsLateBelongsToTheFlightItStartsIn) {
  const auto history = history_of(flight_reference, {2.0, 3.0, 4.0});
  const auto flights = flight_errors({history, flight_reference, flight_problem});
  ASSERT_EQ(flights.size(), 1u);
  EXPECT_EQ(flights[0].after, 1);
  EXPECT_EQ(flights[0].rows, 3u);
  EXPECT_LE(flights[0].v[0], 1e-15);
}

TEST(FlightError, TakesAFirstRowAtAnImpactForTheStartOfAFlight) {
  auto history = history_of(flight_reference, {pi / 2, 3.0});
  history.v[0] += 0.25;
  const auto flights = flight_errors({history, flight_reference, flight_problem});
  ASSERT_EQ(flights.size(), 1u);
  EXPECT_EQ(flights[0].rows, 2u);
  EXPECT_NEAR(flights[0].v[0], 0.25, 1e-15);
}

}  // namespace
}  // namespace clackers::measure
