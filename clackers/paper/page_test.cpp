#include "clackers/paper/page.hpp"

#include <gtest/gtest.h>

namespace clackers::paper {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Base64, IsThatOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

Drawn drawn() {
  Drawn out;
  out.figure.name = "figA3";
  out.figure.title = "A <title>";
  out.figure.caption = "The caption & more";
  out.figure.claims = {{"It says a < b", "1 < 2", true}, {"It says more", "0", false}};
  out.figure.choices = {"We took 3"};
  out.svg = "foo";
  out.files = {"figA3.svg"};
  return out;
}

TEST(Page, ShowsPictureCaptionClaimsAndFiles) {
  const auto text = page({drawn()}, "clackers paper figA3 --out x");
  for (const auto* part :
       {"Figure A.3. A &lt;title&gt;", "data:image/svg+xml;base64,Zm9v", "The caption &amp; more",
        "It says a &lt; b", "<span class=\"badge holds\">holds</span></td>",
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

}  // namespace
}  // namespace clackers::paper
