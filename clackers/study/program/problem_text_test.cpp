#include "clackers/study/program/problem_text.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "clackers/base/testing/refusal.hpp"

namespace clackers::study {
namespace {

model::ImpactProblem<> two_masses() {
  model::ImpactProblem<> problem;
  auto& system = problem.system;
  system.mass = Eigen::MatrixXd{{1.0, 0.0}, {0.0, 2.0}};
  system.damping = Eigen::MatrixXd{{0.1, -0.1}, {-0.1, 0.3}};
  system.stiffness = Eigen::MatrixXd{{4.0, -1.5}, {-1.5, 5.0}};
  problem.contacts.push_back({Eigen::VectorXd{{1.0, -1.0}}, -0.25, 0.5});
  problem.contacts.push_back({Eigen::VectorXd{{0.0, 1.0}}, -1.0, 1.0});
  problem.start = {0.0, Eigen::VectorXd{{1.0 / 3.0, 0.0}}, Eigen::VectorXd{{0.0, -1e-7}}};
  problem.end = 20.0;
  return problem;
}

TEST(ProblemText, JsonHasMatricesContactsStartAndEnd) {
  const auto file = nlohmann::json::parse(problem_file_json("a \"b\"", two_masses()));
  EXPECT_EQ(file["schema"], "clackers/problem/1");
  EXPECT_EQ(file["case"], "a \"b\"");
  const auto expected = nlohmann::json::parse(R"({
    "M": [[1, 0], [0, 2]], "C": [[0.1, -0.1], [-0.1, 0.3]], "K": [[4, -1.5], [-1.5, 5]],
    "contacts": [{"direction": [1, -1], "gap": -0.25, "restitution": 0.5},
                 {"direction": [0, 1], "gap": -1, "restitution": 1}],
    "start": {"t": 0, "u": [0.3333333333333333, 0], "v": [0, -1e-7]}, "end": 20})");
  EXPECT_EQ(file["problem"], expected);
}

TEST(ProblemText, LinesHaveAFixedOrder) {
  EXPECT_EQ(problem_file_text(two_masses()),
            "dof=2\ncontacts=2\nt=0\nend=20\nu=0.3333333333333333 0\nv=0 -1e-07\n"
            "M1=1 0\nM2=0 2\nC1=0.1 -0.1\nC2=-0.1 0.3\nK1=4 -1.5\nK2=-1.5 5\n"
            "direction1=1 -1\ngap1=-0.25\nrestitution1=0.5\n"
            "direction2=0 1\ngap2=-1\nrestitution2=1\n");
}

TEST(ProblemText, LinesReadBackToTheSameProblem) {
  const auto text = problem_file_text(two_masses());
  EXPECT_EQ(problem_file_text(problem_from_text(text)), text);
  EXPECT_EQ(problem_from_text(text).system.stiffness(0, 1), -1.5);
}

TEST(ProblemText, RefusesOtherLines) {
  const auto text = problem_file_text(two_masses());
  EXPECT_REFUSED(problem_from_text(""), "bad-syntax", "dof= and 1 numbers");
  EXPECT_REFUSED(problem_from_text(text.substr(0, text.find("gap2"))), "bad-syntax", "gap2");
  for (const auto* change : {"v=0 -1e-07 3", "v=0", "v=0 x", "w=0 -1e-07"}) {
    auto other = text;
    other.replace(other.find("v=0"), std::string_view("v=0 -1e-07").size(), change);
    EXPECT_REFUSED(problem_from_text(other), "bad-syntax", "v= and 2 numbers");
  }
}

TEST(ProblemText, RefusesOtherSizes) {
  for (const auto* size : {"-1", "1.5", "1e300", "9999"}) {
    auto other = problem_file_text(two_masses());
    other.replace(0, std::string_view("dof=2").size(), std::string("dof=") + size);
    EXPECT_REFUSED(problem_from_text(other), "bad-syntax", "problem: dof = ");
  }
}

TEST(ProblemText, RefusesALoad) {
  auto problem = two_masses();
  problem.system.add_load = [](double, std::span<double>) {};
  EXPECT_REFUSED(problem_json(problem), "linear-only", "load");
  EXPECT_REFUSED(problem_file_text(problem), "linear-only", "load");
}

}  // namespace
}  // namespace clackers::study
