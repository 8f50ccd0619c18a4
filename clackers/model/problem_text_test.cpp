#include "clackers/model/problem_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "clackers/base/files/json.hpp"
#include "clackers/base/testing/refusal.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::model {
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
  const auto file = parse_json(problem_file_json("a \"b\"", two_masses()));
  EXPECT_EQ(file["schema"], "clackers/problem/1");
  EXPECT_EQ(file["case"], "a \"b\"");
  const auto expected = parse_json(R"({
    "M": [[1, 0], [0, 2]], "C": [[0.1, -0.1], [-0.1, 0.3]], "K": [[4, -1.5], [-1.5, 5]],
    "contacts": [{"direction": [1, -1], "gap": -0.25, "restitution": 0.5},
                 {"direction": [0, 1], "gap": -1, "restitution": 1}],
    "start": {"t": 0, "u": [0.3333333333333333, 0], "v": [0, -1e-7]}, "end": 20})");
  EXPECT_EQ(file["problem"], expected);
}

TEST(ProblemText, JsonHasTheMesh) {
  const Mesh mesh{NodeMass::consistent,
                  {{0, -0.5, 0}, {0, 0.0, std::nullopt, true}, {1, 0.0, 1}},
                  {{0, 1, 3.0, 0.25}}};
  EXPECT_EQ(parse_json(problem_file_json("a", two_masses(), mesh))["mesh"], parse_json(R"({
    "mass": "consistent",
    "nodes": [{"body": 1, "x": -0.5, "dof": 1, "fixed": false},
              {"body": 1, "x": 0, "dof": null, "fixed": true},
              {"body": 2, "x": 0, "dof": 2, "fixed": false}],
    "elements": [{"nodes": [1, 2], "stiffness": 3, "density": 0.25}]})"));
}

TEST(ProblemText, LinesHaveAFixedOrder) {
  EXPECT_EQ(problem_file_text(two_masses()),
            "dof=2\ncontacts=2\nt=0\nend=20\nu=0.3333333333333333 0\nv=0 -1e-07\n"
            "M1=1 0\nM2=0 2\nC1=0.1 -0.1\nC2=-0.1 0.3\nK1=4 -1.5\nK2=-1.5 5\n"
            "direction1=1 -1\ngap1=-0.25\nrestitution1=0.5\n"
            "direction2=0 1\ngap2=-1\nrestitution2=1\n");
}

TEST(ProblemText, LinesAndJsonReadBackToTheSameProblem) {
  const auto problem = two_masses();
  const auto text = problem_file_text(problem);
  for (const auto& written : {text, problem_json(problem), problem_file_json("a", problem)}) {
    const auto read = problem_from_text(written, "f");
    EXPECT_EQ(problem_file_text(read), text);
    EXPECT_EQ(read.system.stiffness(0, 1), -1.5);
  }
}

TEST(ProblemText, RefusesOtherLines) {
  const auto read = [](std::string_view from, std::string_view to) {
    auto text = problem_file_text(two_masses());
    text.replace(text.find(from), from.size(), to);
    return problem_from_text(text, "f");
  };
  EXPECT_REFUSED(read("v=0", "v=x"), "bad-syntax", "f:6: \"x\" is no number");
  EXPECT_REFUSED(read("v=0", "v 0"), "bad-syntax", "f:6: \"v 0 -1e-07\"");
  EXPECT_REFUSED(read("v=0", "w=0"), "unknown-name", "unknown key \"w\"");
  EXPECT_REFUSED(read("v=0", "loads=3\nv=0"), "bad-syntax", "loads is no list of tables");
  EXPECT_REFUSED(read("M2=0 2", "M2=0"), "wrong-size", "row 2 of M has 1 numbers");
  EXPECT_REFUSED(read("K2=-1.5 5\n", ""), "wrong-size", "K has 1 rows");
  EXPECT_REFUSED(read("direction1=1 -1\n", ""), "bad-syntax", "f:13: \"gap1=-0.25\"");
  EXPECT_REFUSED(read("direction2", "load1=1 2 3\ndirection2"), "bad-syntax", "\"load1=1 2 3\"");
  EXPECT_REFUSED(read("direction2", "spring1=1 2\ndirection2"), "bad-syntax", "\"spring1=1 2\"");
}

TEST(ProblemText, RefusesLawsThatNoRowStates) {
  auto problem = two_masses();
  problem.unstated = "a round wall";
  for (const auto& written :
       {problem_file_text(problem), problem_json(problem), problem_file_json("a", problem)})
    EXPECT_REFUSED(problem_from_text(written, "f"), "not-stated", "\"a round wall\"");
}

