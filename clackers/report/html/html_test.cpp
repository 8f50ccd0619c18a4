#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <stdexcept>

#include "clackers/report/figure_data.hpp"
#include "clackers/report/look.hpp"
#include "clackers/report/markup.hpp"
#include "clackers/report/sample_record.hpp"
#include "clackers/report/write.hpp"

namespace clackers::report {
namespace {

std::size_t occurrences(const std::string& text, std::string_view part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
    ++count;
  return count;
}

nlohmann::json block(const std::string& page, const std::string& id) {
  const auto open = page.find("id=\"" + id + "\">");
  const auto from = page.find('>', open) + 1;
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

TEST(Html, TheLeadIsMadeOfWholeSentences) {
  const auto page = html(sample_record());
  EXPECT_NE(page.find("and amplitude. 20 s with"), std::string::npos);
}

TEST(Markup, EscapesWhatHtmlWouldTakeForItsOwn) {
  EXPECT_EQ(escape("<a href=\"x\">'&'</a>"),
            "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
  const nlohmann::ordered_json json{{"name", "</script><!--<script>"}, {"bad", "\xff"}};
  const auto text = script_json(json);
  EXPECT_EQ(text.find('<'), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(text)["name"], "</script><!--<script>");
}

TEST(Markup, DressesNumbers) {
  EXPECT_EQ(html_number(0.0157, 3), "0.0157");
  EXPECT_EQ(html_number(-1.25e-7, 3), "−1.25\u202f×\u202f10<sup>−7</sup>");
  EXPECT_EQ(html_number(2.5e12, 3), "2.5\u202f×\u202f10<sup>12</sup>");
  EXPECT_EQ(html_scientific(1.25e-7, 2), "1.25\u202f×\u202f10<sup>−7</sup>");
  EXPECT_EQ(html_scientific(0.0), "0");
  EXPECT_EQ(html_number(std::nan(""), 3), "–");
  EXPECT_EQ(html_scientific(-INFINITY), "−∞");
  EXPECT_EQ(html_count(93901), "93\u202f901");
  EXPECT_EQ(html_count(-1234567), "−1\u202f234\u202f567");
  EXPECT_EQ(html_count(-123), "−123");
  EXPECT_EQ(html_count(999), "999");
}

TEST(Markup, FillsEverySlotAndKnowsWhenOneIsMissing) {
  EXPECT_EQ(fill("a{{x}}b{{y}}{{x}}", {{"x", "1"}, {"y", "{{x}}"}}), "a1b{{x}}1");
  EXPECT_THROW(fill("{{z}}", {{"x", "1"}}), std::logic_error);
}

TEST(Look, IsDifferentForTheFirstTwentyFourMethods) {
  for (std::size_t i = 0; i < 24; ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const auto a = look(i), b = look(k);
      // Colour may repeat, but then neither dash nor marker does.
      EXPECT_TRUE(a.color != b.color || (a.dash != b.dash && a.shape != b.shape)) << i << " " << k;
    }
}

TEST(Html, IsOneFileThatLoadsNothing) {
  const auto page = html(sample_record());
  EXPECT_LT(page.size(), 2000000u);
  EXPECT_FALSE(std::regex_search(page.substr(0, page.find("<body>")),
                                 std::regex("(src|href)=\"(?!data:,)")));
  for (const auto part :
       {"<script src", "<link rel=\"stylesheet\"", "@import", "url(", "sourceMappingURL"})
    EXPECT_EQ(page.substr(0, page.find("id=\"data\"")).find(part), std::string::npos) << part;
  EXPECT_EQ(page.find("sourceMappingURL"), std::string::npos);
  EXPECT_EQ(page.find("{{"), page.find("{{", page.find("vega")));  // no slot of ours is left
  EXPECT_EQ(occurrences(page, "</script>"), 8u);
}

TEST(Html, HoldsAVerdictAFigureAndASectionForEverything) {
  const auto record = sample_record();
  const auto page = html(record);
  for (std::size_t i = 1; i <= record.methods.size(); ++i) {
    EXPECT_EQ(occurrences(page, "id=\"method-" + std::to_string(i) + "\""), 1u);
    EXPECT_GE(occurrences(page, "href=\"#method-" + std::to_string(i) + "\""), 1u);
  }
  EXPECT_EQ(occurrences(page, "<figure "), 5u);
  EXPECT_EQ(occurrences(page, "How to read."), 5u);
  EXPECT_NE(page.find("<span class=\"badge disagrees\">disagrees</span>"), std::string::npos);
  EXPECT_NE(page.find("<pre id=\"command\">clackers verify --report report.html</pre>"),
            std::string::npos);
  for (const auto& text :
       {record.provenance.compiler, record.provenance.machine, record.provenance.processor,
        record.provenance.date, record.provenance.version})
    EXPECT_NE(page.find("<dd>" +
                        (text == record.provenance.date
                             ? "<time datetime=\"" + text + "\">" + text + "</time>"
                             : text) +
                        "</dd>"),
              std::string::npos)
        << text;
  EXPECT_NE(page.find("University of Washington Interactive Data Lab"), std::string::npos);
}

TEST(Html, MarksAnInterruptedRecordAndOnlyThat) {
  auto record = sample_record();
  EXPECT_EQ(occurrences(html(record), "<strong>Interrupted.</strong>"), 1u);
  record.interrupted = false;
  EXPECT_EQ(occurrences(html(record), "<strong>Interrupted.</strong>"), 0u);
}

TEST(Html, LetsNoTextOfTheRecordBecomeMarkup) {
  auto record = sample_record();
  const std::string evil = "</script><script>alert(1)</script><b x='\">&";
  record.provenance = {evil, evil, evil, evil, evil, evil};
  record.problem.name = record.problem.summary = record.problem.equations = evil;
  for (auto* list : {&record.problem.parameters, &record.problem.constants})
    for (auto& quantity : *list) quantity = {evil, 1.0, evil, evil};
  for (auto& method : record.methods) {
    method.name = evil;
    method.assessment.sentence = evil;
    method.assessment.displacement.reason = evil;
    method.claim.reason = evil;
    method.self_convergence.emplace();
    method.self_convergence->against_reference = {true, evil, 0.0, evil};
    method.self_convergence->extrapolation.reason = evil;
    method.self_convergence->extrapolation.sentence = evil;
    for (auto& metric : method.metrics) metric = {evil, evil, 1.0, {}, evil, true};
    for (auto& level : method.ladder) {
      level.runs[0].finished = false;
      level.runs[0].failure = level.runs[0].failure_code = evil;
    }
  }
  record.methods.back().refusal = record.methods.back().refusal_code = evil;
  for (auto& profile : record.profiles)
    for (auto& method : profile.methods) method.method = evil;
  const auto page = html(record);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_EQ(page.find("<b x="), std::string::npos);
  EXPECT_EQ(occurrences(page, "</script>"), 8u);
  EXPECT_EQ(block(page, "data")["levels"][0]["method"], evil);
}

TEST(Html, CarriesTheErrorsOfAllRunsToTheLastDigit) {
  const auto record = sample_record();
  const auto data = block(html(record), "data");
  ASSERT_EQ(data["runs"]["rows"].size(), 6u * 64 + 24 + 1);
  std::size_t column = 0;
  while (data["runs"]["columns"][column] != "u_error") ++column;
  EXPECT_EQ(data["runs"]["rows"][77][column].get<double>(),
            record.methods[1].ladder[1].runs[5].u_error);
}

TEST(FigureData, LevelsAreTheWorstRunOfEachThatFinished) {
  auto record = sample_record();
  auto& runs = record.methods[0].ladder[2].runs;
  runs[1].u_error = 5.0;
  runs[1].work.force_evaluations = 4321;
  runs[1].seconds = 0.125;
  runs[1].work.newton_iterations = 17;
  runs[0].finished = false;
  runs[0].u_error = 50.0;
  const auto level = figure_data(record)["levels"][2];
  EXPECT_EQ(level["u_error"], 5.0);
  EXPECT_EQ(level["force_evaluations"], 4321);
  EXPECT_EQ(level["seconds"], 0.125);
  EXPECT_EQ(level["newton_iterations"], 17);
  EXPECT_EQ(level["step"], runs[1].step);
  EXPECT_EQ(level["level"], 3);
}

TEST(FigureData, TrianglesClimbWithTheirOrder) {
  const auto slopes = figure_data(sample_record())["slopes"];
  ASSERT_EQ(slopes.size(), 3u);
  for (const auto& slope : slopes) {
    // From the left end of the base to the top right corner, which is corner 2.
    double left = 1e9, bottom = 1e9, right = 0, top = 0;
    for (std::size_t i = 0; i < slope["corner"].size(); ++i) {
      left = std::min(left, slope["step"][i].get<double>());
      bottom = std::min(bottom, slope["u_error"][i].get<double>());
      if (slope["corner"][i] == 2) right = slope["step"][i], top = slope["u_error"][i];
    }
    EXPECT_NEAR(std::log(top / bottom) / std::log(right / left),
                std::stod(slope["order"].get<std::string>()),
                1e-12);  // three logarithms and a power, each within 1e-15 relative of about 10
  }
  study::Record empty;
  EXPECT_TRUE(figure_data(empty)["slopes"].empty());
}

TEST(FigureData, LongCurvesKeepTheirExtremesInFewPoints) {
  study::Curve curve;
  curve.y.resize(2);
  for (int i = 0; i < 100000; ++i) {
    curve.t.push_back(i);
    curve.y[0].push_back(i == 54321 ? 1e3 : std::sin(i));
    curve.y[1].push_back(i == 12345 ? -1e3 : std::cos(i));
  }
  const auto few = reduced(curve);
  EXPECT_LE(few.t.size(), most_points);
  EXPECT_GE(few.t.size(), most_points / 2);
  EXPECT_TRUE(std::ranges::is_sorted(few.t));
  EXPECT_EQ(std::ranges::max(few.y[0]), 1e3);
  EXPECT_EQ(std::ranges::min(few.y[1]), -1e3);
  EXPECT_EQ(few.t.size(), few.y[0].size());
  EXPECT_EQ(reduced(sample_response(900)).t.size(), 900u);
}

TEST(FigureSpecifications, HaveNoPlaceholderLeftAndNameTheirData) {
  const auto record = sample_record();
  const auto data = figure_data(record);
  const auto all = figure_specifications(record);
  for (const auto& [name, specification] : all.items()) {
    const auto text = specification.dump();
    EXPECT_FALSE(std::regex_search(text, std::regex("\"\\$(?!schema)"))) << name << text;
    const std::regex named("\"data\":\\{\"name\":\"([a-z]+)\"\\}");
    for (std::sregex_iterator at(text.begin(), text.end(), named), end; at != end; ++at)
      EXPECT_TRUE(data.contains((*at)[1].str())) << name << (*at)[1];
  }
}

TEST(Html, SaysWhatCannotBeDrawn) {
  auto record = sample_record();
  EXPECT_EQ(html(record).find("are not drawn"), std::string::npos);
  record.methods[0].ladder[0].runs[0].finished = false;
  record.methods[0].ladder[0].runs[1].u_error = 0.0;
  const auto page = html(record);
  EXPECT_NE(page.find("1 run that did not reach its end is not drawn."), std::string::npos);
  EXPECT_NE(page.find("1 run without any error is not drawn."), std::string::npos);
}

}  // namespace
}  // namespace clackers::report
