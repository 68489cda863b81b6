// What people should look at in contacts that were found in recordings.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "preparation/recorded_contacts.hpp"
#include "preparation/touched_places.hpp"

namespace demecal::inline preparation {

/// Throws InputError where names are not as many as the contacts, or a distance is between others.
void check_names(const Recordings& recordings, const RecordedContacts& found);

/// Where the grouping may be wrong, and where the tool point seems to be; `contact_of_group` has the contact that each
/// group became, if it became one.
std::vector<std::string> grouping_notes(const Recordings& recordings, const RecordedContacts& found,
                                        const PlaceGroups& groups,
                                        const std::vector<std::optional<std::size_t>>& contact_of_group);

}  // namespace demecal::inline preparation
