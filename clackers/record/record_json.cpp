#include "clackers/record/record_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "clackers/base/error.hpp"
#include "clackers/base/files/json.hpp"
#include "clackers/base/text.hpp"
#include "clackers/record/record_fields.hpp"

namespace clackers::record {
namespace {

using Json = nlohmann::ordered_json;

// Json has no numbers for these three, so that they are written as text.
constexpr auto infinity = "inf", minus_infinity = "-inf", not_a_number = "nan";

// Texts among the numbers of a diagnosis.
constexpr auto text_key = "text", runner_up_key = "runner-up";
// The name of "more-samples" in records of earlier versions.
constexpr auto former_code = "more-neighbours";

/// Collects the fields of one struct as a json object.
class Writer {
 public:
  template <class T>
  void operator()(const char* name, const T& x) {
    object_[name] = written(x);
  }
  void added(const char* name, const auto& x) { (*this)(name, x); }
  static Json written(const auto& x) {
    Writer writer;
    fields(writer, x);
    return std::move(writer.object_);
  }

 private:
  static Json written(double x) {
    if (std::isnan(x)) return not_a_number;
    if (std::isinf(x)) return x > 0.0 ? infinity : minus_infinity;
    return x;
  }
  static Json written(const std::string& x) { return x; }
  static Json written(bool x) { return x; }
  static Json written(int x) { return x; }
  static Json written(long long x) { return x; }
  static Json written(const std::vector<bool>& x) { return x; }
  static Json written(const Labels& x) { return x.empty() ? Json::object() : Json(x); }
  // What a cause rests on stands in one object: numbers by name, and two texts.
  static Json written(const diagnose::Diagnosis& x) {
    Json evidence = Json::object();
    for (const auto& fact : x.evidence) evidence[fact.name] = written(fact.value);
    if (!x.text.empty()) evidence[text_key] = x.text;
    if (!x.runner_up.empty()) evidence[runner_up_key] = x.runner_up;
    Json json = Json::object();
    json["code"] = x.code;
    json["value"] = written(x.value);
    json["unit"] = x.unit;
    json["evidence"] = std::move(evidence);
    json["confidence"] = written(x.confidence);
    return json;
  }
  template <class Word>
  requires std::is_enum_v<Word>
  static Json written(const Word& x) { return to_string(x); }
  template <class T>
  static Json written(const std::optional<T>& x) {
    return x ? written(*x) : Json(nullptr);
  }
  template <class T>
  static Json written(const std::vector<T>& x) {
    Json list = Json::array();
    for (const auto& item : x) list.push_back(written(item));
    return list;
  }

