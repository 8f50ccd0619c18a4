#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "clackers/base/error.hpp"
#include "clackers/study/testing/record_fingerprint.hpp"
#include "clackers/study/testing/sample_record.hpp"
#include "clackers/study/verify.hpp"

namespace clackers::study {
namespace {

std::string refusal_of(const std::string& text) {
  try {
    record_from_json(text);
  } catch (const InputError& error) {
    return std::string(error.code().name()) + ": " + error.what();
  }
  return "accepted";
}

TEST(RecordJson, ReadsBackToTheSameRecordBitByBit) {
  const auto record = sample_record();
  EXPECT_EQ(fingerprint(record_from_json(to_json(record))), fingerprint(record));
  EXPECT_EQ(fingerprint(record_from_json(to_json(Record{}))), fingerprint(Record{}));
}

TEST(RecordJson, ReadsRecordsOfEarlierVersionsThatLackWhatWasAddedLater) {
  auto json = nlohmann::ordered_json::parse(to_json(sample_record()));
  for (const auto* added : {"self_convergence", "metrics", "metrics_step"}) {
    EXPECT_TRUE(json["methods"][0].contains(added)) << added;
    json["methods"][0].erase(added);
  }
  json.erase("profiles");
  auto expected = sample_record();
  expected.profiles.clear();
  expected.methods[0].self_convergence.reset();
  expected.methods[0].metrics.clear();
  expected.methods[0].metrics_step = 0.0;
  EXPECT_EQ(fingerprint(record_from_json(json.dump())), fingerprint(expected));
}

TEST(RecordJson, ReadsEveryDoubleBack) {
  std::mt19937_64 random(20240611);
  Record record;
  for (int i = 0; i < 20000; ++i) {
    const auto x = std::bit_cast<double>(random());
    if (!std::isnan(x)) record.problem.impact_times.push_back(x);
  }
  EXPECT_EQ(fingerprint(record_from_json(to_json(record))), fingerprint(record));
}

TEST(RecordJson, WritesWhatJsonHasNoNumberForAsText) {
  Record record;
  record.problem.impact_times = {NAN, INFINITY, -INFINITY};
  const auto json = nlohmann::json::parse(to_json(record));
  EXPECT_EQ(json["case"]["impact_times"], (nlohmann::json{"nan", "inf", "-inf"}));
  const auto back = record_from_json(to_json(record));
  EXPECT_TRUE(std::isnan(back.problem.impact_times[0]));
}

TEST(RecordJson, BeginsWithItsSchema) {
  const auto text = to_json(Record{});
  EXPECT_EQ(text.substr(0, 36), "{\n \"schema\": \"clackers/verify/1\",\n \"");
}

TEST(RecordJson, RefusesWhatIsNoRecordAndSaysWhere) {
  const auto json = nlohmann::ordered_json::parse(to_json(sample_record()));
  const auto changed = [&](const std::string& pointer, const nlohmann::ordered_json& value) {
    auto copy = json;
    copy[nlohmann::ordered_json::json_pointer(pointer)] = value;
    return refusal_of(copy.dump());
  };
  EXPECT_EQ(refusal_of(json.dump()), "accepted");
  const std::string hint =
      "; allowed: json of schema clackers/verify/1, as written by clackers verify --format json.";
  EXPECT_EQ(changed("/schema", "clackers/verify/2"),
            "not-a-record: record: schema \"clackers/verify/2\" at /schema" + hint);
  EXPECT_EQ(changed("/methods/0/ladder/1/runs/0/u_error", "big"),
            "not-a-record: record: no number at /methods/0/ladder/1/runs/0/u_error" + hint);
  EXPECT_EQ(changed("/methods/0/self_convergence/without_reference/proper", "yes"),
            "not-a-record: record: neither true nor false at "
            "/methods/0/self_convergence/without_reference/proper" +
                hint);
  EXPECT_EQ(changed("/methods/0/metrics/1/value", "much"),
            "not-a-record: record: no number at /methods/0/metrics/1/value" + hint);
  EXPECT_EQ(changed("/plan/levels", 7.5),
            "not-a-record: record: no whole number, or one too large, at /plan/levels" + hint);
  EXPECT_EQ(changed("/plan/levels", 3'000'000'000),
            "not-a-record: record: no whole number, or one too large, at /plan/levels" + hint);
  EXPECT_EQ(changed("/interrupted", 1),
            "not-a-record: record: neither true nor false at /interrupted" + hint);
  EXPECT_EQ(changed("/case/name", 1), "not-a-record: record: no text at /case/name" + hint);
  EXPECT_EQ(changed("/case", 1), "not-a-record: record: no object at /case" + hint);
  EXPECT_EQ(changed("/methods", 1), "not-a-record: record: no list at /methods" + hint);
  EXPECT_EQ(changed("/plan/extra", 1),
            "not-a-record: record: a field that is not known at /plan" + hint);
  EXPECT_EQ(changed("/extra", 1),
            "not-a-record: record: a field that is not known at the top" + hint);
  EXPECT_EQ(changed("/methods/0/assessment/verdict", "maybe").substr(0, 13), "unknown-name:");
  EXPECT_EQ(changed("/methods/0/claim/behaviour", "fine").substr(0, 13), "unknown-name:");
  auto lacking = json;
  lacking["plan"].erase("coarsest");
  EXPECT_EQ(refusal_of(lacking.dump()),
            "not-a-record: record: no field \"coarsest\" at /plan" + hint);
  for (const auto* text : {"", "{", "null", "[]", "3", "{}", "clackers"})
    EXPECT_EQ(refusal_of(text).substr(0, 13), "not-a-record:") << text;
}

}  // namespace
}  // namespace clackers::study
