// Contacts that are touched too seldom to tell anything but where they are.
#pragma once

#include <cstddef>
#include <set>

#include "data/contacts.hpp"
#include "data/data_set.hpp"

namespace demecal::inline prediction {

/// Whether so many touches agree whatever they are: one of a point, three of a plane.
bool only_places(const ContactForm& form, std::size_t touches);

/// The groups of contacts whose poses do: their errors are zero whatever the arm does, and count in no figure.
std::set<ContactGroup> only_placed(const DataSet& data);

}  // namespace demecal::inline prediction
