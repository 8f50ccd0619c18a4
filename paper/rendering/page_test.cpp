#include "paper/rendering/page.hpp"

#include <gtest/gtest.h>

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
  out.figure.claims = {
      {"eq2", 5, "Section 2.2, Detailed formulation", "It says a < b", Verdict::holds_where,
       "it's 1 < 2 with 4.5e-05 m/s", "N = 1"},
      {"eq1", 3, "Section 2.1, Main idea", "It says more", Verdict::does_not_hold, "0", ""}};
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
        "<span class=\"badge where\">holds where</span></td>",
        "<span class=\"badge hold\">does not hold</span></td>", "it&#39;s ",
        "<span class=\"n\">4.5e-05 m/s</span>", "where <span class=\"n\">N = 1</span>", "We took 3",
        "<a href=\"figA3.svg\">figA3.svg</a>", "Of 2 claims 1 ", "clackers paper figA3 --out x"})
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

TEST(Page, ClaimsAreListedBySectionInThePapersOrder) {
  const auto text = page({drawn()}, "");
  const auto at = [&](const char* part) {
    EXPECT_TRUE(contains(text, part)) << part;
    return text.find(part);
  };
  EXPECT_LT(at("<h3>Section 2.1, Main idea</h3>"), at("<a href=\"#eq1\">It says more</a>"));
  EXPECT_LT(at("<a href=\"#eq1\">It says more</a>"),
            at("<h3>Section 2.2, Detailed formulation</h3>"));
  EXPECT_LT(at("<h3>Section 2.2, Detailed formulation</h3>"),
            at("<a href=\"#eq2\">It says a &lt; b</a>"));
  EXPECT_LT(at("<a href=\"#eq2\">"), at("<tr id=\"eq2\">"));
}

}  // namespace
}  // namespace clackers::paper
