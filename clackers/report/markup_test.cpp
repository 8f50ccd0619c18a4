#include "clackers/report/markup.hpp"

#include "clackers/base/files/json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace clackers::report {
namespace {

TEST(Markup, WhatHtmlWouldReadIsEscaped) {
  EXPECT_EQ(escape("<a href=\"x\">'&'</a>"),
            "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
  EXPECT_EQ(escape("a\xff"), "a\xEF\xBF\xBD");
  const nlohmann::ordered_json json{{"name", "</script><!--<script>"}, {"bad", "\xff"}};
  const auto text = script_json(json);
  EXPECT_EQ(text.find('<'), std::string::npos);
  EXPECT_EQ(parse_json(text)["name"], "</script><!--<script>");
}

TEST(Markup, NumbersHavePowersOfTen) {
  EXPECT_EQ(html_number(0.0157, 3), "0.0157");
  EXPECT_EQ(html_number(-1.25e-7, 3), "−1.25\u202f×\u202f10<sup>−7</sup>");
  EXPECT_EQ(html_number(2.5e12, 3), "2.5\u202f×\u202f10<sup>12</sup>");
  EXPECT_EQ(html_scientific(1.25e-7, 2), "1.25\u202f×\u202f10<sup>−7</sup>");
  EXPECT_EQ(html_scientific(0.0), "0");
  EXPECT_EQ(html_number(std::nan(""), 3), "–");
  EXPECT_EQ(html_scientific(-INFINITY), "−∞");
  EXPECT_EQ(html_count(93901), "93\u202f901");
  EXPECT_EQ(html_count(-1234567), "−1\u202f234\u202f567");
  EXPECT_EQ(html_count(999), "999");
}

TEST(Markup, EverySlotIsFilledAndAMissingOneIsAnError) {
  EXPECT_EQ(fill("a{{x}}b{{y}}{{x}}", {{"x", "1"}, {"y", "{{x}}"}}), "a1b{{x}}1");
  EXPECT_THROW(fill("{{z}}", {{"x", "1"}}), std::logic_error);
}

}  // namespace
}  // namespace clackers::report