TEST(ProblemText, RefusesOtherJson) {
  EXPECT_REFUSED(problem_from_text("{\"M\": [[1]}", "f"), "bad-syntax", "f: not JSON");
  EXPECT_REFUSED(problem_from_text("{\"M\": null}", "f"), "bad-syntax", "f: null");
  EXPECT_REFUSED(problem_from_text("{\"problem\": 3}", "f"), "bad-syntax", "problem is no object");
  EXPECT_REFUSED(problem_from_text("{\"M\": " + std::string(100000, '['), "f"), "bad-syntax", "f:");
  EXPECT_REFUSED(problem_from_text("{\"M\": [[[[[[[[[[[1]]]]]]]]]]]}", "f"), "bad-syntax",
                 "deep nesting");
  EXPECT_REFUSED(problem_from_text("{\"N\": [[1]]}", "f"), "unknown-name", "f: unknown key \"N\"");
}

TEST(ProblemText, HarmonicLoadsAndSpringsAreNumbers) {
  auto problem = two_masses();
  problem.system.add_load = model::HarmonicLoad({{0, 2.0, 3.0, -0.5}, {1, 1.0, 0.0, 0.0}});
  problem.system.nonlinear = std::make_shared<model::OneSidedSprings>(
      std::exchange(problem.contacts, {}), std::vector<double>{400.0, 500.0});
  const auto json = parse_json(problem_json(problem));
  EXPECT_EQ(json["loads"], parse_json(R"([
    {"dof": 1, "amplitude": 2, "frequency": 3, "phase": -0.5},
    {"dof": 2, "amplitude": 1, "frequency": 0, "phase": 0}])"));
  EXPECT_EQ(json["springs"], parse_json(R"([
    {"direction": [1, -1], "gap": -0.25, "stiffness": 400},
    {"direction": [0, 1], "gap": -1, "stiffness": 500}])"));
  const auto text = problem_file_text(problem);
  EXPECT_TRUE(
      text.ends_with("load1=1 2 3 -0.5\nload2=2 1 0 0\n"
                     "spring1=1 -1 -0.25 400\nspring2=0 1 -1 500\n"));
  EXPECT_EQ(problem_file_text(problem_from_text(problem_json(problem), "f")), text);
  const auto read = problem_from_text(text, "f");
  EXPECT_EQ(problem_file_text(read), text);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(2);
  read.system.add_load(0.7, {force.data(), 2});
  EXPECT_EQ(force, Eigen::Vector2d(2.0 * std::cos(3.0 * 0.7 - 0.5), 1.0));
}

TEST(ProblemText, FrictionOfAContactNamesIt) {
  auto problem = two_masses();
  problem.frictions = {{Eigen::Vector2d(1.0, 0.0), 0.5, 0.25, 2.0},
                       {Eigen::Vector2d(0.0, 3.0), 0.75, 0.75, -1.0, 1}};
  EXPECT_EQ(parse_json(problem_json(problem))["frictions"], parse_json(R"([
    {"direction": [1, 0], "limit": 0.5, "kinetic": 0.25, "velocity": 2},
    {"direction": [0, 3], "coefficient": 0.75, "velocity": -1, "contact": 2}])"));
  const auto text = problem_file_text(problem);
  EXPECT_TRUE(text.ends_with("friction1=1 0 0.5 0.25 2\nrubbing2=0 3 0.75 -1 2\n"));
  for (const auto& written : {text, problem_json(problem)}) {
    const auto read = problem_from_text(written, "f");
    EXPECT_EQ(problem_file_text(read), text);
    EXPECT_FALSE(read.frictions.at(0).contact);
    EXPECT_EQ(read.frictions.at(1).contact, 1U);
    EXPECT_EQ(read.frictions[1].kinetic, 0.75);
    EXPECT_EQ(with_dof<2>(read).frictions[1].contact, 1U);
  }
  const auto change = [&](std::string_view from, std::string_view to) {
    auto changed = problem_json(problem);
    changed.replace(changed.find(from), from.size(), to);
    return problem_from_text(changed, "f");
  };
  EXPECT_REFUSED(change("\"contact\": 2", "\"contact\": 3"), "out-of-range",
                 "contact = 3; allowed: a whole number, 1 to 2");
  EXPECT_REFUSED(change("\"contact\": 2", "\"contact\": 0"), "out-of-range", "contact = 0");
  EXPECT_REFUSED(change("\"coefficient\": 0.75", "\"limit\": 0.75"), "unknown-name",
                 "of the friction of a contact");
  EXPECT_REFUSED(change("\"coefficient\": 0.75", "\"coefficient\": -1"), "out-of-range",
                 "coefficient = -1");
  problem.frictions[1].contact = 2;
  EXPECT_REFUSED(validate(problem), "out-of-range", "friction 2", "contact = 3");
  problem.frictions[1].contact = 0;
  problem.frictions[1].kinetic = 0.5;
  EXPECT_REFUSED(validate(problem), "out-of-range", "one coefficient");
}

TEST(ProblemText, RefusesOtherLoads) {
  auto problem = two_masses();
  problem.system.add_load = [](double, std::span<double>) {};
  EXPECT_REFUSED(problem_json(problem), "linear-only", "harmonic loads");
  EXPECT_REFUSED(problem_file_text(problem), "linear-only", "load");
}

}  // namespace
}  // namespace clackers::model
