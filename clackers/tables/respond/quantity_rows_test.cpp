// Rows of energies, sensitivities and spectra, and what `show` prints of harmonics and conditioning.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/exact/quantities/energy.hpp"
#include "clackers/exact/quantities/sensitivity.hpp"
#include "clackers/exact/quantities/spectrum.hpp"
#include "clackers/tables/listing/show_sheets.hpp"
#include "clackers/tables/respond.hpp"
#include "clackers/tables/testing/counted_motion.hpp"
#include "clackers/tables/times/timed_rows.hpp"

namespace clackers::tables {
namespace {

using Rows = std::vector<std::vector<record::Cell>>;

Rows all(record::RowSource& rows) {
  Rows list;
  std::vector<record::Cell> row;
  while (rows.next(row)) list.push_back(row);
  return list;
}

std::string names(const record::RowSource& rows) {
  std::string list;
  for (const auto& column : rows.columns()) list += (list.empty() ? "" : ",") + column.name;
  return list;
}

std::string units(const record::RowSource& rows) {
  std::string list;
  for (const auto& column : rows.columns()) list += "," + column.unit;
  return list;
}

using test::refusal_of;

const exact::ClosedForm& motion_of(const cases::Case& test_case) {
  return *exact::as_closed_form(*test_case.motion);
}

TEST(EnergyRows, AreTheSplitAtEveryTimeAndOnBothSidesOfAnImpact) {
  const auto test_case = cases::make("stop", {{"eta", 0.5}});
  const double hit = test_case.motion->impact(1).t;
  const auto rows = energies(test_case, {0.0, 0, 0.0, {0.5, hit, 3.0}});
  EXPECT_EQ(names(*rows), "t,side,kinetic,potential,dissipated,lost,total,momentum");
  EXPECT_EQ(rows->schema(), "clackers/energy/1");
  const exact::EnergyAccount account(motion_of(test_case));
  const auto row = [&](double t, const char* sign, model::Side side) {
    const auto s = account.at(t, side);
    return std::vector<record::Cell>{
        t,
        *sign == '\0' ? record::Cell{} : record::Cell{std::string(sign)},
        s.kinetic,
        s.potential,
        s.dissipated,
        s.lost,
        s.total(),
        account.momentum(t, side)};
  };
  EXPECT_EQ(all(*rows), (Rows{row(0.5, "", model::Side::left), row(hit, "-", model::Side::left),
                              row(hit, "+", model::Side::right), row(3.0, "", model::Side::left)}));
}

TEST(SensitivityRows, AreTheRawDerivativeWhereARawParameterIsNamed) {
  const auto test_case = cases::make("synchronized-pair", {{"r", 0.5}});
  const auto rows = sensitivity(test_case, grid_of(3, 20.0), "k1");
  EXPECT_EQ(names(*rows), "t,side,du1,dv1,da1,du2,dv2,da2");
  EXPECT_EQ(units(*rows), ",s,,m^2/N,m^2/N/s,m^2/N/s^2,m^2/N,m^2/N/s,m^2/N/s^2");
  const auto d = exact::raw_sensitivity(motion_of(test_case), "k1")->at(10.0, model::Side::left);
  EXPECT_EQ(all(*rows)[1], (std::vector<record::Cell>{10.0, record::Cell{}, d.u[0], d.v[0], d.a[0],
                                                      d.u[1], d.v[1], d.a[1]}));
}

TEST(SensitivityRows, AreTheDerivativeWithinTheClassWhereAParameterOfTheCaseIsNamed) {
  const auto test_case = cases::make("synchronized-pair", {{"r", 0.5}});
  for (const auto& [name, plain] : {std::pair{"r", "r"}, {"xi1", "xi1"}, {"class:k1", "k1"}}) {
    const auto d =
        exact::class_sensitivity(motion_of(test_case), plain)->at(10.0, model::Side::left);
    const auto rows = all(*sensitivity(test_case, grid_of(3, 20.0), name));
    EXPECT_EQ(rows[1][2], record::Cell{d.u[0]}) << name;
    EXPECT_EQ(rows[1][7], record::Cell{d.a[1]}) << name;
  }
  EXPECT_EQ(units(*sensitivity(test_case, grid_of(3, 20.0), "r")), ",s,,m,m/s,m/s^2,m,m/s,m/s^2");
  EXPECT_EQ(units(*sensitivity(cases::make("sdof"), grid_of(3, 20.0), "m1")),
            ",s,,m/kg,m/s/kg,m/s^2/kg");
  const auto sdof = cases::make("sdof");
  const auto exact_data = cases::make("exact-data-pair");
  EXPECT_EQ(units(*sensitivity(sdof, grid_of(3, 20.0), "c1")), ",s,,m^2/N/s,m^2/N/s^2,m^2/N/s^3");
  EXPECT_EQ(units(*sensitivity(sdof, grid_of(3, 20.0), "u10")), ",s,,,1/s,1/s^2");
  EXPECT_EQ(units(*sensitivity(sdof, grid_of(3, 20.0), "v10")), ",s,,s,,1/s");
  for (const auto* name : {"Omega", "sigma"})
    EXPECT_EQ(units(*sensitivity(exact_data, grid_of(3, 20.0), name)), ",s,,m s,m,m/s,m s,m,m/s");
}

TEST(SensitivityRows, AreRefusedWithTheReason) {
  const auto ask = [](const char* name, const cases::Settings& settings, const char* parameter) {
    return refusal_of([&] {
      const auto test_case = cases::make(name, settings);
      sensitivity(test_case, grid_of(2, 1.0), parameter);
    });
  };
  EXPECT_EQ(ask("three-parameter", {}, "xi2"),
            "clackers: no parameter of three-parameter to differentiate by \"xi2\". Did you mean "
            "\"xi1\"? All names: m1 m2 k1 k2 c1 c2 eta gap u10 u20 v10 v20 xi1 [unknown-name]");
  // Not a parameter of this case.
  EXPECT_NE(ask("three-parameter", {}, "r").find("[unknown-name]"), std::string::npos);
  EXPECT_NE(ask("three-parameter", {}, "class:k1").find("[unknown-name]"), std::string::npos);
  EXPECT_NE(ask("synchronized-pair", {}, "class:k").find("class:m1"), std::string::npos);
  for (const auto& [name, parameter] :
       {std::pair{"three-parameter", "N"}, {"exact-data-pair", "X"}})
    EXPECT_NE(ask(name, {}, parameter).find("it is a whole number"), std::string::npos);
  for (const auto& [name, parameter] : {std::pair{"three-parameter", "a_t"}, {"sdof", "t_end"}}) {
    const auto text = ask(name, {}, parameter);
    EXPECT_NE(text.find("it only sets the end of the run"), std::string::npos) << text;
    EXPECT_NE(text.find("[no-derivative]"), std::string::npos) << text;
  }
  EXPECT_NE(ask("stop", {{"eta", 0.0}}, "k1").find("eta = 0"), std::string::npos);
  EXPECT_EQ(ask("stop", {{"eta", 0.0}}, "xi1"), "accepted");
  EXPECT_NE(ask("sdof", {}, "gap").find("[unknown-name]"), std::string::npos);
}

TEST(SpectrumRows, AreTheTransformFromZeroToTheHighestFrequency) {
  const auto test_case = cases::make("three-parameter");
  const auto rows = spectrum(test_case, 5, 2.0);
  EXPECT_EQ(names(*rows), "omega,re1,im1,re2,im2");
  EXPECT_EQ(units(*rows), ",rad/s,m s,m s,m s,m s");
  const auto list = all(*rows);
  ASSERT_EQ(list.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    const double omega = 0.5 * double(k);
    const auto f = exact::Spectrum(motion_of(test_case)).at(omega);
    EXPECT_EQ(list[k], (std::vector<record::Cell>{omega, f[0].real(), f[0].imag(), f[1].real(),
                                                  f[1].imag()}));
  }
  EXPECT_EQ(names(*spectrum(cases::make("sdof"), 2, 1.0)), "omega,re1,im1");
  for (const double highest : {0.0, -1.0, 1e300})
    EXPECT_NE(refusal_of([&] { spectrum(test_case, 5, highest); }).find("highest = "),
              std::string::npos);
  EXPECT_NE(refusal_of([&] { spectrum(test_case, 1, 1.0); }).find("samples = 1"),
            std::string::npos);
}

// Masses 1, 2 and 3 kg with v = i and u = i t, on springs of 2 N/m; two impacts at 1 s, each with
// the loss of 1 J that both make together, and one of 3 J at 2 s.
TEST(EnergyRows, OfAnyMotionAreThoseOfItsStatesAndImpacts) {
  struct Lossy : CountedMotion {
    Lossy() : CountedMotion(3, 4.0, {1.0, 1.0, 2.0}) {}
    model::MotionImpact impact(long long index) const override {
      auto now = CountedMotion::impact(index);
      now.energy_after = now.energy_before - (index < 3 ? 1.0 : 3.0);
      return now;
    }
  };
  const cases::CaseEntry entry{"toy", "", "", {}};
  cases::Case toy;
  toy.entry = &entry;
  toy.motion = std::make_shared<Lossy>();
  toy.problem.system.mass = Eigen::Vector3d(1.0, 2.0, 3.0).asDiagonal();
  toy.problem.system.stiffness = 2.0 * Eigen::Matrix3d::Identity();
  const auto rows = energies(toy, {0.0, 0, 0.0, {0.5, 1.0, 3.0}});
  EXPECT_EQ(names(*rows), "t,side,kinetic,potential,dissipated,lost,total,momentum");
  const record::Cell minus{std::string("-")}, plus{std::string("+")};
  const Rows expected{{0.5, record::Cell{}, 18.0, 3.5, 0.0, 0.0, 21.5, 14.0},
                      {1.0, minus, 18.0, 14.0, 0.0, 0.0, 32.0, 14.0},
                      {1.0, plus, 18.0, 14.0, 0.0, 1.0, 33.0, 14.0},
                      {3.0, record::Cell{}, 18.0, 126.0, 0.0, 4.0, 148.0, -14.0}};
  EXPECT_EQ(all(*rows), expected);
}

// In units of 2^-52 of the largest energy: what rounding of phases up to 200 rad, and the bends of springs and
// friction that are found to it, may leave.
constexpr double balance_units = 1000.0;

TEST(EnergyRows, OfEveryCaseBalanceAtAllTimes) {
  std::map<std::string, cases::Settings> settings{
      {"pressed-oscillator", {{"c", 0.3}, {"f1", 0.3}}},  // damping, both loads, and rest
      {"oblique-disk", {{"eta", 0.2}}},                   // slides on the floor
      {"penalized-pair", {{"xi1", 0.5}}},
      {"bar-wall", {{"mass", "lumped"}, {"eta", 0.5}}}};
  for (const auto& entry : cases::entries()) {
    const auto& name = entry.name;
    const auto test_case = cases::make(name, settings[name]);
    const auto rows = energies(test_case, grid_of(61, test_case.motion->end()));
    std::size_t total = 0;
    while (rows->columns()[total].name != "total") ++total;
    const auto table = all(*rows);
    const auto number = [&](std::size_t row, std::size_t column) {
      return record::number_in(table[row][column]);
    };
    double largest = 0.0;
    for (std::size_t k = 0; k < table.size(); ++k)
      largest = std::max(largest, std::abs(number(k, 2)) + std::abs(number(k, 3)));
    for (std::size_t k = 1; k < table.size(); ++k) {
      EXPECT_NEAR(number(k, total), number(0, total), balance_units * 0x1p-52 * largest)
          << name << " at " << number(k, 0) << " s";
      for (const std::size_t rising : {4U, 5U})
        EXPECT_GE(number(k, rising), number(k - 1, rising) - 1e-14 * largest) << name;
    }
  }
}

TEST(EnergyRows, HaveThePotentialOfAWeightAndTheWorkOfLoadsAndBelts) {
  const auto last = [](const char* name, const cases::Settings& settings) {
    const auto test_case = cases::make(name, settings);
    const auto rows = energies(test_case, grid_of(2, test_case.motion->end()));
    std::map<std::string, double> values;
    for (const auto& row : all(*rows))
      for (std::size_t i = 0; i < row.size(); ++i)
        values[rows->columns()[i].name] = record::number_in(row[i]);
    return values;
  };
  // A ball of 1 kg, 2 m high.
  const auto ball = cases::make("ball", {{"h0", 2.0}, {"g", 10.0}});
  EXPECT_EQ(all(*energies(ball, {0.0, 0, 0.0, {0.0}}))[0][3], record::Cell{20.0});
  // A period of J. P. den Hartog's motion: 4 F A of work, all of it to friction.
  const double W = 0.8, F = 0.4;
  auto values = last("forced-slider", {{"W", W}, {"F", F}, {"t_end", 2.0 * M_PI / W}});
  const auto slider = cases::make("forced-slider", {{"W", W}, {"F", F}});
  const double loss = 4.0 * F * slider.problem.start.u[0];
  EXPECT_NEAR(values["dissipated"], loss, 1e-13);
  EXPECT_NEAR(values["work"], loss, 1e-13);
  // Half swings of the widths 2 (x0 - d), 2 (x0 - 3 d), ... under F = 1/8, d = F/k, until it rests at 0.
  values = last("slider", {{"F", 0.125}});
  EXPECT_NEAR(values["dissipated"], 0.125 * 2.0 * (0.875 + 0.625 + 0.375 + 0.125), 1e-14);
  // While it sticks the belt does the work of the spring: from u = 0 to 1.
  values = last("belt", {{"V", 0.25}, {"t_end", 4.0}});
  EXPECT_EQ(values["dissipated"], 0.0);
  EXPECT_NEAR(values["work"], 0.5, 1e-14);
}

TEST(QuantityRows, NeedAClosedFormAndTimesInsideTheRun) {
  const cases::CaseEntry entry{"toy", "", "", {}};
  cases::Case toy;
  toy.entry = &entry;
  toy.motion = std::make_shared<CountedMotion>(2, 4.0, std::vector<double>{});
  for (const auto& text : {refusal_of([&] { sensitivity(toy, grid_of(2, 1.0), "m1"); }),
                           refusal_of([&] { spectrum(toy, 2, 1.0); })})
    EXPECT_NE(text.find("toy is none. [no-closed-form]"), std::string::npos) << text;
  const auto test_case = cases::make("sdof");
  const TimeGrid late{0.0, 0, 0.0, {21.0}};
  EXPECT_NE(refusal_of([&] { energies(test_case, late); }).find("[time-outside]"),
            std::string::npos);
  EXPECT_NE(refusal_of([&] { sensitivity(test_case, late, "m1"); }).find("[time-outside]"),
            std::string::npos);
}

TEST(HarmonicSheet, HasThePeakAndTheLastThatCounts) {
  const auto sheet = harmonic_sheet(cases::make("three-parameter"), 0.1);
  ASSERT_TRUE(sheet);
  // X = 9: peak at 4, the last at 0.1 is 7; 1 to 7 around the first, 8 to 10 around the second.
  ASSERT_EQ(sheet->rows.size(), 10u);
  EXPECT_EQ(sheet->rows[3][0], record::Cell{4LL});
  EXPECT_EQ(sheet->rows[3][3], record::Cell{1.0});
  EXPECT_NEAR(std::get<double>(sheet->rows[3][1]), 8.0 * std::sqrt(0.9975), 1e-14);
  EXPECT_EQ(sheet->rows[6][4], record::Cell{std::string("yes")});
  EXPECT_EQ(sheet->rows[7][4], record::Cell{std::string("no")});
  EXPECT_NE(sheet->title.find("0.1 of the peak"), std::string::npos);
  // Far apart, rows between the two groups are left out.
  EXPECT_EQ(harmonic_sheet(cases::make("synchronized-pair", {{"X", 401.0}}), 0.001)->rows.size(),
            14u);
  // Below the peak, too, only what reaches the threshold counts.
  const auto high =
      harmonic_sheet(cases::make("synchronized-pair", {{"X", 195.0}, {"r", 1.0}}), 0.9);
  for (const auto& row : high->rows)
    EXPECT_EQ(std::get<std::string>(row[4]) == "yes", std::get<double>(row[3]) >= 0.9);
  EXPECT_FALSE(harmonic_sheet(cases::make("stop"), 0.1));
}

TEST(ConditioningSheet, TellsWhenSynchronyIsLost) {
  const auto lost = [](const char* name, const cases::Settings& settings) {
    std::vector<double> list;
    const auto sheet = conditioning_sheet(cases::make(name, settings)).value();
    for (const auto& row : sheet.rows) list.push_back(std::get<double>(row[2]));
    return list;
  };
  const double never = INFINITY;
  // ln(0.1/eps)/(1.5 pi eps), rounded up.
  EXPECT_EQ(lost("three-parameter", {}),
            (std::vector<double>{never, never, never, never, 49.0, 978.0, 14659.0, 2443119.0}));
  EXPECT_EQ(lost("synchronized-pair", {{"r", 0.5}}), std::vector<double>(8, never));
  // log2 of 100, 1e5, 1e8, 0.1 * 2^53; 10, 100, 1000, 1e5.
  EXPECT_EQ(lost("symmetric-pair", {{"eta", 0.5}}),
            (std::vector<double>{7.0, 17.0, 27.0, 50.0, 4.0, 7.0, 10.0, 17.0}));
  EXPECT_FALSE(conditioning_sheet(cases::make("sdof")));
}

}  // namespace
}  // namespace clackers::tables
