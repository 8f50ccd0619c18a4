#include "clackers/report/check_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "clackers/report/format.hpp"
#include "clackers/study/check_fields.hpp"

namespace clackers::report {
namespace {

using Json = nlohmann::ordered_json;
using study::fields;

/// Collects the fields of one struct as a json object.
class Writer {
 public:
  template <class T>
  void operator()(const char* name, const T& x) {
    object_[name] = written(x);
  }
  Json& object() { return object_; }

 private:
  static Json written(double x) {
    if (std::isfinite(x)) return x;
    return exact_number(x);
  }
  static Json written(const std::string& x) { return x; }
  static Json written(bool x) { return x; }
  static Json written(int x) { return x; }
  static Json written(long long x) { return x; }
  static Json written(Behaviour x) { return to_string(x); }
  static Json written(Verdict x) { return to_string(x); }
  static Json written(study::StepSource x) { return to_string(x); }
  static Json written(study::CollisionSource x) { return to_string(x); }

  template <class T>
  static Json written(const std::optional<T>& x) {
    return x ? written(*x) : Json(nullptr);
  }
  static Json written(const std::vector<bool>& x) { return x; }
  template <class T>
  static Json written(const std::vector<T>& x) {
    Json list = Json::array();
    for (const auto& item : x) list.push_back(written(item));
    return list;
  }
  template <class T>
  static Json written(const T& x) {
    Writer writer;
    fields(writer, x);
    return writer.object_;
  }

  Json object_ = Json::object();
};

}  // namespace

std::string check_json(const study::CheckRecord& record) {
  Writer writer;
  writer("schema", std::string(study::CheckRecord::schema));
  fields(writer, record);
  return writer.object().dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace clackers::report
