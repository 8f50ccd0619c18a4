#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "clackers/report/figure_data.hpp"
#include "clackers/report/sample_record.hpp"
#include "clackers/report/write.hpp"

// What the page tells of each method beside its ladder, and of all by what they cost.
namespace clackers::report {
namespace {

std::size_t occurrences(const std::string& text, std::string_view part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
    ++count;
  return count;
}

TEST(Html, TellsWhatOneWouldHaveConcludedWithoutTheExactSolution) {
  auto record = sample_record();
  const auto page = html(record);
  const auto sections = occurrences(page, "<h4>Without the exact solution</h4>");
  EXPECT_EQ(sections, 7u) << "a refused method has no runs";
  EXPECT_EQ(
      occurrences(page, "away from the true motion. <span class=\"code\">[wrong-limit]</span></p>"),
      1u);
  EXPECT_NE(page.find("<p>Without the true motion: proper. With it: proper.</p>"),
            std::string::npos);
  EXPECT_NE(page.find("<dt>Order of differences</dt><dd>2.00\u202f±0.01, proper; held to 2</dd>"),
            std::string::npos);
  EXPECT_EQ(occurrences(page, "<dt>Order of the same runs' errors</dt><dd>stagnating</dd>"), 1u);
  EXPECT_NE(page.find("<dd>1.02 at the finest pair of runs</dd>"), std::string::npos);
  // The warning stands above, once.
  EXPECT_NE(page.find("<p>Without the true motion: proper. With it: a floor. </p>"),
            std::string::npos);
  record.methods[0].self_convergence.reset();
  EXPECT_NE(html(record).find("<p>Not judged: the method claims no order"), std::string::npos);
}

TEST(Html, ExtrapolatesWithABoundOrTellsWhyNot) {
  auto record = sample_record();
  auto page = html(record);
  EXPECT_NE(
      page.find("at the end = 0.25, −0.125, within 1.5\u202f×\u202f10<sup>−7</sup> of the limit "
                "of the runs; in reference 3.5\u202f×\u202f10<sup>−9</sup> off</dd>"),
      std::string::npos);
  EXPECT_NE(
      page.find(
          "in reference 3.1\u202f×\u202f10<sup>−3</sup> off: the limit is not the true motion"),
      std::string::npos);
  auto& found = record.methods[0].self_convergence->extrapolation;
  found.bounded = false;
  found.reason = "differences-turn";
  EXPECT_NE(html(record).find("<dd>no bound. The differences between runs at successive steps "
                              "change sign"),
            std::string::npos);
}

TEST(Html, HasAllMetricsOfEachMethodThatRan) {
  auto record = sample_record();
  const auto page = html(record);
  EXPECT_EQ(occurrences(page, "<details class=\"metrics\">"), 7u);
  EXPECT_EQ(occurrences(page, "<code>u-max</code></th>"), 7u);
  EXPECT_EQ(occurrences(page, "<code>v-max</code> *</th>"), 7u);
  EXPECT_EQ(
      occurrences(page,
                  "<p>There are no collisions. Not measured: <code>decay-fit-relative</code>, "
                  "<code>impact-spacing-max-relative</code>.</p>"),
      7u);
  EXPECT_NE(page.find("max |u - u*| over the history&#39;s times"), std::string::npos);
  EXPECT_NE(page.find("All 48 metrics at h = 0.0003906 s"), std::string::npos);
  record.methods[0].metrics.clear();
  EXPECT_EQ(occurrences(html(record), "<p>Metrics were not measured: "), 1u);
}

TEST(Html, OffersTheCountersThatSomeRunHas) {
  const auto record = sample_record();
  const auto page = html(record);
  for (const auto* field : {"steps", "force_evaluations", "event_searches", "seconds"})
    EXPECT_EQ(occurrences(page, "data-counter=\"" + std::string(field) + "\" data-of=\"work\""), 1u)
        << field;
  EXPECT_EQ(occurrences(page, "data-of=\"work\" aria-pressed=\"true\""), 1u);
  EXPECT_EQ(occurrences(page, "data-counter=\"newton_iterations\""), 0u);
  // Times are no profile: another day has others.
  EXPECT_EQ(occurrences(page, "data-counter=\"seconds\" data-of=\"profile\""), 0u);
  EXPECT_EQ(occurrences(page, "data-counter=\"steps\" data-of=\"profile\""), 1u);
}

TEST(Html, TellsWhoSolvesWhichTasksAndHasNoProfileWithoutOne) {
  auto record = sample_record();
  const auto& profile = record.profiles.at(0);
  const auto page = html(record);
  EXPECT_NE(page.find("Share of " + std::to_string(profile.tasks.size()) + " tasks"),
            std::string::npos);
  const auto all = "newmark+penalty:stiffness=1e6 " + std::to_string(profile.tasks.size()) + ".";
  EXPECT_NE(page.find(all), std::string::npos) << "the refused method solves none";
  const auto data = figure_data(record);
  for (const auto& row : data["profile"])
    EXPECT_NE(row["method"], "newmark+penalty:stiffness=1e6") << "it has no place in the legend";
  record.profiles.clear();
  EXPECT_EQ(html(record).find("Performance profile"), std::string::npos);
  EXPECT_FALSE(figure_specifications(record).contains("profile"));
}

TEST(FigureData, ProfilesBeginAtTheLeastCostAndEndTogether) {
  study::Record record;
  record.profiles = {{"steps",
                      {"a", "b"},
                      {{"cheap", {1, 1}, {{1.0, 1.0}}, 2, 0},
                       {"dear", {4, INFINITY}, {{4.0, 0.5}}, 0, 1},
                       {"never", {INFINITY, INFINITY}, {}, 0, 2}}}};
  const auto rows = figure_data(record)["profile"];
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0]["ratio"], (nlohmann::ordered_json{1.0, 5.0}));
  EXPECT_EQ(rows[0]["share"], (nlohmann::ordered_json{1.0, 1.0}));
  EXPECT_EQ(rows[1]["ratio"], (nlohmann::ordered_json{1.0, 4.0, 5.0}));
  EXPECT_EQ(rows[1]["share"], (nlohmann::ordered_json{0.0, 0.5, 0.5}));
  EXPECT_EQ(rows[1]["solved"], (nlohmann::ordered_json{0, 1, 1}));
  EXPECT_EQ(rows[2]["share"], (nlohmann::ordered_json{0.0, 0.0}));
  EXPECT_EQ(rows[2]["failed"], 2);
}

}  // namespace
}  // namespace clackers::report
