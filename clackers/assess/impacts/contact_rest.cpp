#include "clackers/assess/impacts/contact_rest.hpp"

#include <algorithm>

#include "clackers/base/error.hpp"

namespace clackers::assess {

bool rests_in_contact(const model::Motion& reference, const std::vector<model::Contact<>>& contacts,
                      int contact, double t) {
  if (contact < 0 || contact >= std::ssize(contacts))
    refuse("impact", "contact", double(contact), "a row of the problem's contacts");
  const auto& row = contacts[std::size_t(contact)];
  const auto now = reference.at(std::clamp(t, 0.0, reference.end()), model::Side::right);
  return row.gap_at(now.u) == 0.0 && row.gap_rate(now.v) == 0.0;
}

}  // namespace clackers::assess
