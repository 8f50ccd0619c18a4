#include "clackers/tables/respond.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/exact/flights/piecewise_motion.hpp"
#include "clackers/model/problem_file.hpp"
#include "clackers/tables/case_summary.hpp"
#include "clackers/tables/testing/counted_motion.hpp"

namespace clackers::tables {
namespace {

const cases::CaseEntry toy_entry{"toy", "", "", {}};

cases::Case toy(int dof, double end, std::vector<double> impacts) {
  cases::Case test_case;
  test_case.entry = &toy_entry;
  test_case.motion = std::make_shared<CountedMotion>(dof, end, std::move(impacts));
  return test_case;
}

std::vector<std::vector<record::Cell>> all_rows(record::RowSource& rows) {
  std::vector<std::vector<record::Cell>> list;
  std::vector<record::Cell> row;
  while (rows.next(row)) list.push_back(row);
  return list;
}

std::vector<std::string> column_names(const record::RowSource& rows) {
  std::vector<std::string> list;
  for (const auto& column : rows.columns()) list.push_back(column.name);
  return list;
}

const record::Cell nothing{}, minus{std::string("-")}, plus{std::string("+")};

TEST(Respond, NamesItsColumnsByTheNumberOfMasses) {
  EXPECT_EQ(column_names(*respond(toy(1, 4.0, {}), grid_of(2, 4.0))),
            (std::vector<std::string>{"t", "side", "u1", "v1", "a1"}));
  const auto two = toy(2, 4.0, {});
  const auto rows = respond(two, grid_of(2, 4.0));
  EXPECT_EQ(column_names(*rows),
            (std::vector<std::string>{"t", "side", "u1", "v1", "a1", "u2", "v2", "a2"}));
  EXPECT_EQ(rows->schema(), "clackers/response/1");
  const std::vector<std::string> units{"s", "", "m", "m/s", "m/s^2", "m", "m/s", "m/s^2"};
  for (std::size_t i = 0; i < units.size(); ++i) EXPECT_EQ(rows->columns()[i].unit, units[i]);
}

TEST(Respond, ShowsBothSidesWhereATimeIsAnImpact) {
  const auto test_case = toy(2, 4.0, {1.0, 4.0});
  const auto list = all_rows(*respond(test_case, {1.0, 5, 0.0, {}}));
  const std::vector<std::vector<record::Cell>> expected{
      {0.0, nothing, 0.0, 1.0, 100.0, 0.0, 2.0, 200.0},
      {1.0, minus, 1.0, 1.0, 101.0, 2.0, 2.0, 201.0},
      {1.0, plus, 1.0, -1.0, 101.0, 2.0, -2.0, 201.0},
      {2.0, nothing, 2.0, -1.0, 102.0, 4.0, -2.0, 202.0},
      {3.0, nothing, 3.0, -1.0, 103.0, 6.0, -2.0, 203.0},
      {4.0, minus, 4.0, -1.0, 104.0, 8.0, -2.0, 204.0},
      {4.0, plus, 4.0, 1.0, 104.0, 8.0, 2.0, 204.0}};
  EXPECT_EQ(list, expected);
}

TEST(Respond, ShowsOneSideBesideAnImpact) {
  const auto test_case = toy(1, 4.0, {1.0});
  const double before = std::nextafter(1.0, 0.0), after = std::nextafter(1.0, 2.0);
  const auto list = all_rows(*respond(test_case, {0.0, 0, 0.0, {after, before}}));
  const std::vector<std::vector<record::Cell>> expected{
      {after, nothing, after, -1.0, 100.0 + after}, {before, nothing, before, 1.0, 100.0 + before}};
  EXPECT_EQ(list, expected);
}

TEST(Respond, StreamsManyRowsWithoutLosingOneAtABlocksBorder) {
  // Every tenth time is an impact; 512 is a multiple of neither 10 nor 11.
  std::vector<double> impacts;
  for (int k = 0; k <= 5000; k += 10) impacts.push_back(k);
  const auto test_case = toy(1, 5000.0, impacts);
  const auto rows = respond(test_case, grid_of(5001, 5000.0));
  std::vector<record::Cell> row;
  for (int k = 0; k <= 5000; ++k) {
    ASSERT_TRUE(rows->next(row));
    ASSERT_EQ(row[0], record::Cell{double(k)});
    ASSERT_EQ(row[1], k % 10 == 0 ? minus : nothing);
    if (k % 10 != 0) continue;
    ASSERT_TRUE(rows->next(row));
    ASSERT_EQ(row[0], record::Cell{double(k)});
    ASSERT_EQ(row[1], plus);
  }
  EXPECT_FALSE(rows->next(row));
  EXPECT_FALSE(rows->next(row));
}

TEST(Respond, KnowsTheNumberOfItsRowsAndGivesThemAsNumbers) {
  const auto test_case = toy(2, 4.0, {1.0, 4.0});
  const auto rows = respond(test_case, {1.0, 5, 0.0, {}});
  ASSERT_NE(rows->numbers(), nullptr);
  EXPECT_EQ(rows->numbers()->count(), 7);
  std::vector<double> values;
  ASSERT_TRUE(rows->numbers()->next_block(values));
  ASSERT_EQ(values.size(), 7u * 8u);
  EXPECT_EQ(std::vector<double>(values.begin() + 8, values.begin() + 24),
            (std::vector<double>{1, -1, 1, 1, 101, 2, 2, 201, 1, 1, 1, -1, 101, 2, -2, 201}));
  EXPECT_FALSE(rows->numbers()->next_block(values));
  EXPECT_TRUE(values.empty());
}

TEST(Respond, ReportsTheShareOfItsRowsAndEndsWhereTheCallerThrows) {
  const auto test_case = toy(1, 5000.0, {});
  const auto rows = respond(test_case, grid_of(5001, 5000.0));
  std::vector<double> shares;
  rows->progress = [&](double share) {
    shares.push_back(share);
    if (share > 0.5) throw 1;
  };
  std::vector<record::Cell> row;
  EXPECT_THROW(while (rows->next(row)){}, int);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_GT(shares.size(), 1u);
  EXPECT_LT(shares.back(), 1.0);
}

TEST(Respond, RefusesTimesOutsideTheRunBeforeAnyRow) {
  const auto test_case = toy(1, 4.0, {});
  for (const auto& row : {std::pair{4.5, "time-outside"},
                          {-0.5, "time-outside"},
                          {double(NAN), "not-a-number"},
                          {double(INFINITY), "not-finite"}}) {
    EXPECT_REFUSED(respond(test_case, {0.0, 0, 0.0, {1.0, row.first, 2.0}}), row.second);
  }
  EXPECT_REFUSED(
      respond(test_case, {0.0, 0, 0.0, {4.5}}), "time-outside",
      "respond: t = 4.5; allowed: 0 <= t <= 4 s, the run of toy. A longer run is another "
      "value of t_end or a_t.");
  EXPECT_THROW(respond(test_case, grid_of(3, 8.0)), InputError);
}

TEST(Impacts, ListEveryImpactWithBothSides) {
  const auto test_case = toy(2, 4.0, {1.0, 2.5});
  const auto rows = impacts(test_case);
  EXPECT_EQ(column_names(*rows),
            (std::vector<std::string>{"k", "t", "u1", "v1-", "v1+", "v2-", "v2+", "impulse",
                                      "energy_before", "energy_after"}));
  EXPECT_EQ(rows->schema(), "clackers/impacts/1");
  const std::vector<std::vector<record::Cell>> expected{
      {1LL, 1.0, 1.0, 1.0, -1.0, 2.0, -2.0, 0.5, 3.0, 2.0},
      {2LL, 2.5, 2.5, -1.0, 1.0, -2.0, 2.0, 1.0, 6.0, 4.0}};
  EXPECT_EQ(all_rows(*rows), expected);
}

TEST(Impacts, NameTheirContactWhereThereAreSeveral) {
  // Two contacts that close together.
  struct Several : CountedMotion {
    Several() : CountedMotion(3, 4.0, {1.0, 1.0}) {}
    model::MotionImpact impact(long long index) const override {
      auto now = CountedMotion::impact(index);
      now.contact = int(2 - index);
      return now;
    }
  };
  auto test_case = toy(3, 4.0, {});
  test_case.motion = std::make_shared<Several>();
  test_case.problem.contacts.resize(2);
  const auto rows = impacts(test_case);
  EXPECT_EQ(
      column_names(*rows),
      (std::vector<std::string>{"k", "t", "contact", "u1", "v1-", "v1+", "u2", "v2-", "v2+", "u3",
                                "v3-", "v3+", "impulse", "energy_before", "energy_after"}));
  // Both together turn the velocities around twice.
  const std::vector<std::vector<record::Cell>> expected{
      {1LL, 1.0, 1LL, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 3.0, 3.0, 3.0, 0.5, 3.0, 2.0},
      {2LL, 1.0, 0LL, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 3.0, 3.0, 3.0, 1.0, 6.0, 4.0}};
  EXPECT_EQ(all_rows(*rows), expected);
  // Rows of the response have two limits there, not four.
  EXPECT_EQ(all_rows(*respond(test_case, grid_of(5, 4.0))).size(), 6u);
}

TEST(Impacts, OfOneMassLeaveOutTheSecond) {
  const auto test_case = toy(1, 4.0, {1.0});
  const auto rows = impacts(test_case);
  EXPECT_EQ(column_names(*rows), (std::vector<std::string>{"k", "t", "u1", "v1-", "v1+", "impulse",
                                                           "energy_before", "energy_after"}));
  EXPECT_EQ(all_rows(*rows).size(), 1u);
  const auto none = toy(1, 4.0, {});
  EXPECT_TRUE(all_rows(*impacts(none)).empty());
}

TEST(Summary, HasTheForcesOfContactsThatStayClosed) {
  EXPECT_TRUE(summary_of(cases::make("stop")).contact_forces.t.empty());
  const auto problem = cases::make("plastic-pair");
  const auto curve = summary_of(problem).contact_forces;
  EXPECT_EQ(curve.t.front(), 0.0);
  EXPECT_EQ(curve.t.back(), problem.motion->end());
  ASSERT_EQ(curve.y.size(), 1u);
  double largest = 0.0;
  for (std::size_t k = 0; k < curve.t.size(); ++k) {
    const auto forces = problem.motion->contact_forces(curve.t[k], model::Side::right);
    ASSERT_EQ(forces.size(), 1);
    EXPECT_EQ(curve.y[0][k], forces[0]) << curve.t[k];
    largest = std::max(largest, forces[0]);
  }
  EXPECT_GT(largest, 1.0);
}

// What the loads leave of the momenta is what the contacts gave: by springs, impacts, infinitely many of them, and rest.
TEST(Forces, ImpulsesBalanceTheMomenta) {
  const auto expect = [](const cases::Case& test_case, const std::vector<std::string>& impulses) {
    const auto grid = grid_of(81, test_case.motion->end());
    const auto rows = forces(test_case, grid), states = respond(test_case, grid);
    const auto names = column_names(*rows);
    const auto& p = test_case.problem;
    Eigen::VectorXd load = Eigen::VectorXd::Zero(test_case.motion->dof());
    p.system.add_load(0.0, {load.data(), std::size_t(load.size())});
    std::vector<record::Cell> row, state;
    double largest = 0.0;
    while (rows->next(row)) {
      ASSERT_TRUE(states->next(state));
      const double t = std::get<double>(row[0]);
      // From the upper mass down: an impulse pushes one up and the next one down.
      double above = 0.0;
      for (auto i = load.size(); i-- > 0;) {
        const double v = std::get<double>(state[std::size_t(3 * i + 3)]);
        above += p.system.mass(i, i) * (v - p.start.v[i]) - load[i] * t;
        const auto place = std::ranges::find(names, impulses[std::size_t(i)]) - names.begin();
        EXPECT_NEAR(std::get<double>(row[std::size_t(place)]), above, 1e-12 * (1.0 + above))
            << i << " at " << t;
        largest = std::max(largest, above);
      }
    }
    EXPECT_GT(largest, 10.0);
  };
  expect(cases::make("ball"), {"impulse1"});
  const auto stack = [](const char* floor, const char* between) {
    cases::Case test_case;
    test_case.entry = &toy_entry;
    test_case.problem = model::problem_from_text(
        fmt::format("M = [[2, 0], [0, 1]]\nK = [[0, 0], [0, 0]]\nend = 3\n[start]\nu = [0.3, 0.8]\n"
                    "[[contacts]]\ndirection = [1, 0]\n{}\n[[contacts]]\ndirection = [-1, 1]\n{}\n"
                    "[[loads]]\ndof = 1\namplitude = -20\nfrequency = 0\n"
                    "[[loads]]\ndof = 2\namplitude = -12\nfrequency = 0\n",
                    floor, between),
        "stack");
    test_case.motion = std::make_shared<exact::PiecewiseMotion>(test_case.problem);
    return test_case;
  };
  // The floor holds mass 1 while mass 2 falls on it, once or infinitely many times.
  expect(stack("restitution = 0", "restitution = 0"), {"impulse1", "impulse2"});
  expect(stack("restitution = 0", "restitution = 0.5"), {"impulse1", "impulse2"});
  // Springs follow contacts.
  expect(stack("stiffness = 300", "restitution = 0"), {"impulse2", "impulse1"});
  // Closed for a moment only.
  expect(stack("stiffness = 1e6", "stiffness = 4e6"), {"impulse1", "impulse2"});
}

TEST(Forces, OfMoreImpactsThanAreListedAreRefused) {
  EXPECT_REFUSED(forces(cases::make("stop", {{"t_end", 1e7}}), grid_of(3, 1e7)), "out-of-range",
                 "at most 1000000 impacts");
}

TEST(Points, OfMassesAreRefusedWithAllCasesThatHaveThem) {
  const auto refusal = test::refusal_of([] { points(toy(1, 4.0, {}), grid_of(2, 4.0), {0.0}); });
  for (const auto& entry : cases::entries())
    EXPECT_EQ(refusal.find(" " + entry.name) != std::string::npos,
              cases::make(entry.name).bars != nullptr)
        << entry.name;
}

#ifdef CLACKERS_HAS_ARB
TEST(Digits, AreOfAllCases) {
  for (const auto& entry : cases::entries()) {
    const auto test_case = cases::make(entry.name);
    SCOPED_TRACE(entry.name);
    const auto refusal = test::refusal_of([&] {
      const auto rows = respond(test_case, grid_of(2, test_case.problem.end), 20);
      std::vector<record::Cell> row;
      if (test_case.bars == nullptr)  // those of waves take seconds
        while (rows->next(row)) {
        }
    });
    // Its contact closes without a speed.
    EXPECT_EQ(refusal == "accepted", entry.name != "plastic-pair") << refusal;
  }
}
#endif

TEST(ResponseCurve, HoldsOneRowAMassOverTheWholeRun) {
  const auto curve = response_curve(toy(2, 4.0, {1.0}), 5);
  EXPECT_EQ(curve.t, (std::vector<double>{0, 1, 2, 3, 4}));
  EXPECT_EQ(curve.y, (std::vector<std::vector<double>>{{0, 1, 2, 3, 4}, {0, 2, 4, 6, 8}}));
  EXPECT_THROW(response_curve(toy(2, 4.0, {}), 1), InputError);
}

}  // namespace
}  // namespace clackers::tables
