// What a tool touches where no instrument measures it: points, planes, spheres and lines whose places nobody knows, and
// what is known between them.
#pragma once

#include <compare>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace demecal::inline data {

/// A contact holds the tool point in one place, on a plane, at one distance from a centre, or on a straight line.
enum class ContactKind { point, plane, sphere, line };

/// As data sets and reports name it.
std::string_view to_string(ContactKind kind);

struct ContactForm {
  ContactKind kind = ContactKind::point;
  std::optional<double> radius_m;  ///< of a sphere: of the tool point from its centre, exactly; nothing: free
  double flatness_m = 0.0;         ///< of a plane: the distance of two planes that its surface lies between (ISO 1101)
};

/// A length between two contacts (points, or centres of spheres), from a drawing, a gauge or a calibrated bar. Without
/// a second one it is the radius of the first, or what is to be added to a wire's length (data/stated_radius.hpp).
struct KnownDistance {
  std::string first, second;
  double length_m = 0.0;
  double sigma_m = 0.0;  ///< its standard uncertainty
  bool of_grid = false;  ///< one of those between all places of a grid

  /// Where the data set states it.
  std::string_view key() const;
};

/// Planes or lines that are parallel, or square to one another.
struct KnownAngle {
  std::string first, second;
  bool square = false;  ///< otherwise parallel
  double sigma_rad = 0.0;
};

struct Contacts {
  std::map<std::string, ContactForm> forms;  ///< of the contacts that are no points
  std::vector<KnownDistance> distances;
  std::vector<KnownAngle> angles;

  /// A point, where nothing else is said.
  ContactForm form_of(const std::string& contact) const;
};

}  // namespace demecal::inline data
