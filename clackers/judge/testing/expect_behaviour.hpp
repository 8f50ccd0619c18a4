#pragma once

#include <gtest/gtest.h>

#include <string>

#include "clackers/judge/convergence/assessment.hpp"

// For tests of the fitter.
namespace clackers::judge {

inline std::string text(const LadderFit& fit) {
  return std::string(to_string(fit.behaviour)) + " (" + fit.reason + ") order " +
         std::to_string(fit.order) + " +- " + std::to_string(fit.spread) + " scatter " +
         std::to_string(fit.scatter) + " levels " + std::to_string(fit.first_level) + ".." +
         std::to_string(fit.last_level);
}

}  // namespace clackers::judge

/// Expects a behaviour with its reason and shows the whole fit where it is another one.
#define EXPECT_BEHAVIOUR(fit, expected, why)                                   \
  do {                                                                         \
    const auto found = (fit);                                                  \
    EXPECT_EQ(to_string(found.behaviour), to_string(expected)) << text(found); \
    EXPECT_EQ(found.reason, why) << text(found);                               \
  } while (false)
