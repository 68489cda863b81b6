#include "prediction/only_places.hpp"

#include <map>
#include <optional>
#include <vector>

#include "prediction/contact_place.hpp"

namespace demecal::inline prediction {

bool only_places(const ContactForm& form, std::size_t touches) {
  const ContactPlace place{.kind = form.kind, .is_radius_known = form.radius_m.has_value()};
  return touches * static_cast<std::size_t>(rows_of(form.kind)) <= motions_of(place).size();
}

std::set<ContactGroup> only_placed(const DataSet& data) {
  std::set<ContactGroup> groups;
  for (const auto& [group, members] : contact_groups(data))
    if (only_places(data.contacts.form_of(group.contact), members.size())) groups.insert(group);
  return groups;
}

}  // namespace demecal::inline prediction