  Json object_ = Json::object();
};

[[noreturn]] void refuse_record(const std::string& where, std::string_view what) {
  throw InputError(fmt::format("record: {} at {}; allowed: json of schema {}, as written by "
                               "clackers verify or check with --format json.",
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
  /// A field that records of earlier versions lack keeps its default there.
  void added(const char* name, auto& x) {
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
    else if (json == infinity)
      x = std::numeric_limits<double>::infinity();
    else if (json == minus_infinity)
      x = -std::numeric_limits<double>::infinity();
    else if (json == not_a_number)
      x = std::numeric_limits<double>::quiet_NaN();
    else
      refuse_record(where, "no number");
  }
  static void read(const Json& json, const std::string& where, std::string& x) {
    if (!json.is_string()) refuse_record(where, "no text");
    x = json.get<std::string>();
  }
  static void read(const Json& json, const std::string& where, Labels& x) {
    if (!json.is_object()) refuse_record(where, "no object");
    for (const auto& [key, value] : json.items()) read(value, where + "/" + key, x[key]);
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
  template <class Word>
  static void read_word(const Json& json, const std::string& where, Word& x,
                        std::initializer_list<Word> words) {
    std::string text;
    read(json, where, text);
    for (const auto word : words)
      if (to_string(word) == text) {
        x = word;
        return;
      }
    refuse_record(where, fmt::format("\"{}\", which is none of the words for it,", text));
  }
  static void read(const Json& json, const std::string& where, Behaviour& x) {
    read_word(json, where, x,
              {Behaviour::exact, Behaviour::proper, Behaviour::reduced, Behaviour::irregular,
               Behaviour::stagnating, Behaviour::divergent, Behaviour::undecided});
  }
  static void read(const Json& json, const std::string& where, Verdict& x) {
    read_word(json, where, x,
              {Verdict::agrees, Verdict::disagrees, Verdict::not_claimed, Verdict::undecided});
  }
  static void read(const Json& json, const std::string& where, StepSource& x) {
    read_word(json, where, x, {StepSource::data, StepSource::name, StepSource::option});
  }
  static void read(const Json& json, const std::string& where, ImpactSource& x) {
    read_word(json, where, x, {ImpactSource::events, ImpactSource::history, ImpactSource::unknown});
  }
  static void read(const Json& json, const std::string& where, SubjectKind& x) {
    read_word(
        json, where, x,
        {SubjectKind::method, SubjectKind::histories, SubjectKind::program, SubjectKind::callable});
  }
  static void read(const Json& json, const std::string& where, RefinementEnd& x) {
    read_word(
        json, where, x,
        {RefinementEnd::decided, RefinementEnd::budget, RefinementEnd::rounding_floor,
         RefinementEnd::too_many_steps, RefinementEnd::run_failed, RefinementEnd::interrupted});
  }
  static void read(const Json& json, const std::string& where, RefinementParameter& x) {
    read_word(json, where, x, {RefinementParameter::step, RefinementParameter::tolerance});
  }
  static void read(const Json& json, const std::string& where, judge::Mismatch& x) {
    using enum judge::Mismatch;
    read_word(json, where, x, {none, behaviour, lower_order, higher_order, floor_reason, evidence});
  }
  static void read(const Json& json, const std::string& where, diagnose::Diagnosis& x) {
    Json evidence;
    Reader reader(json, where);
    reader("code", x.code);
    reader("value", x.value);
    reader("unit", x.unit);
    reader("evidence", evidence);
    reader("confidence", x.confidence);
    reader.finish();
    const auto place = where + "/evidence";
    if (!evidence.is_object()) refuse_record(place, "no object");
    for (const auto& [name, value] : evidence.items()) {
      if (name == text_key)
        read(value, place, x.text);
      else if (name == runner_up_key)
        read(value, place, x.runner_up);
      else
        read(value, place, x.evidence.emplace_back(diagnose::Fact{name}).value);
    }
  }
  template <class T>
  requires std::same_as<T, Note> || std::same_as<T, judge::Evidence>
  static void read(const Json& json, const std::string& where, T& x) {
    Reader reader(json, where);
    fields(reader, x);
    reader.finish();
    // Records of earlier versions say "no-collisions", "other-collisions" and so on.
    constexpr std::string_view former = "collisions";
    if (const auto at = x.code.find(former); at != std::string::npos)
      x.code.replace(at, former.size(), "impacts");
    if (x.code == former_code) x.code = Code("more-samples").name();
  }
  template <class T>
  requires std::same_as<T, judge::LadderFit> || std::same_as<T, judge::Assessment>
  static void read(const Json& json, const std::string& where, T& x) {
    Reader reader(json, where);
    fields(reader, x);
    reader.finish();
    if (x.reason == former_code) x.reason = Code("more-samples").name();
  }
  static void read(const Json& json, const std::string&, Json& x) { x = json; }
  template <class T>
  static void read(const Json& json, const std::string& where, std::optional<T>& x) {
    if (!json.is_null()) read(json, where, x.emplace());
  }
  template <class T>
  static void read(const Json& json, const std::string& where, std::vector<T>& x) {
    if (!json.is_array()) refuse_record(where, "no list");
    for (std::size_t i = 0; i < json.size(); ++i) {
      T item{};
      read(json[i], fmt::format("{}/{}", where, i), item);
      x.push_back(std::move(item));
    }
  }
  static void read(const Json& json, const std::string& where, auto& x) {
    Reader reader(json, where);
    fields(reader, x);
    reader.finish();
  }

  const Json& object_;
  std::string where_;
  std::size_t known_ = 0;
};

// A record has 14 levels. Hostile text of a million brackets would take the memory.
constexpr int deepest = 32;

Json parsed(const std::string& text, const std::atomic<bool>* interrupt) {
  if (text.size() > longest_record)
    refuse_record({}, fmt::format("more than {} bytes", longest_record));
  const auto watch = [&](int depth, bool starts_array) {
    if (interrupt != nullptr && *interrupt) throw Error("interrupted", "interrupted");
    if (depth > deepest) refuse_record({}, fmt::format("more than {} levels", deepest));
    if (depth == 0 && starts_array) refuse_record({}, "no object");
  };
  try {
    return parse_json(text, watch);
  } catch (const nlohmann::json::exception& error) {
    std::string_view reason = error.what();
    reason.remove_prefix(reason.find(']') + 1);  // "[json.exception.parse_error.101]"
    constexpr std::size_t most_shown = 160;      // the reason quotes what was read last
    throw InputError(fmt::format("record: no json:{}{}", printable(reason.substr(0, most_shown)),
                                 reason.size() > most_shown ? "..." : ""),
                     "not-a-record");
  }
}

}  // namespace

std::string to_json(const Record& record) {
  Json json{{"schema", Record::schema}};
  json.update(Writer::written(record));
  return json_text(json, 1);
}

Record record_from_json(const std::string& text, const std::atomic<bool>* interrupt) {
  const auto json = parsed(text, interrupt);
  Reader reader(json, {});
  std::string schema;
  reader("schema", schema);
  if (schema != Record::schema) refuse_record("/schema", fmt::format("schema \"{}\"", schema));
  Record record;
  fields(reader, record);
  reader.finish();
  return record;
}

}  // namespace clackers::record
