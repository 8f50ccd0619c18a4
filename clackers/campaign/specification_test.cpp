#include "clackers/campaign/specification.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "clackers/base/testing/refusal.hpp"

namespace clackers::campaign {
namespace {

Specification read(const std::string& text) { return Specification::from_toml(text, "spec.toml"); }

const std::string head = "methods = [\"newmark\", \"rk4\"]\n";

std::string with_case(const std::string& rest) {
  return head + "[[cases]]\ncase = \"three-parameter\"\n" + rest;
}

std::map<std::string, double> values(const System& system) {
  std::map<std::string, double> out;
  for (const auto& [name, value] : system.settings) out[name] = value;
  return out;
}

TEST(Specification, LastParameterOfTheFileIsTheFastest) {
  const auto spec =
      read(with_case("set = { xi1 = { from = 0.0, to = 0.2, points = 3 }, N = [0, 2] }"));
  EXPECT_EQ(spec.systems(), 6);
  EXPECT_EQ(spec.tasks(), 12);
  EXPECT_EQ(values(spec.system(0)), (std::map<std::string, double>{{"N", 0}, {"xi1", 0}}));
  EXPECT_EQ(values(spec.system(1)), (std::map<std::string, double>{{"N", 2}, {"xi1", 0}}));
  EXPECT_EQ(values(spec.system(5)), (std::map<std::string, double>{{"N", 2}, {"xi1", 0.2}}));
  EXPECT_EQ(spec.parameters(), (std::vector<std::string>{"xi1", "N"}));
}

TEST(Specification, SystemsAreNumberedCaseAfterCase) {
  const auto spec = read(with_case("set = { N = [0, 1] }\n[[cases]]\ncase = \"stop\"\n"));
  EXPECT_EQ(spec.systems(), 3);
  EXPECT_EQ(spec.system(1).name, "three-parameter");
  EXPECT_EQ(spec.system(2).name, "stop");
  EXPECT_TRUE(spec.system(2).settings.empty());
}

TEST(Specification, RangesHoldBothEndsAndWholeNumbers) {
  const auto spec = read(with_case("set = { N = { from = 0, to = 6, points = 7 } }"));
  for (long long i = 0; i < 7; ++i) EXPECT_EQ(values(spec.system(i))["N"], double(i));
  const auto log =
      read(with_case("set = { xi1 = { from = 0.001, to = 0.1, points = 3, scale = \"log\" } }"));
  EXPECT_EQ(values(log.system(0))["xi1"], 0.001);
  EXPECT_NEAR(values(log.system(1))["xi1"], 0.01, 1e-16);
  EXPECT_EQ(values(log.system(2))["xi1"], 0.1);
}

TEST(Specification, ATrillionTasksAreCountedNotListed) {
  const auto spec =
      read(with_case("set = { xi1 = { from = 0, to = 0.1, points = 1000000 }, a_t = { from = 1, "
                     "to = 2, points = 1000000 } }"));
  EXPECT_EQ(spec.tasks(), 2000000000000);
  EXPECT_EQ(values(spec.system(spec.systems() - 1))["a_t"], 2.0);
}

TEST(Specification, SampledRangesAreOneAxisBehindListedValues) {
  const auto spec = read(
      with_case("set = { xi1 = { from = 0.0, to = 0.2 }, N = [1, 2], a_t = { from = 1, to = 3 } }\n"
                "sample = { kind = \"latin-hypercube\", points = 10, seed = 7 }"));
  EXPECT_EQ(spec.systems(), 20);
  std::set<int> strata;
  for (long long i = 0; i < 10; ++i) {
    EXPECT_EQ(values(spec.system(i))["N"], 1.0);
    EXPECT_EQ(values(spec.system(i))["xi1"], values(spec.system(i + 10))["xi1"]);
    strata.insert(int(values(spec.system(i))["a_t"] * 5.0 - 5.0));
  }
  EXPECT_EQ(strata.size(), 10u);  // one point in each tenth
}

TEST(Specification, MethodsMayBeThePanelAndPrograms) {
  const auto spec = read(
      "methods = [\"panel\", { exec = \"./solver {case} {h}\", name = \"mine\", expect = \"proper:2\" }]\n"
      "[[cases]]\ncase = \"stop\"");
  EXPECT_GT(spec.methods().size(), 2u);
  EXPECT_EQ(spec.methods().back().kind, MethodEntry::Kind::command);
  EXPECT_EQ(spec.methods().back().name, "mine");
}

TEST(Specification, RefusesInTheWordsOfALine) {
  EXPECT_REFUSED(read("metods = [\"rk4\"]"), "unknown-name", "spec.toml:1",
                 "Did you mean \"methods\"");
  EXPECT_REFUSED(read("methods = [\"newmrak\"]"), "unknown-name", "spec.toml:1", "\"newmark\"");
  EXPECT_REFUSED(read("methods = [\"rk4\", \"rk4\"]"), "bad-syntax", "each method once");
  EXPECT_REFUSED(read("methods = [\"rk4\", \"rk4+event-driven\"]"), "bad-syntax",
                 "each method once");
  EXPECT_REFUSED(read("methods = [\"rk4\"]\nmetrics = [\"u-max\", \"u-max\"]"), "bad-syntax",
                 "spec.toml:2", "each metric once");
  EXPECT_REFUSED(read("methods = []"), "bad-syntax", "one or more");
  EXPECT_REFUSED(read("methods = 4"), "bad-syntax", "methods");
  EXPECT_REFUSED(read(head), "no-column", "cases is missing");
  EXPECT_REFUSED(read(head + "[[cases]]\ncase = \"three-parametr\""), "unknown-name", "spec.toml:3",
                 "\"three-parameter\"");
  EXPECT_REFUSED(read(with_case("set = { Xi1 = 0.1 }")), "unknown-name", "spec.toml:4", "\"xi1\"");
  EXPECT_REFUSED(read(with_case("set = { xi1 = { from = 0, to = 1 } }")), "no-column",
                 "has no points", "points = 5");
  EXPECT_REFUSED(read(with_case("set = { xi1 = { from = 0, to = 1, points = 0 } }")),
                 "out-of-range", "points = 0");
  EXPECT_REFUSED(read(with_case("set = { xi1 = { from = 0, to = 1, points = 1 } }")),
                 "out-of-range", "2 points or more");
  EXPECT_REFUSED(
      read(with_case("set = { xi1 = { from = 0, to = 1, points = 3, scale = \"log\" } }")),
      "out-of-range", "above 0");
  EXPECT_REFUSED(read(with_case("set = { N = [1, \"two\"] }")), "not-a-number", "spec.toml:4",
                 "two");
  EXPECT_REFUSED(read(with_case("set = { N = [] }")), "bad-syntax", "one or more");
  EXPECT_REFUSED(read(with_case("sample = { kind = \"sobl\", points = 8 }")), "unknown-name",
                 "\"sobol\"");
  EXPECT_REFUSED(read(with_case("sample = { kind = \"sobol\", points = 8 }")), "bad-syntax",
                 "no range");
  EXPECT_REFUSED(read(with_case("set = { xi1 = { from = 0, to = 1, points = 2 } }\n"
                                "sample = { kind = \"sobol\", points = 8 }")),
                 "bad-syntax", "points of its own");
  EXPECT_REFUSED(read(head + "metrics = [\"nonsense\"]"), "unknown-name", "clackers list metrics");
  EXPECT_REFUSED(read(head + "[ladder]\nlevles = 3"), "unknown-name", "\"levels\"");
  EXPECT_REFUSED(read(head + "[ladder]\nlevels = 0"), "out-of-range", "levels = 0");
  EXPECT_REFUSED(read(head + "[ladder]\ntolerances = \"1e-3:x\""), "bad-syntax", "spec.toml:3");
  EXPECT_REFUSED(read("methods = [{ name = \"a\" }]"), "bad-syntax", "no exec");
  EXPECT_REFUSED(read("methods = [{ plugin = \"b\" }]"), "unknown-name", "clackers_main.h");
  EXPECT_REFUSED(read(with_case("set = { xi1 = { from = 0, to = 0.1, points = 1e15 }, a_t = { from "
                                "= 1, to = 2, points = 1e15 } }")),
                 "too-many-runs", "1e18");
}

TEST(SamplePoint, PermutesEveryLength) {
  for (const long long size : {1, 2, 3, 10, 63, 64, 65, 1000})
    for (const unsigned long long key : {0u, 1u, 12345u}) {
      std::set<long long> seen;
      for (long long i = 0; i < size; ++i) {
        const auto at = permuted(i, size, key);
        EXPECT_TRUE(at >= 0 && at < size);
        seen.insert(at);
      }
      EXPECT_EQ(static_cast<long long>(seen.size()), size) << size << ' ' << key;
    }
}

TEST(SamplePoint, PermutationsOfTwoKeysAreUnrelated) {
  constexpr long long size = 1000;
  double sum = 0.0, with_order = 0.0;
  for (long long i = 0; i < size; ++i) {
    const double x = double(permuted(i, size, 1)) / size - 0.5;
    sum += x * (double(permuted(i, size, 2)) / size - 0.5);
    with_order += x * (double(i) / size - 0.5);
  }
  // Correlations; of independent ones the standard deviation is 0.03.
  EXPECT_NEAR(12.0 * sum / size, 0.0, 0.12);
  EXPECT_NEAR(12.0 * with_order / size, 0.0, 0.12);
}

TEST(SamplePoint, SobolFillsDyadicIntervalsEvenly) {
  // Any 2^k - 1 first points behind 0, with it, have one in each interval of length 2^-k.
  const Sample sample{SampleKind::sobol, 63, 0};
  for (std::size_t d = 0; d < 5; ++d) {
    std::set<int> intervals{0};
    for (long long i = 0; i < 63; ++i) intervals.insert(int(64.0 * sample_point(sample, 5, i)[d]));
    EXPECT_EQ(intervals.size(), 64u) << d;
  }
  EXPECT_EQ(sample_point(sample, 2, 0), (std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(sample_point(sample, 2, 1), (std::vector<double>{0.75, 0.25}));
}

TEST(SamplePoint, SeedMovesAllKinds) {
  for (const auto kind : {SampleKind::latin_hypercube, SampleKind::sobol}) {
    const auto first = sample_point({kind, 16, 1}, 3, 5),
               second = sample_point({kind, 16, 2}, 3, 5);
    EXPECT_NE(first, second);
    EXPECT_EQ(first, sample_point({kind, 16, 1}, 3, 5));
  }
}

}  // namespace
}  // namespace clackers::campaign
