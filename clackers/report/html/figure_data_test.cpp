#include "clackers/report/html/figure_data.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "clackers/base/files/json.hpp"
#include "clackers/judge/cost/work_precision.hpp"
#include "clackers/record/reduced_curve.hpp"
#include "clackers/report/html/figures.hpp"
#include "clackers/report/html/plot_style.hpp"
#include "clackers/report/testing/sample_record.hpp"

namespace clackers::report {
namespace {

record::CaseRecord sample() { return sample_record().cases[0]; }

TEST(FigureData, SubnormalNumbersAreDrawn) {
  auto problem = sample();
  for (auto& y : problem.response.y) y.assign(y.size(), 4.2e-311);
  for (auto& subject : problem.subjects)
    for (auto& level : subject.levels)
      for (auto& run : level.runs) {
        run.score.u_error = 1e-310;
        for (auto& y : run.error_history.y) y.assign(y.size(), 1e-310);
      }
  EXPECT_EQ(figure_data(problem)["response"][0]["u"][0].get<double>(), 4.2e-311);
}

TEST(FigureData, TheFirstNineMassesHaveCurvesOfTheirOwnStyle) {
  auto problem = sample();
  for (auto* curve : {&problem.response, &problem.subjects[0].levels.back().runs[0].error_history})
    curve->y.resize(14, curve->y[0]);
  const auto data = figure_data(problem);
  EXPECT_EQ(data["response"].size(), 9u);
  const auto figure = figure_specifications(problem)["response"]["layer"][1]["encoding"];
  for (const auto* channel : {"color", "strokeDash"}) {
    EXPECT_EQ(figure[channel]["scale"]["domain"].size(), 9u);
    EXPECT_EQ(figure[channel]["scale"]["range"].size(), 9u);
  }
  EXPECT_EQ(figure["color"]["scale"]["domain"][8], "mass 9");
  for (const auto& curve : data["history"]) EXPECT_LE(curve["mass"], 9);
}

TEST(FigureData, TheErrorAgainstTimeOpensOnTheMassOfTheLargest) {
  auto problem = sample();
  auto& errors = problem.subjects[0].levels.back().runs[0].error_history.y;
  for (const std::size_t mass : {2u, 1u}) {
    for (auto& y : errors) y.assign(y.size(), 1e-3);
    errors[mass - 1].back() = 1e3;
    EXPECT_EQ(worst_mass(problem), mass);
    EXPECT_EQ(figure_specifications(problem)["history"]["params"][2]["value"], mass);
    int number = 1;
    EXPECT_NE(
        figures_html(problem, {}, number)
            .find(fmt::format("data-mass=\"{}\" data-of=\"history\" aria-pressed=\"true\"", mass)),
        std::string::npos);
  }
}

TEST(FigureData, RunsOfTheAnimationHaveTheirStepWithItsUnit) {
  const auto motion = player_data(sample_check().cases[0]);
  ASSERT_FALSE(motion["runs"].empty());
  EXPECT_TRUE(std::regex_match(motion["runs"][0]["step"].get<std::string>(),
                               std::regex("h = [0-9.e-]+ s")));
}

TEST(PlotStyle, TheFirstThirtyTwoMassesDiffer) {
  std::set<std::pair<std::string, std::vector<double>>> styles;
  for (std::size_t mass = 0; mass < 32; ++mass)
    styles.insert({mass_style(mass).color, mass_style(mass).dash});
  EXPECT_EQ(styles.size(), 32u);
}

TEST(FigureData, RunsAreWholeToTheLastDigit) {
  const auto problem = sample();
  const auto runs = figure_data(problem)["runs"];
  ASSERT_EQ(runs["rows"].size(), 6u * 64 + 24 + 1);
  std::size_t column = 0;
  while (runs["columns"][column] != "u_error") ++column;
  EXPECT_EQ(runs["rows"][77][column].get<double>(),
            problem.subjects[1].levels[1].runs[5].score.u_error);
}

TEST(FigureData, LevelsThatTheFitCallsUnusableAreSkipped) {
  auto problem = sample();
  auto& fit = problem.subjects[0].assessment.displacement;
  const auto all = figure_data(problem)["levels"].size();
  fit.errors[2] = std::nan("");
  const auto levels = figure_data(problem)["levels"];
  EXPECT_EQ(levels.size(), all - 1);
  EXPECT_EQ(levels[2]["level"], 4);
  EXPECT_EQ(levels[2]["u_error"], fit.errors[3]);
}

TEST(FigureData, TheLineOfWorkIsTheEnvelopeOfTheProfile) {
  auto problem = sample();
  auto& runs = problem.subjects[0].levels[2].runs;
  runs[1].score.u_error = 5.0;                      // the largest error
  runs[4].score.work.force_evaluations = 12345678;  // and of another run the largest cost
  const auto curve =
      judge::work_curve(record::ladder_of(problem.subjects[0]), judge::Counter::force_evaluations);
  bool found = false;
  const auto data = figure_data(problem);
  for (const auto& row : data["work"])
    if (row["method"] == "newmark" && row["counter"] == "force_evaluations" && row["level"] == 3) {
      found = true;
      EXPECT_EQ(row["u_error"], curve.envelope[2].error);
      EXPECT_EQ(row["cost"], curve.envelope[2].work);
      EXPECT_EQ(row["u_error"], 5.0);
      EXPECT_EQ(row["cost"], 12345678.0);
    }
  EXPECT_TRUE(found);
}

TEST(FigureData, NoRunIsCheaperAndMoreAccurateThanTheFront) {
  const auto problem = sample();
  const auto front = figure_data(problem)["front"];
  std::size_t points = 0;
  for (const auto& point : front) {
    if (point["counter"] != "steps") continue;
    ++points;
    for (const auto& subject : problem.subjects)
      for (const auto& level : subject.levels)
        for (const auto& run : level.runs)
          EXPECT_FALSE(double(run.score.work.steps) < point["cost"].get<double>() &&
                       run.score.u_error < point["u_error"].get<double>());
  }
  EXPECT_GT(points, 3u);
}

TEST(FigureData, TrianglesClimbWithTheirOrder) {
  const auto slopes = figure_data(sample())["slopes"];
  ASSERT_EQ(slopes.size(), 3u);
  for (const auto& slope : slopes) {
    // From the left end of the base to the top right corner, which is corner 2.
    double left = 1e9, bottom = 1e9, right = 0, top = 0;
    for (std::size_t i = 0; i < slope["corner"].size(); ++i) {
      left = std::min(left, slope["step"][i].get<double>());
      bottom = std::min(bottom, slope["u_error"][i].get<double>());
      if (slope["corner"][i] == 2) right = slope["step"][i], top = slope["u_error"][i];
    }
    EXPECT_NEAR(std::log(top / bottom) / std::log(right / left),
                std::stod(slope["order"].get<std::string>()),
                1e-12);  // three logarithms and a power, each within 1e-15 relative of about 10
  }
  EXPECT_TRUE(figure_data({})["slopes"].empty());
}

TEST(FigureData, HistoriesHaveTheRowsOfTheFinest) {
  const auto data = figure_data(sample_check().cases[0]);
  ASSERT_EQ(data["history_rows"].size(), 2u);
  EXPECT_EQ(data["history_rows"][1]["series"], "mass 2");
  EXPECT_EQ(data["history_rows"][1]["t"].size(), 201u);
  EXPECT_EQ(data["runs"]["rows"].size(), 2u);
  EXPECT_TRUE(data["work"].empty());
}

TEST(FigureData, ImpactsAreNumberedFromOneWithTheirBars) {
  const auto rows = figure_data(sample_check().cases[0])["impact_table"];
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["k"], 1);
  EXPECT_EQ(rows[1]["contact"], 2);
  EXPECT_EQ(rows[1]["t"], 4.7124);
  EXPECT_EQ(rows[0]["restitution"], 0.9);
  EXPECT_EQ(rows[0]["least"], 0.899);
  EXPECT_EQ(rows[0]["most"], 0.901);
  EXPECT_EQ(rows[1]["late"], 0.75);
}

TEST(ProfileData, LinesBeginAtTheLeastCostAndEndTogether) {
  const std::vector<record::Profile> profiles{{"steps",
                                               {"a", "b"},
                                               {{"cheap", {1, 1}, {{1.0, 1.0}}, 2, 0},
                                                {"dear", {4, INFINITY}, {{4.0, 0.5}}, 0, 1},
                                                {"never", {INFINITY, INFINITY}, {}, 0, 2}}}};
  const auto rows = profile_data(profiles, {});
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0]["ratio"], (nlohmann::ordered_json{1.0, 5.0}));
  EXPECT_EQ(rows[1]["share"], (nlohmann::ordered_json{0.0, 0.5, 0.5}));
  EXPECT_EQ(rows[1]["solved"], (nlohmann::ordered_json{0, 1, 1}));
  EXPECT_EQ(rows[2]["failed"], 2);
}

