#include "clackers/methods/contact/event_driven.hpp"

#include "clackers/methods/rows.hpp"

namespace clackers::methods {

const std::vector<Field<EventDriven>>& EventDriven::fields() {
  static const std::vector<Field<EventDriven>> none;
  return none;
}

template Row row<EventDriven>();

}  // namespace clackers::methods
