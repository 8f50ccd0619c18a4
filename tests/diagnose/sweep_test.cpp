// Causes fitted by exact simulation over generated histories: every fault on every case that can
// have it, and correct solvers, which must have no cause but their error of period.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "clackers/diagnose/causes.hpp"
#include "clackers/diagnose/testing/wrong_solvers.hpp"

namespace clackers::diagnose::testing {
namespace {

TEST(SystemCauses, AreFoundOnEveryCase) {
  int all = 0, found = 0;
  std::map<std::string, int> histories;
  for (const auto& fault : faults())
    for (const auto& test_case : system_cases())
      for (const bool fourth_order : {true, false}) {
        auto problem = test_case.problem;
        std::string solver = fourth_order ? "method=rk4" : "method=newmark";
        if (!fault.put(problem, solver)) continue;
        ++all;
        ++histories[fault.code];
        const auto causes = system_causes(solved(test_case, problem, solver, 0.3, 4).question());
        const bool hit =
            causes.size() == 1 && causes[0].code == fault.code &&
            (std::isnan(fault.value) || std::abs(causes[0].value - fault.value) <= fault.within());
        found += hit;
        if (!hit)
          ADD_FAILURE() << fault.name << ", " << name_of(test_case) << ", order "
                        << (fourth_order ? 4 : 2) << ": "
                        << (causes.empty() ? "nothing" : causes[0].code) << ' '
                        << (causes.empty() ? 0.0 : causes[0].value);
      }
  RecordProperty("found", found);
  EXPECT_GE(all, 20 * 18);
  for (const auto& [code, count] : histories) EXPECT_GE(count, 20) << code;
}

TEST(SystemCauses, CorrectSolversHaveNone) {
  int all = 0;
  for (const auto& right : right_solvers())
    for (const auto& test_case : system_cases())
      for (const auto& [turn, count, digits] :
           {std::tuple{0.6, 1, 17}, {0.6, 3, 17}, {0.25, 1, 17}, {0.25, 2, 6}, {0.25, 4, 17}}) {
        ++all;
        for (const auto& one : system_causes(
                 solved(test_case, test_case.problem, right, turn, count, digits).question()))
          EXPECT_EQ(one.code, "period-error")
              << right << ", " << name_of(test_case) << ", " << count << " files from " << turn
              << ": " << one.value << ' ' << one.unit << ", gain " << one.fact("gain");
      }
  EXPECT_GE(all, 500);
}

}  // namespace
}  // namespace clackers::diagnose::testing
