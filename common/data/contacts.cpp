#include "data/contacts.hpp"

#include <utility>

#include "errors/check.hpp"

namespace demecal::inline data {

std::string_view to_string(ContactKind kind) {
  switch (kind) {
    case ContactKind::point:
      return "point";
    case ContactKind::plane:
      return "plane";
    case ContactKind::sphere:
      return "sphere";
    case ContactKind::line:
      return "line";
  }
  DEMECAL_CHECK(false, "contact kind=" << static_cast<int>(kind));
  return "";
}

std::string_view KnownDistance::key() const {
  return of_grid ? "contacts.grids" : second.empty() ? "contacts.radii_mm" : "contacts.distances";
}

ContactForm Contacts::form_of(const std::string& contact) const {
  const auto found = forms.find(contact);
  return found == forms.end() ? ContactForm{} : found->second;
}

}  // namespace demecal::inline data
