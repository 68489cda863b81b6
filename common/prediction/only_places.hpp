// Contacts that are touched too seldom to tell anything but where they are.
#pragma once

#include <cstddef>
#include <set>

#include "data/contacts.hpp"
#include "data/data_set.hpp"

namespace demecal::inline prediction {

/// Whether so many touches agree whatever they are: one of a point, three of a plane.
bool only_places(const ContactForm& form, std::size_t touches);

/// The share of what so many touches measure that does not place the contact: of their errors' mean square about the
/// place that fits them best, over that about where the contact is. 0 where they only place it.
double share_beyond_place(const ContactForm& form, std::size_t touches);

/// The groups of contacts whose poses do: their errors are zero whatever the arm does, and count in no figure.
std::set<ContactGroup> only_placed(const DataSet& data);

}  // namespace demecal::inline prediction