TEST(ProfileData, AMethodThatRefusedEveryCaseHasNoLine) {
  const auto problem = sample();
  for (const auto& row : profile_data(problem.profiles, {&problem, 1}))
    EXPECT_NE(row["method"], "newmark+penalty:stiffness=1e6");
}

TEST(FigureSpecifications, NoPlaceholderIsLeftAndTheirDataIsThere) {
  for (const auto& problem : {sample(), sample_check().cases[0]}) {
    const auto data = figure_data(problem);
    const auto all = figure_specifications(problem);
    for (const auto& [name, specification] : all.items()) {
      const auto text = json_text(specification);
      EXPECT_FALSE(std::regex_search(text, std::regex("\"\\$(?!schema)"))) << name << text;
      const std::regex named("\"data\":\\{\"name\":\"([a-z_]+)\"\\}");
      for (std::sregex_iterator at(text.begin(), text.end(), named), end; at != end; ++at)
        EXPECT_TRUE(data.contains((*at)[1].str())) << name << (*at)[1];
    }
  }
}

TEST(FigureSpecifications, ThereIsOneForWhatCanBeDrawn) {
  auto check = sample_check().cases[0];
  auto all = figure_specifications(check);
  EXPECT_TRUE(all.contains("history") && all.contains("convergence"));
  const auto wide = json_text(all.at("impacts"));
  EXPECT_NE(wide.find("[0.89,0.96]"), std::string::npos) << "a hundredth around 0.9 and 0.95";
  EXPECT_FALSE(all.contains("work") || all.contains("profile"));
  check.subjects[0].levels.erase(check.subjects[0].levels.begin());
  for (auto& errors : check.subjects[0].levels[0].runs[0].error_history.y)
    errors.assign(errors.size(), 0.0);
  check.subjects[0].impacts.clear();
  all = figure_specifications(check);
  EXPECT_FALSE(all.contains("convergence")) << "one point is no line";
  EXPECT_FALSE(all.contains("history") || all.contains("impacts"));
}

