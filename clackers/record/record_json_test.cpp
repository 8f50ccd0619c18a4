#include "clackers/record/record_json.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "clackers/base/error.hpp"
#include "clackers/base/files/json.hpp"
#include "clackers/record/record_fields.hpp"
#include "clackers/record/testing/sample_record.hpp"

namespace clackers::record {
namespace {

using Json = nlohmann::ordered_json;

std::string refusal_of(const std::string& text) {
  try {
    record_from_json(text);
  } catch (const InputError& error) {
    return std::string(error.code().name()) + ": " + error.what();
  }
  return "accepted";
}

// Converts to any member, so that an aggregate takes as many of them as it has members. Never run.
struct Anything {
  template <class T>
  operator T() const {
    return {};
  }
};
template <class T, class... Values>
constexpr std::size_t members(Values... values) {
  if constexpr (requires { T{values..., Anything{}}; })
    return members<T>(values..., Anything{});
  else
    return sizeof...(Values);
}

// Counts the fields of T, those of a struct within it not.
struct FieldCount {
  template <class T>
  void operator()(const char*, const T&) {
    ++count;
  }
  void added(const char*, const auto&) { ++count; }
  std::size_t count = 0;
};
template <class T>
std::size_t fields_of() {
  FieldCount counter;
  T x;
  fields(counter, x);
  return counter.count;
}

template <class T>
class RecordFields : public testing::Test {};
using Structs =
    testing::Types<Quantity, Schematic, Schematic::Block, Schematic::Spring, Schematic::Touch,
                   Provenance, CaseSummary, RefinementPlan, Refinement, Curve, PrintedColumn, Note,
                   HistoryFile, MetricResult, model::Work, measure::ImpactScore, measure::RunScore,
                   Level, Claim, judge::LadderFit, judge::Evidence, judge::Assessment,
                   judge::SelfConvergence, judge::SelfAgainstReference, judge::Richardson,
                   SelfResult, diagnose::LocatedImpact, diagnose::Departure, Subject,
                   judge::ProfileStep, judge::MethodProfile, Profile, CaseRecord, Record>;
TYPED_TEST_SUITE(RecordFields, Structs);

TYPED_TEST(RecordFields, HoldEveryMember) {
  EXPECT_EQ(fields_of<TypeParam>(), members<TypeParam>());
}

TEST(RecordFieldsOfRun, HoldEveryMemberAndTheScore) {
  EXPECT_EQ(fields_of<record::Run>(), members<record::Run>() - 1 + fields_of<measure::RunScore>());
}

TEST(RecordJson, ReadsBackToTheSameRecord) {
  for (const auto& record : {sample_record(), Record{}}) {
    const auto text = to_json(record);
    EXPECT_EQ(to_json(record_from_json(text)), text);
  }
}

TEST(RecordJson, ReadsEveryDoubleBack) {
  std::mt19937_64 random(20240611);
  Record record;
  auto& written = record.cases.emplace_back().problem.impact_times;
  for (int i = 0; i < 20000; ++i) {
    const auto x = std::bit_cast<double>(random());
    if (!std::isnan(x)) written.push_back(x);
  }
  const auto read = record_from_json(to_json(record)).cases[0].problem.impact_times;
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read[i]), std::bit_cast<std::uint64_t>(written[i]));
}

TEST(RecordJson, NamesEveryNumberOfARun) {
  // Of six numbers in a row none may take the place of another.
  const auto json = parse_json(to_json(sample_record()));
  const auto& run = json["cases"][0]["subjects"][0]["levels"][0]["runs"][0];
  EXPECT_EQ(run["u_error"].get<double>(), 1.0 / 3.0);
  EXPECT_EQ(run["v_error"].get<double>(), std::numeric_limits<double>::max());
  EXPECT_EQ(run["energy_ratio"].get<double>(), 0.0);
  EXPECT_EQ(run["seconds"].get<double>(), 1e23);
  EXPECT_EQ(run["impacts"]["missed"].get<int>(), 1);
}

TEST(RecordJson, WritesWhatJsonHasNoNumberForAsText) {
  Record record;
  record.cases.emplace_back().problem.impact_times = {NAN, INFINITY, -INFINITY};
  const auto json = parse_json(to_json(record));
  EXPECT_EQ(json["cases"][0]["problem"]["impact_times"],
            (nlohmann::ordered_json{"nan", "inf", "-inf"}));
  const auto back = record_from_json(to_json(record));
  EXPECT_TRUE(std::isnan(back.cases[0].problem.impact_times[0]));
}

TEST(RecordJson, ReadsRecordsOfEarlierVersions) {
  auto json = parse_json(to_json(sample_record()));
  auto& subject = json["cases"][0]["subjects"][0];
  EXPECT_EQ(subject["resolution"], "tolerance");
  subject.erase("resolution");
  subject.erase("diagnoses");
  subject["levels"][0]["runs"][1].erase("printed");
  subject["assessment"]["evidence"] = Json::array(
      {{{"code", "other-collisions"}, {"verdict", "disagrees"}, {"numbers", {4, 6, 1}}}});
  subject["assessment"]["reason"] = "more-neighbours";
  subject["assessment"]["displacement"]["reason"] = "more-neighbours";
  const auto read = record_from_json(json_text(json)).cases[0].subjects[0];
  EXPECT_EQ(read.assessment.reason, "more-samples");
  EXPECT_EQ(read.assessment.displacement.reason, "more-samples");
  EXPECT_EQ(read.refined_by, RefinementParameter::step);
  EXPECT_TRUE(read.diagnoses.empty());
  EXPECT_EQ(read.levels[0].runs[1].printed, "");
  EXPECT_EQ(read.assessment.evidence.at(0).code, "other-impacts");
}

