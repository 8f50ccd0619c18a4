#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "clackers/judge/testing/verdict_sequence.hpp"

namespace clackers::judge {
namespace {

using namespace synthetic;
using enum Behaviour;
using std::pow;

/// What an expert says of every ladder of one kind, whatever its shape.
struct Kind {
  std::string name;
  std::function<double(double)> error;
  Claim claim;
  Behaviour behaviour;
  Verdict verdict;
  std::string reason;
  double order = 0.0, within = 0.0;  ///< within 0: there is no line
};

struct KindOfShape {
  Kind kind;
  Shape shape;
};

void PrintTo(const KindOfShape& row, std::ostream* out) {
  *out << row.kind.name << ", " << row.shape.levels << " levels of " << row.shape.samples;
}

// Errors of the size that a motion of size one leaves, at h = 0.05 s and below.
std::vector<Kind> smooth_kinds() {
  std::vector<Kind> all;
  for (const int p : {1, 2, 3, 4}) {
    const auto order = std::to_string(p);
    const auto line = [p](double h) { return 0.2 * pow(h / 0.05, p); };
    all.push_back(
        {"order " + order, line, claims(p), proper, Verdict::agrees, "", double(p), 0.01});
    all.push_back({"order " + order + " where none is claimed",
                   line,
                   {},
                   proper,
                   Verdict::not_claimed,
                   "",
                   double(p),
                   0.01});
    all.push_back({"order " + order + " where an envelope of it is claimed", line,
                   claims_envelope(p), proper, Verdict::agrees, "", double(p), 0.01});
    all.push_back({"order " + order + " where one more is claimed", line, claims(p + 1), reduced,
                   Verdict::disagrees, "", double(p), 0.01});
    all.push_back({"order " + order + " where exactness is claimed",
                   line,
                   {exact, 0.0, ""},
                   proper,
                   Verdict::disagrees,
                   "",
                   double(p),
                   0.01});
    all.push_back({"order " + order + " where a floor is claimed", line, claims_floor(""), proper,
                   Verdict::disagrees, "", double(p), 0.01});
    all.push_back({"order " + order + " where divergence is claimed",
                   line,
                   {divergent, 0.0, ""},
                   proper,
                   Verdict::disagrees,
                   "",
                   double(p),
                   0.01});
  }
  all.push_back({"a constant", [](double) { return 0.2; }, claims(2), stagnating,
                 Verdict::disagrees, "unexplained-floor"});
  all.push_back({"a constant where nothing is claimed",
                 [](double) { return 0.2; },
                 {},
                 stagnating,
                 Verdict::not_claimed,
                 "unexplained-floor"});
  all.push_back({"growth", [](double h) { return 1e-6 / h; }, claims(1), divergent,
                 Verdict::disagrees, "error-growth", -1.0, 0.01});
  all.push_back({"nothing but zeros",
                 [](double) { return 0.0; },
                 {exact, 0.0, ""},
                 exact,
                 Verdict::agrees,
                 ""});
  all.push_back({"larger than the motion", [](double h) { return 1.9 + h; }, claims(2), undecided,
                 Verdict::undecided, "larger-than-motion"});
  return all;
}

std::vector<KindOfShape> smooth_shapes() {
  std::vector<KindOfShape> rows;
  for (const auto& kind : smooth_kinds())
    for (const Shape& shape : {Shape{.levels = 5, .samples = 1}, Shape{.levels = 5, .samples = 4},
                               Shape{.levels = 6, .samples = 2}, Shape{.levels = 8, .samples = 8}})
      rows.push_back({kind, shape});
  return rows;
}

// Ladders that need more levels, or samples, before an expert decides.
std::vector<KindOfShape> long_rows() {
  const Kind kinds[] = {
      {"order two bending to a floor", [](double h) { return h * h + 4e-7; }, claims(2), proper,
       Verdict::agrees, "unexplained-floor", 2.0, 0.1},
      {"order four that ends in noise",
       [](double h) {
         return 3e3 * pow(h, 4) + 3e-7 * pow(2.0, std::sin(7e3 / h) + std::sin(3e3 / h));
       },
       claims(4), proper, Verdict::agrees, "noise-floor", 4.0, 0.2},
      {"order two that ends in a smooth floor", [](double h) { return 5.0 * h * h + 1e-4; },
       claims(2), stagnating, Verdict::disagrees, "unexplained-floor", 2.0, 0.1},
      {"a dip before a wrong limit", [](double h) { return std::abs(20.0 * h * h - 2e-4); },
       claims(2), stagnating, Verdict::disagrees, "unexplained-floor", 2.0, 0.05},
      {"order one with a cancellation", [](double h) { return std::abs(h * h - 0.006 * h); },
       claims(1), proper, Verdict::agrees, "errors-cancel", 1.0, 1e-9},
      {"order one with a cancellation where two is claimed",
       [](double h) { return std::abs(h * h - 0.006 * h); }, claims(2), reduced, Verdict::disagrees,
       "errors-cancel", 1.0, 1e-9},
  };
  std::vector<KindOfShape> rows;
  for (const auto& kind : kinds)
    for (const Shape& shape : {Shape{.levels = 8, .samples = 4}, Shape{.levels = 8, .samples = 8}})
      rows.push_back({kind, shape});
  return rows;
}

class VerdictKinds : public testing::TestWithParam<KindOfShape> {};

TEST_P(VerdictKinds, AreJudgedAsAnExpertWouldWhateverTheirShape) {
  const auto& [kind, shape] = GetParam();
  const auto found = judge(scores_of(ladder(kind.error, shape)), kind.claim);
  const auto& fit = found.displacement;
  EXPECT_EQ(to_string(fit.behaviour), to_string(kind.behaviour));
  EXPECT_EQ(fit.reason, kind.reason);
  EXPECT_EQ(to_string(found.verdict), to_string(kind.verdict));
  EXPECT_EQ(fit.has_line, kind.within > 0.0) << fit.order;
  if (kind.within > 0.0) {
    EXPECT_NEAR(fit.order, kind.order, kind.within);
  }
}

auto name_of_kind = [](const testing::TestParamInfo<KindOfShape>& row) {
  return camel_case(row.param.kind.name) + std::to_string(row.param.shape.levels) + "Levels" +
         std::to_string(row.param.shape.samples) + "Samples";
};

INSTANTIATE_TEST_SUITE_P(AnyShape, VerdictKinds, testing::ValuesIn(smooth_shapes()), name_of_kind);
INSTANTIATE_TEST_SUITE_P(LongLadder, VerdictKinds, testing::ValuesIn(long_rows()), name_of_kind);

}  // namespace
}  // namespace clackers::judge
