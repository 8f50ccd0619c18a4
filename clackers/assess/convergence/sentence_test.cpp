#include "clackers/assess/convergence/sentence.hpp"

#include <gtest/gtest.h>

namespace clackers::assess {
namespace {

LadderFit fit(Behaviour behaviour, std::string reason = "") {
  LadderFit found;
  found.behaviour = behaviour;
  found.reason = std::move(reason);
  found.order = 1.036;
  found.spread = 0.071;
  found.scatter = 23.4;
  found.floor = 0.0345;
  found.first_level = 1;
  found.last_level = 2;
  found.steps = {0.1, 0.05, 0.025};
  return found;
}

TEST(Sentence, SaysWhatWasMeasuredWithItsNumbers) {
  EXPECT_EQ(describe(fit(Behaviour::exact)),
            "The displacement error lies at the rounding floor at every level.");
  EXPECT_EQ(describe(fit(Behaviour::proper)),
            "The displacement error falls as h^1.04 (+- 0.07) from h = 0.05 s to 0.025 s.");
  EXPECT_EQ(describe(fit(Behaviour::reduced)), describe(fit(Behaviour::proper)));
  EXPECT_EQ(
      describe(fit(Behaviour::irregular)),
      "The displacement error scatters by a factor of 23 between neighbouring steps; its upper "
      "envelope falls as h^1.04 (+- 0.07) from h = 0.05 s to 0.025 s.");
  EXPECT_EQ(describe(fit(Behaviour::stagnating, "tolerance-floor")),
            "The displacement error stays at 0.035 from h = 0.05 s to 0.025 s. The floor is an "
            "iteration tolerance of the method; tighten it.");
  EXPECT_EQ(describe(fit(Behaviour::divergent, "error-growth")),
            "The method diverges. The error grew when the step was refined.");
  EXPECT_EQ(describe(fit(Behaviour::undecided, "run-failed")),
            "Nothing can be said. Runs ended before their end time; the first failure is quoted.");
}

TEST(Sentence, NamesTheQuantityOfTheLadder) {
  EXPECT_EQ(describe(fit(Behaviour::exact), "difference between runs"),
            "The difference between runs lies at the rounding floor at every level.");
  EXPECT_EQ(describe(fit(Behaviour::proper), "velocity error"),
            "The velocity error falls as h^1.04 (+- 0.07) from h = 0.05 s to 0.025 s.");
  EXPECT_EQ(describe(fit(Behaviour::irregular), "velocity error").find("The velocity error"), 0u);
  EXPECT_EQ(describe(fit(Behaviour::stagnating), "velocity error").find("The velocity error"), 0u);
}

TEST(Sentence, SaysWhatIsClaimed) {
  EXPECT_EQ(describe(Claim{Behaviour::proper, 2.0, ""}), "proper of order 2");
  EXPECT_EQ(describe(Claim{Behaviour::reduced, 1.5, ""}), "reduced of order 1.5");
  EXPECT_EQ(describe(Claim{Behaviour::irregular, 1.0, ""}),
            "irregular with an envelope of order 1");
  EXPECT_EQ(describe(Claim{Behaviour::stagnating, 0.0, "contact-stiffness"}),
            "stagnating (contact-stiffness)");
  EXPECT_EQ(describe(Claim{Behaviour::exact, 0.0, ""}), "exact");
  EXPECT_EQ(describe(Claim{}), "nothing");
}

}  // namespace
}  // namespace clackers::assess