TEST(RecordJson, WritesTheEvidenceOfADiagnosisAsOneObject) {
  const auto json = parse_json(to_json(sample_record()));
  const auto& cause = json["cases"][0]["subjects"][0]["diagnoses"][0];
  EXPECT_EQ(cause["code"], "restitution-differs");
  EXPECT_EQ(cause["value"].get<double>(), 0.99);
  EXPECT_EQ(cause["evidence"]["gain"].get<double>(), 9e7);
  EXPECT_EQ(cause["evidence"]["text"], "t,u2");
  EXPECT_EQ(cause["evidence"]["runner-up"], "damping-differs");
  EXPECT_EQ(json["cases"][0]["subjects"][0]["diagnoses"][1]["value"], "nan");
}

TEST(RecordJson, BeginsWithItsSchema) {
  const auto text = to_json(Record{});
  EXPECT_EQ(text.substr(0, 36), "{\n \"schema\": \"clackers/record/1\",\n \"");
}

TEST(RecordJson, RefusesWhatIsNoRecordAndSaysWhere) {
  const auto json = parse_json(to_json(sample_record()));
  const auto changed = [&](const std::string& pointer, const Json& value) {
    auto copy = json;
    copy[Json::json_pointer(pointer)] = value;
    return refusal_of(json_text(copy));
  };
  EXPECT_EQ(refusal_of(json_text(json)), "accepted");
  const std::string hint =
      "; allowed: json of schema clackers/record/1, as written by clackers verify or check with "
      "--format json.";
  for (const auto* schema : {"clackers/verify/1", "clackers/record/2"})
    EXPECT_EQ(changed("/schema", schema),
              "not-a-record: record: schema \"" + std::string(schema) + "\" at /schema" + hint);
  const std::string subject = "/cases/0/subjects/0";
  EXPECT_EQ(changed(subject + "/levels/1/runs/0/u_error", "big"),
            "not-a-record: record: no number at " + subject + "/levels/1/runs/0/u_error" + hint);
  EXPECT_EQ(
      changed("/cases/0/plan/levels", 7.5),
      "not-a-record: record: no whole number, or one too large, at /cases/0/plan/levels" + hint);
  EXPECT_EQ(
      changed("/cases/0/plan/levels", 3'000'000'000),
      "not-a-record: record: no whole number, or one too large, at /cases/0/plan/levels" + hint);
  EXPECT_EQ(changed("/interrupted", 1),
            "not-a-record: record: neither true nor false at /interrupted" + hint);
  EXPECT_EQ(changed("/command", 1), "not-a-record: record: no text at /command" + hint);
  EXPECT_EQ(changed("/provenance", 1), "not-a-record: record: no object at /provenance" + hint);
  EXPECT_EQ(changed("/cases", 1), "not-a-record: record: no list at /cases" + hint);
  EXPECT_EQ(changed("/cases/0/plan/extra", 1),
            "not-a-record: record: a field that is not known at /cases/0/plan" + hint);
  EXPECT_EQ(changed("/extra", 1),
            "not-a-record: record: a field that is not known at the top" + hint);
  for (const auto* word : {"/assessment/verdict", "/claim/behaviour", "/kind"})
    EXPECT_EQ(changed(subject + word, "maybe"),
              "not-a-record: record: \"maybe\", which is none of the words for it, at " + subject +
                  word + hint);
  auto lacking = json;
  lacking["cases"][0]["plan"].erase("coarsest");
  EXPECT_EQ(refusal_of(json_text(lacking)),
            "not-a-record: record: no field \"coarsest\" at /cases/0/plan" + hint);
  for (const auto* text : {"", "{", "null", "[]", "3", "{}", "clackers"})
    EXPECT_EQ(refusal_of(text).substr(0, 13), "not-a-record:") << text;
  EXPECT_LT(refusal_of('"' + std::string(100000, 'a')).size(), 250u);
}

TEST(RecordJson, RefusesTextThatIsTooLongOrTooDeep) {
  EXPECT_NE(refusal_of(std::string(longest_record + 1, ' ')).find("more than 20000000 bytes"),
            std::string::npos);
  const auto deep = "{\"a\": " + std::string(longest_record - 10, '[');
  EXPECT_NE(refusal_of(deep).find("more than 32 levels"), std::string::npos);
  EXPECT_NE(refusal_of(std::string(longest_record, '[')).find("no object"), std::string::npos);
}

TEST(RecordJson, StopsReadingAfterAnInterrupt) {
  const std::atomic<bool> interrupt = true;
  try {
    record_from_json(to_json(sample_record()), &interrupt);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code("interrupted"));
  }
}

}  // namespace
}  // namespace clackers::record
