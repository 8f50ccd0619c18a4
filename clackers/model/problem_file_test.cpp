#include "clackers/model/problem_file.hpp"

#include <gtest/gtest.h>

#include <string>

#include "clackers/base/testing/refusal.hpp"
#include "clackers/model/harmonic_load.hpp"

namespace clackers::model {
namespace {

// Two masses; each test changes one line.
const std::string pair = R"(M = [[2, 0], [0, 1]]
K = [[2, 0], [0, 9]]
C = [[0.2, 0], [0, 0.1]]
end = 20
[start]
u = [1, -0.5]
v = [0, 0.25]
[[contacts]]
direction = [1, -1]
gap = -0.125
restitution = 0.5
[[loads]]
dof = 2
amplitude = 3
frequency = 1.5
phase = 0.5
)";

std::string with(const std::string& from, const std::string& to) {
  auto text = pair;
  text.replace(text.find(from), from.size(), to);
  return text;
}
auto read(const std::string& text) { return problem_from_text(text, "f.toml"); }

TEST(ProblemFile, HasEveryNumberInItsPlace) {
  const auto problem = read(pair);
  EXPECT_EQ(problem.system.mass, (Eigen::MatrixXd{{2.0, 0.0}, {0.0, 1.0}}));
  EXPECT_EQ(problem.system.stiffness, (Eigen::MatrixXd{{2.0, 0.0}, {0.0, 9.0}}));
  EXPECT_EQ(problem.system.damping, (Eigen::MatrixXd{{0.2, 0.0}, {0.0, 0.1}}));
  EXPECT_EQ(problem.end, 20.0);
  EXPECT_EQ(problem.start.u, (Eigen::VectorXd{{1.0, -0.5}}));
  EXPECT_EQ(problem.start.v, (Eigen::VectorXd{{0.0, 0.25}}));
  ASSERT_EQ(problem.contacts.size(), 1u);
  EXPECT_EQ(problem.contacts[0].direction, (Eigen::VectorXd{{1.0, -1.0}}));
  EXPECT_EQ(problem.contacts[0].gap, -0.125);
  EXPECT_EQ(problem.contacts[0].restitution, 0.5);
  const auto* load = problem.system.add_load.target<model::HarmonicLoad>();
  ASSERT_NE(load, nullptr);
  ASSERT_EQ(load->forces().size(), 1u);
  const auto& f = load->forces()[0];
  EXPECT_EQ(f.dof, 1);
  EXPECT_EQ(f.amplitude, 3.0);
  EXPECT_EQ(f.frequency, 1.5);
  EXPECT_EQ(f.phase, 0.5);
}

TEST(ProblemFile, WhatIsOptionalHasItsDefault) {
  const auto problem = read(
      "M = [[1]]\nK = [[4.0]]\nend = 3\nstart = { u = [1] }\n"
      "[[contacts]]\ndirection = [1]\n");
  EXPECT_EQ(problem.system.damping(0, 0), 0.0);
  EXPECT_EQ(problem.start.v[0], 0.0);
  EXPECT_EQ(problem.contacts[0].gap, 0.0);
  EXPECT_EQ(problem.contacts[0].restitution, 1.0);
  EXPECT_FALSE(problem.system.add_load);
}

TEST(ProblemFile, AContactWithAStiffnessIsASpring) {
  const auto problem = read(with("restitution = 0.5", "stiffness = 400"));
  EXPECT_TRUE(problem.contacts.empty());
  const auto* springs = one_sided_springs(problem);
  ASSERT_NE(springs, nullptr);
  EXPECT_EQ(springs->stiffnesses(), std::vector{400.0});
  EXPECT_EQ(springs->contacts()[0].gap, -0.125);
  EXPECT_REFUSED(read(with("restitution = 0.5", "restitution = 0.5\nstiffness = 400")),
                 "penalty-needs-elastic", "f.toml:", "0.5");
  EXPECT_REFUSED(read(with("[[loads]]", "[[springs]]\ndirection = [1, 0]\n[[loads]]")), "no-column",
                 "stiffness is missing");
  EXPECT_REFUSED(read(with("restitution = 0.5", "stiffness = -1")), "out-of-range", "f.toml:11");
}

TEST(ProblemFile, NumbersMayBeFractionsInQuotes) {
  EXPECT_EQ(read(with("gap = -0.125", "gap = \"-1/8\"")).contacts[0].gap, -0.125);
  EXPECT_EQ(read(with("u = [1, -0.5]", "u = [\"4/3\", -0.5]")).start.u[0], 4.0 / 3.0);
  EXPECT_REFUSED(read(with("end = 20", "end = \"1/0\"")), "not-finite", "end = 1/0");
}

TEST(ProblemFile, NegativeZeroIsZero) {
  for (const auto* zero : {"-0.0", "\"-0\"", "\"-5e-324/3\""}) {
    const auto problem = read(with("gap = -0.125", std::string("gap = ") + zero));
    const auto text = problem_json(problem);
    EXPECT_EQ(problem_json(read(text)), text) << zero;
  }
}

TEST(ProblemFile, AMatrixThatRoundingLeftUnsymmetricIsTheMeanOfBothEntries) {
  const auto problem = read(with("K = [[2, 0], [0, 9]]", "K = [[2, 1.00000000000004], [1, 9]]"));
  const auto& stiffness = problem.system.stiffness;
  EXPECT_EQ(stiffness(0, 1), stiffness(1, 0));
  EXPECT_EQ(stiffness(0, 1), 1.00000000000002);
  // The neighbour of 1 and 1: their mean is halfway, and even.
  EXPECT_EQ(read(with("K = [[2, 0], [0, 9]]", "K = [[2, 1], [1.0000000000000002, 9]]"))
                .system.stiffness(1, 0),
            1.0);
}

TEST(ProblemFile, BadTextIsRefusedWithItsLine) {
  EXPECT_REFUSED(read("M = [[1]\nend = "), "bad-syntax", "f.toml:");
  EXPECT_REFUSED(read(with("end = 20", "ned = 20")), "unknown-name",
                 "f.toml:4: unknown key \"ned\"", "Did you mean \"end\"?", "Known: M, C, K");
  EXPECT_REFUSED(read(with("gap =", "gaps =")), "unknown-name", "f.toml:10", "of a contact",
                 "Did you mean \"gap\"?");
  EXPECT_REFUSED(read(with("end = 20\n", "")), "no-column", "end is missing",
                 "end of the run in s");
  EXPECT_REFUSED(read(with("dof = 2\n", "")), "no-column", "f.toml:12", "dof is missing");
  EXPECT_REFUSED(read(with("end = 20", "end = \"late\"")), "not-a-number", "f.toml:4",
                 "end is no number");
  EXPECT_REFUSED(read(with("end = 20", "end = inf")), "not-finite", "f.toml:4", "end = inf");
  EXPECT_REFUSED(read(with("end = 20", "end = -1")), "out-of-range", "end = -1", "above 0 s");
  EXPECT_REFUSED(read(with("[[contacts]]", "[contacts]")), "bad-syntax", "no list of tables",
                 "[[contacts]]");
  EXPECT_REFUSED(read(with("[start]", "[[start]]")), "bad-syntax", "start is no table");
  EXPECT_REFUSED(read("{\"M\": [[1e309]]}"), "bad-syntax", "f.toml: not JSON");
}

TEST(ProblemFile, BadSizesAndMatricesAreRefused) {
  EXPECT_REFUSED(read(with("M = [[2, 0], [0, 1]]", "M = [[2, 0], [0]]")), "wrong-size", "f.toml:1",
                 "row 2 of M has 1 numbers", "2 numbers");
  EXPECT_REFUSED(read(with("K = [[2, 0], [0, 9]]", "K = [[2]]")), "wrong-size", "f.toml:2",
                 "K has 1 rows", "2 rows, as M has");
  EXPECT_REFUSED(read(with("K = [[2, 0], [0, 9]]", "K = 2")), "wrong-size", "K has 0 rows");
  EXPECT_REFUSED(read(with("u = [1, -0.5]", "u = [1]")), "wrong-size", "f.toml:6",
                 "u has 1 numbers");
  EXPECT_REFUSED(read(with("direction = [1, -1]", "direction = [1, -1, 0]")), "wrong-size",
                 "f.toml:9", "direction has 3 numbers");
  EXPECT_REFUSED(read(with("direction = [1, -1]", "direction = [0, 0]")), "out-of-range",
                 "direction = 0");
  EXPECT_REFUSED(read(with("K = [[2, 0], [0, 9]]", "K = [[2, 1], [0, 9]]")), "not-symmetric",
                 "f.toml:2", "K(1,2) = 1 and K(2,1) = 0");
  // Rounding of another entry, not of this one.
  EXPECT_REFUSED(read(with("C = [[0.2, 0], [0, 0.1]]", "C = [[1e6, 1e-3], [1.000001e-3, 0.1]]")),
                 "not-symmetric", "f.toml:3", "C(1,2) = 0.001");
  EXPECT_REFUSED(read(with("M = [[2, 0], [0, 1]]", "M = [[1, 2], [2, 1]]")),
                 "not-positive-definite", "f.toml: problem: the mass matrix");
  EXPECT_REFUSED(read(with("u = [1, -0.5]", "u = [-1, 0.5]")), "starts-in-contact", "contact 1");
  EXPECT_REFUSED(read(with("restitution = 0.5", "restitution = 1.5")), "out-of-range", "f.toml:11",
                 "restitution = 1.5");
  EXPECT_REFUSED(read(with("dof = 2", "dof = 3")), "out-of-range", "f.toml:13", "dof = 3",
                 "1 to 2");
  EXPECT_REFUSED(read(with("frequency = 1.5", "frequency = -1")), "out-of-range", "frequency = -1");
  std::string large = "M = [";
  for (int i = 0; i < 1001; ++i) large += "[0],";
  EXPECT_REFUSED(read(large + "]\n"), "out-of-memory", "M has 1001 rows", "up to 1000");
}

TEST(ProblemFile, UnitsThatCannotBeMeantAreRefused) {
  EXPECT_REFUSED(read(with("K = [[2, 0], [0, 9]]", "K = [[2e12, 0], [0, 9]]")), "out-of-range",
                 "oscillates", "kg, m, s and N");
  EXPECT_REFUSED(read(with("end = 20", "end = 2e-5")), "out-of-range", "nothing moves");
  EXPECT_NO_THROW(read("M = [[1]]\nK = [[1e-12]]\nend = 10\n[start]\nu = [1]\nv = [-1]\n"));
  EXPECT_REFUSED(read(with("v = [0, 0.25]", "v = [4e8, 0.25]")), "out-of-range",
                 "above that of light");
}

}  // namespace
}  // namespace clackers::model
