#include "paper/rendering/page.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clackers::paper {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Drawn drawn() {
  Drawn out;
  out.figure.name = "figA3";
  out.figure.title = "A <title>";
  out.figure.caption = "The caption & more";
  out.figure.claims = {{"It says a < b", "1 < 2", true}, {"It says more", "0", false}};
  out.figure.choices = {"We took 3"};
  out.svg = "<svg a=\"1\">é#</svg>\n";
  out.files = {"figA3.svg"};
  return out;
}

TEST(Page, ShowsPictureCaptionClaimsAndFiles) {
  const auto text = page({drawn()}, "clackers paper figA3 --out x");
  for (const auto* part :
       {"Figure A.3. A &lt;title&gt;",
        "\"data:image/svg+xml,%3Csvg a=%221%22%3E%C3%A9%23%3C/svg%3E%0A\"",
        "The caption &amp; more", "It says a &lt; b",
        "<span class=\"badge holds\">holds</span></td>",
        "<span class=\"badge differs\">differs</span></td>", "We took 3",
        "<a href=\"figA3.svg\">figA3.svg</a>", "1 of 2 claims", "clackers paper figA3 --out x"})
    EXPECT_TRUE(contains(text, part)) << part;
}

TEST(Page, NeedsNothingFromANetwork) {
  const auto text = page({drawn()}, "");
  for (const auto* part : {"http:", "https:", "src=\"/", "<link rel=\"stylesheet", "@import"})
    EXPECT_FALSE(contains(text, part)) << part;
}

TEST(Page, SaysWhereAPictureIsMissing) {
  auto one = drawn();
  one.svg.clear();
  const auto text = page({one}, "");
  EXPECT_TRUE(contains(text, "This figure could not be drawn"));
  EXPECT_FALSE(contains(text, "data:image/svg"));
}

// Found without the library: r* by a scan of its definition; floor(sqrt(81 + 17/0.1)/2) = 7,
// floor(sqrt(81 + 17/0.001)/2) = 65, and for N = 0 floor(sqrt(31)/2) = 2.
TEST(Page, OpenPointsHaveTheLimitsOfTheMassRatioAndTheHarmonicsOfTwoThresholds) {
  const auto text = page({}, "");
  std::string limits = "r* = ";
  for (const double X : {5.0, 9.0, 21.0, 41.0, 81.0}) {
    double least = 0.0;
    for (int i = 1; i < 400'000; ++i) {
      const double theta = 0.5 * std::numbers::pi * i / 400'000;
      least = std::min(least, std::sin(X * theta) / (X * std::sin(theta)));
    }
    limits += fmt::format("{}{:.4f}", X == 5.0 ? "" : ", ", -1.0 / least);
  }
  for (const auto& part : {limits, std::string("N = 2: 9 ≥ 7"), std::string("N = 2: 9 &lt; 65"),
                           std::string("N = 0: 1 &lt; 2")})
    EXPECT_TRUE(contains(text, part)) << part;
}

}  // namespace
}  // namespace clackers::paper
