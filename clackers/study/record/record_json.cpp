#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "clackers/base/error.hpp"
#include "clackers/study/case_studies.hpp"
#include "clackers/study/json_writer.hpp"
#include "clackers/study/record/record_fields.hpp"
#include "clackers/study/verify.hpp"

namespace clackers::study {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse_record(const std::string& where, std::string_view what) {
  throw InputError(fmt::format("record: {} at {}; allowed: json of schema {}, as written by "
                               "clackers verify --format json.",
                               what, where.empty() ? "the top" : where, Record::schema),
                   "not-a-record");
}

/// Fills one freshly made struct from a json object; refuses missing and unknown fields.
class Reader {
 public:
  Reader(const Json& object, std::string where) : object_(object), where_(std::move(where)) {
    if (!object.is_object()) refuse_record(where_, "no object");
  }
  template <class T>
  void operator()(const char* name, T& x) {
    const auto field = object_.find(name);
    if (field == object_.end()) refuse_record(where_, fmt::format("no field \"{}\"", name));
    read(*field, where_ + "/" + name, x);
    ++known_;
  }
  /// A field that records of earlier versions lack: what it stands for is left as it is then.
  template <class T>
  void added(const char* name, T& x) {
    if (object_.contains(name)) (*this)(name, x);
  }
  /// Call after the last field.
  void finish() const {
    if (known_ != object_.size()) refuse_record(where_, "a field that is not known");
  }

 private:
  static void read(const Json& json, const std::string& where, double& x) {
    if (json.is_number())
      x = json.get<double>();
    else if (json == JsonWriter::infinity)
      x = std::numeric_limits<double>::infinity();
    else if (json == JsonWriter::minus_infinity)
      x = -std::numeric_limits<double>::infinity();
    else if (json == JsonWriter::not_a_number)
      x = std::numeric_limits<double>::quiet_NaN();
    else
      refuse_record(where, "no number");
  }
  static void read(const Json& json, const std::string& where, std::string& x) {
    if (!json.is_string()) refuse_record(where, "no text");
    x = json.get<std::string>();
  }
  static void read(const Json& json, const std::string& where, bool& x) {
    if (!json.is_boolean()) refuse_record(where, "neither true nor false");
    x = json.get<bool>();
  }
  template <std::signed_integral Whole>
  static void read(const Json& json, const std::string& where, Whole& x) {
    const bool fits =
        json.is_number_unsigned()
            ? std::in_range<Whole>(json.get<std::uint64_t>())
            : json.is_number_integer() && std::in_range<Whole>(json.get<std::int64_t>());
    if (!fits) refuse_record(where, "no whole number, or one too large,");
    x = json.get<Whole>();
  }
  static void read(const Json& json, const std::string& where, Behaviour& x) {
    std::string text;
    read(json, where, text);
    x = behaviour_from(text);
  }
  static void read(const Json& json, const std::string& where, Verdict& x) {
    std::string text;
    read(json, where, text);
    x = verdict_from(text);
  }
  template <class T>
  static void read(const Json& json, const std::string& where, std::optional<T>& x) {
    if (!json.is_null()) read(json, where, x.emplace());
  }
  template <class T>
  static void read(const Json& json, const std::string& where, std::vector<T>& x) {
    if (!json.is_array()) refuse_record(where, "no list");
    for (std::size_t i = 0; i < json.size(); ++i)
      read(json[i], fmt::format("{}/{}", where, i), x.emplace_back());
  }
  template <class T>
  static void read(const Json& json, const std::string& where, T& x) {
    Reader reader(json, where);
    fields(reader, x);
    reader.finish();
  }

  const Json& object_;
  std::string where_;
  std::size_t known_ = 0;
};

Json json_of(const Record& record) {
  JsonWriter writer;
  writer("schema", std::string(Record::schema));
  fields(writer, record);
  return writer.object();
}

std::string text_of(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string to_json(const Record& record) { return text_of(json_of(record)); }

std::string to_json(const CaseStudies& studies) {
  JsonWriter writer;
  writer("profiles", studies.profiles);
  Json records = Json::array();
  for (const auto& record : studies.records) records.push_back(json_of(record));
  return text_of({{"schema", CaseStudies::schema},
                  {"records", std::move(records)},
                  {"profiles", writer.object()["profiles"]}});
}

Record record_from_json(const std::string& text) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("record: no json: {}", error.what()), "not-a-record");
  }
  Reader reader(json, {});
  std::string schema;
  reader("schema", schema);
  if (schema != Record::schema) refuse_record("/schema", fmt::format("schema \"{}\"", schema));
  Record record;
  fields(reader, record);
  reader.finish();
  return record;
}

}  // namespace clackers::study
