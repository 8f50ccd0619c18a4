#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace clackers::study {

/// Collects the fields of one struct as a json object: `fields(writer, struct)`, found beside the
/// struct or in record_fields.hpp, check_fields.hpp. Numbers read back to the same double.
class JsonWriter {
 public:
  /// Json has no numbers for these three, so that they are written as text.
  static constexpr auto infinity = "inf", minus_infinity = "-inf", not_a_number = "nan";

  template <class T>
  void operator()(const char* name, const T& x) {
    object_[name] = written(x);
  }
  /// A field that records of earlier versions lack.
  template <class T>
  void added(const char* name, const T& x) {
    (*this)(name, x);
  }
  const nlohmann::ordered_json& object() const { return object_; }

 private:
  using Json = nlohmann::ordered_json;

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
  /// A word of an enumeration, or a struct with its fields.
  template <class T>
  static Json written(const T& x) {
    if constexpr (std::is_enum_v<T>) {
      return to_string(x);
    } else {
      JsonWriter writer;
      fields(writer, x);
      return writer.object_;
    }
  }

  Json object_ = Json::object();
};

}  // namespace clackers::study
