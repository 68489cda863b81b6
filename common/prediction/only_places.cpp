#include "prediction/only_places.hpp"

#include <map>
#include <optional>
#include <vector>

#include "prediction/contact_place.hpp"

namespace demecal::inline prediction {

bool only_places(const ContactForm& form, std::size_t touches) {
  return share_beyond_place(form, touches) == 0.0;
}

double share_beyond_place(const ContactForm& form, std::size_t touches) {
  const ContactPlace place{.kind = form.kind, .is_radius_known = form.radius_m.has_value()};
  const std::size_t rows = touches * static_cast<std::size_t>(rows_of(form.kind)), placing = motions_of(place).size();
  return rows <= placing ? 0.0 : 1.0 - static_cast<double>(placing) / static_cast<double>(rows);
}

std::set<ContactGroup> only_placed(const DataSet& data) {
  std::set<ContactGroup> groups;
  for (const auto& [group, members] : contact_groups(data))
    if (only_places(data.contacts.form_of(group.contact), members.size())) groups.insert(group);
  return groups;
}

}  // namespace demecal::inline prediction
