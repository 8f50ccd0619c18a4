#include "clackers/study/path/path_sheets.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/model/trajectory.hpp"

namespace clackers::study {
namespace {

PathRequest request(std::vector<std::string> methods, cases::Settings settings = {}) {
  PathRequest path;
  path.methods = std::move(methods);
  path.case_name = "bar-wall";
  path.settings = std::move(settings);
  path.samples_per_level = 4;
  return path;
}

// The numbers of a sheet's rows by method.
std::map<std::string, std::vector<double>> by_method(const record::Sheet& sheet) {
  std::map<std::string, std::vector<double>> rows;
  for (const auto& row : sheet.rows)
    for (std::size_t i = 1; i < row.size(); ++i)
      rows[std::get<std::string>(row.front())].push_back(record::number_in(row[i]));
  return rows;
}
std::string reading(const PathStudy& study, std::size_t row) {
  return std::get<std::string>(study.sheets[0].rows.at(row).back());
}

// Orders measured elsewhere, with other programs for mesh and integrators, of a bar against a wall at 0.45 h/c and up
// to 256 elements: leapfrog with a massless node 0.63 0.42 0.31, backward Euler 0.50 0.49 0.26.
TEST(Path, HasTheOrdersOfDataWithAJump) {
  const auto study = follow_path(request({"central-difference", "bdf1"}));
  auto orders = by_method(study.sheets[0]);
  const auto expect = [&](const char* name, double u, double v_l1, double v_l2) {
    EXPECT_NEAR(orders[name][0], u, 0.08) << name;
    EXPECT_NEAR(orders[name][1], v_l1, 0.06) << name;
    EXPECT_NEAR(orders[name][2], v_l2, 0.06) << name;
  };
  expect("central-difference", 0.63, 0.42, 0.31);
  expect("bdf1", 0.50, 0.49, 0.26);
  EXPECT_EQ(reading(study, 0), "as expected");
  EXPECT_EQ(reading(study, 1), "as expected");
  EXPECT_EQ(expected_along_path(2.0).u, 2.0 / 3.0);
  EXPECT_EQ(expected_along_path(1.0).v_l2, 0.25);
}

// A contact force treated as an internal one gains energy again and again, and the velocities are wrong on any mesh.
TEST(Path, TellsAForceThatGainsEnergy) {
  auto elastic = request({"newmark+penalty", "newmark"}, {{"mass", "lumped"}, {"eta", 1.0}});
  elastic.samples_per_level = 8;
  const auto study = follow_path(elastic);
  EXPECT_EQ(reading(study, 0), "velocities stagnate");
  EXPECT_EQ(reading(study, 1), "as expected");
  auto finest = by_method(study.sheets[1]);
  EXPECT_GT(finest["newmark+penalty"][5], 5.0);  // thirteenfold at last, as it is known to
  EXPECT_NEAR(finest["newmark"][5], 0.0, 1e-12);
}

TEST(Path, SeparatesTheErrorOfTheMesh) {
  const auto coarse = follow_path(request({"newmark"}, {{"t_end", 3.0}}));
  auto fine_request = request({"newmark"}, {{"t_end", 3.0}});
  fine_request.nu = {0.05};
  const auto fine = follow_path(fine_request);
  for (std::size_t k = 0; k < coarse.runs.rows.size(); ++k) {
    const auto at = [k](const PathStudy& study, std::size_t column) {
      return record::number_in(study.runs.rows[k][column]);
    };
    EXPECT_LE(at(coarse, 4), at(coarse, 5) + at(coarse, 6));
    EXPECT_GE(at(coarse, 4), std::abs(at(coarse, 5) - at(coarse, 6)));
    // With a ninth of the step the integrator's error is small, and that of the mesh is left.
    EXPECT_LT(at(fine, 5), 0.05 * at(coarse, 5));
    EXPECT_NEAR(at(fine, 4), at(fine, 6), at(fine, 5));
    EXPECT_EQ(at(coarse, 3), 3.0 / std::ceil(3.0 * at(coarse, 1) / 0.45 - 1e-9));
  }
  EXPECT_EQ(coarse.runs.rows.size(), 12u);
  // Bars that fall have the work of their weight in the energy.
  auto falling = request({"newmark"});
  falling.case_name = "bouncing-bar";
  falling.levels = 1;
  EXPECT_NEAR(by_method(follow_path(falling).sheets[1])["newmark"][5], 0.0, 0.01);
  // Of finer meshes the exact motion is not known.
  const auto unknown_of = [&](const cases::Settings& settings) {
    falling.settings = settings;
    const auto large = follow_path(falling);
    std::size_t unknown = 0;
    for (const auto& row : large.runs.rows) {
      const bool is_known = !std::isnan(record::number_in(row[5]));
      if (!is_known) ++unknown;
      EXPECT_EQ(std::isnan(record::number_in(row[6])), !is_known);
      EXPECT_LT(record::number_in(row[4]), 0.1);
    }
    EXPECT_EQ(large.sheets[2].columns.size(), unknown < large.runs.rows.size() ? 3u : 2u);
    return unknown;
  };
  falling.samples_per_level = 3;
  EXPECT_EQ(unknown_of({{"elements", 60.0}, {"mass", "lumped"}, {"eta", 1.0}}), 0u);
  falling.case_name = "string-on-obstacle";
  EXPECT_EQ(unknown_of({{"elements", 390.0}, {"t_end", 0.1}}), 2u);
  falling.samples_per_level = 2;
  falling.levels = 2;
  EXPECT_EQ(unknown_of({{"elements", 410.0}, {"t_end", 0.1}}), 4u);
  falling.settings = {};
  // A mass that strikes is no node.
  falling.case_name = "mass-on-bar";
  const auto errors = by_method(follow_path(falling).sheets[1])["newmark"];
  EXPECT_LT(errors[0], 0.1);
  EXPECT_LT(errors[1], 0.05);
}

// A step at which the errors of time and mesh are said to be equal is run.
TEST(Path, FindsTheStepBelowWhichTheMeshDecides) {
  auto coarse = request({"bdf1", "newmark"}, {{"t_end", 3.0}});
  coarse.nu = {4.0, 2.0, 1.0, 0.5};
  coarse.levels = 3;
  coarse.samples_per_level = 1;
  const auto study = follow_path(coarse);
  ASSERT_EQ(study.sheets.size(), 5u);
  EXPECT_EQ(study.sheets[0].rows.size(), 8u);
  EXPECT_EQ(study.runs.rows.size(), 24u);
  const auto& table = study.sheets[4];  // of newmark
  ASSERT_EQ(table.rows.size(), 3u);
  for (const auto& row : table.rows) {
    const double elements = record::number_in(row[0]), e_space = record::number_in(row[2]),
                 step = record::number_in(row.back());
    double largest = 0.0;
    for (const auto& run : study.runs.rows)
      if (record::number_in(run[1]) == elements)
        largest = std::max(largest, record::number_in(run[6]));
    EXPECT_EQ(e_space, largest);
    auto there = request({"newmark"}, {{"t_end", 3.0}, {"elements", elements}});
    there.nu = {step * elements};
    there.samples_per_level = 3;
    there.levels = 1;
    const auto run = follow_path(there).runs.rows.front();
    EXPECT_NEAR(record::number_in(run[5]), e_space, 0.2 * e_space) << elements;
  }
  // Of backward Euler finer steps would always help.
  EXPECT_TRUE(std::isnan(record::number_in(study.sheets[3].rows[0].back())));
  // Three meshes over less than an octave decide nothing.
  auto few = request({"newmark"});
  few.levels = 1;
  few.samples_per_level = 3;
  EXPECT_TRUE(reading(follow_path(few), 0).starts_with("undecided: u 0.6"));
  few.methods = {"newmark+penalty"};
  few.settings = {{"mass", "lumped"}, {"eta", 1.0}};
  EXPECT_TRUE(reading(follow_path(few), 0).starts_with("undecided: u 0.2"));
}

// Central differences as a program: the histories are its columns in memory.
class InMemory : public solvers::Solver {
 public:
  InMemory(const model::ImpactProblem<>& problem, std::size_t rows_between)
      : problem_(problem), rows_between_(rows_between) {}
  solvers::SolverOutput run(const solvers::SolverRun& run, const std::atomic<bool>*) override {
    model::TrajectorySink sink(false);
    methods::method("central-difference")->prepare(problem_, run.step)->advance(sink);
    const auto motion = std::make_shared<model::Trajectory>(sink.trajectory());
    const auto n = motion->dof;
    const auto stride = std::ptrdiff_t(rows_between_);
    input::NumberColumns columns{"run", (motion->t.size() - 1) / rows_between_ + 1, {}};
    columns.columns.push_back({"t", motion->t.data(), stride});
    for (int i = 0; i < n; ++i) {
      columns.columns.push_back({fmt::format("u{}", i + 1), motion->u.data() + i, stride * n});
      columns.columns.push_back({fmt::format("v{}", i + 1), motion->v.data() + i, stride * n});
    }
    solvers::SolverOutput output;
    output.history = columns;
    output.memory = motion;
    return output;
  }