TEST(FigureData, RunsOfProgramsHaveTheirNamesInsteadOfPlaces) {
  auto check = sample_check().cases[0];
  auto& subject = check.subjects[0];
  subject.levels[0].runs[0].file->file = "/home/me/.cache/history.csv";
  subject.kind = record::SubjectKind::program;
  const auto text = json_text(figure_data(check));
  EXPECT_EQ(text.find("/home/me"), std::string::npos);
  EXPECT_NE(text.find(subject.name + " at h = "), std::string::npos);
}

TEST(FigureSpecifications, DataOfSeveralCasesIsToldApart) {
  auto specification = figure_specifications(sample())["work"];
  rename_data(specification, "-2");
  const auto text = json_text(specification);
  EXPECT_NE(text.find("{\"name\":\"front-2\"}"), std::string::npos);
  EXPECT_EQ(text.find("{\"name\":\"runs\"}"), std::string::npos);
  EXPECT_NE(text.find("\"name\":\"zoom\""), std::string::npos) << "names of others stay";
}

TEST(PlotStyle, TheFirstTwentyFourAreDifferent) {
  for (std::size_t i = 0; i < 24; ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const auto a = plot_style(i), b = plot_style(k);
      // Colour may repeat, but then neither dash nor marker does.
      EXPECT_TRUE(a.color != b.color || (a.dash != b.dash && a.shape != b.shape)) << i << " " << k;
    }
}

}  // namespace
}  // namespace clackers::report
