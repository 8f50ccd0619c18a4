#include "clackers/report/check_json.hpp"

#include "clackers/study/check_fields.hpp"
#include "clackers/study/json_writer.hpp"

namespace clackers::report {

std::string check_json(const study::CheckRecord& record) {
  study::JsonWriter writer;
  writer("schema", std::string(study::CheckRecord::schema));
  fields(writer, record);
  return writer.object().dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace clackers::report