 private:
  model::ImpactProblem<> problem_;
  std::size_t rows_between_;
};

TEST(Path, ProgramsHaveTheErrorsOfTheirMethod) {
  auto programs = request({"central-difference"});
  for (const std::size_t rows_between : {1u, 3u})
    programs.solvers.push_back({.name = fmt::format("program{}", rows_between),
                                .claim = {},
                                .tolerances = {},
                                .steps = {},
                                .prepare = [=](const cases::Case& problem) {
                                  return std::make_unique<InMemory>(problem.problem, rows_between);
                                }});
  const auto study = follow_path(programs);
  auto finest = by_method(study.sheets[1]);
  ASSERT_EQ(finest["program1"].size(), 6u);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(finest["program1"][i], finest["central-difference"][i],
                1e-9 * std::abs(finest["program1"][0]));
  EXPECT_EQ(reading(study, 1), "as expected");
  EXPECT_TRUE(reading(study, 2).starts_with("failed: Its history has no row at t = "));
  programs.solvers.front().tolerances = {1e-3};
  EXPECT_REFUSED(follow_path(programs), "not-admissible", "program1 chooses its steps");
}

TEST(Path, RefusesWithTheReason) {
  auto masses = request({"newmark"});
  masses.case_name = "stop";
  EXPECT_REFUSED(follow_path(masses), "no-closed-form", "bar-wall");
  auto still = request({"newmark"});
  still.nu = {0.45, 0.0};
  EXPECT_REFUSED(follow_path(still), "out-of-range", "path");
  auto many = request({"newmark"});
  many.levels = 9;
  many.samples_per_level = 1;
  EXPECT_REFUSED(follow_path(many), "out-of-range", "4000", "the finest of the 9 meshes");
  auto twice = request({"newmark"});
  twice.nu = {0.45, 0.45};
  EXPECT_REFUSED(follow_path(twice), "bad-syntax", "each number once");
  auto few = request({"newmark"});
  few.levels = few.samples_per_level = 1;
  EXPECT_REFUSED(follow_path(few), "out-of-range", "three meshes");
  EXPECT_REFUSED(follow_path(request({"dop853"})), "not-admissible", "chooses its steps");
  const auto study = follow_path(request({"newmark+penalty"}, {{"mass", "lumped"}}));
  EXPECT_EQ(reading(study, 0),
            "failed: with eta = 0: the law linear is elastic, so it models only eta = 1. Use "
            "penalty:law=kelvin-voigt or event-driven. [penalty-needs-elastic]");
  // Errors too large to be squared spoil no other row.
  auto unstable = request({"newmark", "central-difference"});
  unstable.nu = {0.45, 1.8};
  unstable.samples_per_level = 8;
  const auto of_all = follow_path(unstable);
  EXPECT_EQ(reading(of_all, 1), "as expected");
  EXPECT_EQ(reading(of_all, 3), "diverges");
  const std::atomic<bool> stop{true};
  const auto none = follow_path(request({"newmark"}), {}, &stop);
  EXPECT_TRUE(none.interrupted);
  EXPECT_TRUE(none.runs.rows.empty());
}

}  // namespace
}  // namespace clackers::study
