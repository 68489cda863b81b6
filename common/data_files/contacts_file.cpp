#include "data/columns.hpp"
#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data/stated_radius.hpp"
#include "data_files/data_set_file.hpp"
#include "yaml/yaml_node.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <ranges>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "kinematics/units.hpp"
#include "yaml/yaml_text.hpp"

namespace demecal::inline data_files {
namespace {

constexpr const char* kContactKinds = "kinds";
constexpr const char* kRadii = "radii_mm";
constexpr const char* kRadiiSigma = "radii_sigma_mm";
constexpr double kUnstated = -1.0;  ///< the uncertainty of a radius, while it is read
constexpr const char* kFlatness = "flatness_mm";
constexpr const char* kDistances = "distances";
constexpr const char* kGrids = "grids";
constexpr const char* kParallel = "parallel";
constexpr const char* kSquare = "square";

/// The names that the poses use.
std::vector<std::string> contact_names(const DataSet& data) {
  std::set<std::string> names;
  for (const auto* poses : {&data.poses, &data.excluded})
    for (const MeasuredPose& pose : *poses)
      if (!pose.contact.empty()) names.insert(pose.contact);
  return {names.begin(), names.end()};
}

/// The two names under `between`.
std::pair<std::string, std::string> between(const YamlNode& node) {
  const std::vector<YamlNode>& names = node.at("between").list(2);
  if (names[0].text() == names[1].text()) names[1].fail("is named twice: two contacts are expected");
  return {names[0].text(), names[1].text()};
}

class ContactsReader {
 public:
  explicit ContactsReader(DataSet& data) : data_(data), names_(contact_names(data)) {}

  void read(const YamlNode& node) {
    node.with_keys({kContactKinds, kRadii, kRadiiSigma, kFlatness, kDistances, kGrids, kParallel, kSquare});
    for (const YamlNode& kind : named_values(node.find(kContactKinds))) {
      require_contact(kind, kind.name);
      if (data_.contacts.forms.contains(kind.name))
        kind.fail(kind.name, "is where a wire ends: it is no other kind of contact");
      data_.contacts.forms[kind.name].kind = kind_of(kind);
    }
    for (const YamlNode& radius : named_values(node.find(kRadii))) {
      require_contact(radius, radius.name);
      if (data_.contacts.form_of(radius.name).kind != ContactKind::sphere)
        radius.fail(radius.name, "is no sphere: only spheres have a radius");
      data_.contacts.distances.push_back({radius.name, {}, metres(radius.positive()), kUnstated});
    }
    for (const YamlNode& sigma : named_values(node.find(kRadiiSigma))) read_sigma(sigma);
    believe_one_tip();
    for (const YamlNode& flatness : named_values(node.find(kFlatness))) {
      require_contact(flatness, flatness.name);
      if (data_.contacts.form_of(flatness.name).kind != ContactKind::plane)
        flatness.fail(flatness.name, "is no plane: only planes have a flatness");
      data_.contacts.forms[flatness.name].flatness_m = metres(flatness.positive());
    }
    if (const YamlNode* distances = node.find(kDistances))
      for (const YamlNode& one : distances->list()) read_distance(one);
    if (const YamlNode* grids = node.find(kGrids))
      for (const YamlNode& one : grids->list()) read_grid(one);
    for (const char* relation : {kParallel, kSquare})
      if (const YamlNode* angles = node.find(relation))
        for (const YamlNode& one : angles->list()) read_angle(one, relation == kSquare);
  }

 private:
  static ContactKind kind_of(const YamlNode& node) {
    return node.one_of<ContactKind>({{"point", ContactKind::point},
                                     {"plane", ContactKind::plane},
                                     {"sphere", ContactKind::sphere},
                                     {"line", ContactKind::line}});
  }

  void require_contact(const YamlNode& node, const std::string& name) const {
    if (std::ranges::find(names_, name) != names_.end()) return;
    node.fail(name, "is no contact of the poses" +
                        (names_.empty() ? std::string() : "; the nearest is '" + nearest_name(name, names_) + "'"));
  }

  /// The entries of a map whose keys are contacts.
  static std::vector<YamlNode> named_values(const YamlNode* node) {
    if (node == nullptr) return {};
    if (node->kind != YamlNode::Kind::map) node->fail("must be a map of contacts");
    return node->children;
  }

  /// Radii of which no uncertainty is stated are wrong together, by the tip that touches them all: each is believed so
  /// much less that together they are believed as one would be.
  void believe_one_tip() {
    std::vector<KnownDistance*> unstated;
    for (KnownDistance& known : data_.contacts.distances)
      if (is_radius(known) && known.sigma_m == kUnstated) unstated.push_back(&known);
    for (KnownDistance* known : unstated)
      known->sigma_m = kRadiusDeviation_m * std::sqrt(static_cast<double>(unstated.size()));
  }

  /// The standard uncertainty of a radius, or of a wire's zero.
  void read_sigma(const YamlNode& sigma) {
    require_contact(sigma, sigma.name);
    KnownDistance* const known = stated_radius(data_.contacts, sigma.name);
    if (known == nullptr)
      sigma.fail(sigma.name, "has no radius under contacts.radii_mm that this could be the uncertainty of");
    known->sigma_m = metres(sigma.non_negative());
    if (known->sigma_m > 0.0) return;
    data_.contacts.forms[sigma.name].radius_m = known->length_m;
    std::erase_if(data_.contacts.distances,
                  [&](const KnownDistance& one) { return is_radius(one) && one.first == sigma.name; });
  }

  std::pair<std::string, std::string> read_pair(const YamlNode& node) const {
    const std::vector<YamlNode>& names = node.at("between").list(2);
    for (const YamlNode& name : names) require_contact(name, name.text());
    return between(node);
  }

  void require_no_line(const YamlNode& node, const std::string& contact) const {
    if (data_.contacts.form_of(contact).kind != ContactKind::line) return;
    node.fail(contact, "is a line: distances are between points, centres of spheres and planes");
  }

  void require_centre(const YamlNode& node, const std::string& contact) const {
    const ContactKind kind = data_.contacts.form_of(contact).kind;
    if (kind == ContactKind::point || kind == ContactKind::sphere) return;
    node.fail(contact, "is a " + std::string(to_string(kind)) + ": a grid is of points or of centres of spheres");
  }

  void require_direction(const YamlNode& node, const std::string& contact) const {
    const ContactKind kind = data_.contacts.form_of(contact).kind;
    if (kind == ContactKind::plane || kind == ContactKind::line) return;
    node.fail(contact, "is a " + std::string(to_string(kind)) + ": only planes and lines have a direction");
  }

  void read_distance(const YamlNode& node) {
    KnownDistance known = read_known_distance(node);
    for (const YamlNode& name : node.at("between").list(2)) {
      require_contact(name, name.text());
      require_no_line(node, name.text());
    }
    data_.contacts.distances.push_back(std::move(known));
  }

  /// Where holes are on a plate, along its own axes, z 0 where it is not given.
  Eigen::Vector3d place_m(const YamlNode& place) const {
    require_contact(place, place.name);
    require_centre(place, place.name);
    const Eigen::Vector3d place_mm =
        place.list().size() == 3 ? place.vector3() : Eigen::Vector3d(place.vector2().x(), place.vector2().y(), 0.0);
    return place_mm.unaryExpr([](double mm) { return metres(mm); });
  }

  /// A grid is the lengths between all its places, each believed so much less that together they say as much as so many
  /// places do of which each is known by itself.
  void read_grid(const YamlNode& node) {
    node.with_keys({"places_mm", "sigma_mm"});
    const std::vector<YamlNode> places = named_values(&node.at("places_mm"));
    if (places.size() < 2) node.at("places_mm").fail("names fewer than two contacts: a grid has at least two");
    const double sigma_m = metres(node.at("sigma_mm").positive()) * std::sqrt(static_cast<double>(places.size()));
    for (std::size_t second = 1; second < places.size(); ++second) {
      for (std::size_t first = 0; first < second; ++first) {
        const double length_m = (place_m(places[second]) - place_m(places[first])).norm();
        if (!(length_m > 0.0)) places[second].fail(places[second].name, "is where " + places[first].name + " is");
        data_.contacts.distances.push_back({places[first].name, places[second].name, length_m, sigma_m, true});
      }
    }
  }

  void read_angle(const YamlNode& node, bool square) {
    node.with_keys({"between", "sigma_deg"});
    auto [first, second] = read_pair(node);
    require_direction(node, first);
    require_direction(node, second);
    data_.contacts.angles.push_back(
        {std::move(first), std::move(second), square, radians(node.at("sigma_deg").positive())});
  }

  DataSet& data_;
  std::vector<std::string> names_;
};

std::string pair_text(const std::string& first, const std::string& second) {
  return "{between: [" + yaml_text(first) + ", " + yaml_text(second) + "], ";
}

std::string angles_text(const Contacts& contacts, bool square) {
  std::string text;
  for (const KnownAngle& one : contacts.angles)
    if (one.square == square)
      text += "    - " + pair_text(one.first, one.second) +
              "sigma_deg: " + number_text(one.sigma_rad, degrees, radians) + "}\n";
  return text.empty() ? text : std::string("  ") + (square ? kSquare : kParallel) + ":\n" + text;
}

}  // namespace

KnownDistance read_known_distance(const YamlNode& node) {
  node.with_keys({"between", "mm", "sigma_mm"});
  auto [first, second] = between(node);
  return {std::move(first), std::move(second), metres(node.at("mm").positive()),
          metres(node.at("sigma_mm").positive())};
}

void read_contacts(const YamlNode* node, const ColumnMap& columns, DataSet& data) {
  if (!node) return;
  if (!columns.contact && !has_contacts(data))
    node->fail("", "needs a column that says which contact each pose touches: columns.contact");
  ContactsReader(data).read(*node);
  for (auto* poses : {&data.poses, &data.excluded})
    for (MeasuredPose& pose : *poses) pose.contact_kind = data.contacts.form_of(pose.contact).kind;
  weigh_by_flatness(data);
}

std::string contacts_text(const Contacts& contacts) {
  const auto entry = [](const std::string& name, double length_m) {
    return "    " + yaml_text(name) + ": " + number_text(length_m, millimetres, metres) + "\n";
  };
  std::string kinds, radii, sigmas, flatness;
  std::set<std::string> wires;  // their columns say what they are
  for (const KnownDistance& one : contacts.distances) {
    if (!is_radius(one)) continue;
    if (is_wire_zero(one)) wires.insert(one.first);
    if (!is_wire_zero(one)) radii += entry(one.first, one.length_m);
    if (!is_wire_zero(one) || one.sigma_m != kWireZeroDeviation_m) sigmas += entry(one.first, one.sigma_m);
  }
  for (const auto& [name, form] : contacts.forms) {
    if (form.radius_m) sigmas += entry(name, 0.0);
    if (form.radius_m == 0.0 || wires.contains(name)) continue;
    kinds += "    " + yaml_text(name) + ": " + std::string(to_string(form.kind)) + "\n";
    if (form.radius_m) radii += entry(name, *form.radius_m);
    if (form.flatness_m > 0.0) flatness += entry(name, form.flatness_m);
  }
  std::string text;
  if (!kinds.empty()) text += std::string("  ") + kContactKinds + ":\n" + kinds;
  if (!radii.empty()) text += std::string("  ") + kRadii + ":\n" + radii;
  if (!sigmas.empty()) text += std::string("  ") + kRadiiSigma + ":\n" + sigmas;
  if (!flatness.empty()) text += std::string("  ") + kFlatness + ":\n" + flatness;
  std::string distances;
  for (const KnownDistance& one : contacts.distances)
    if (!is_radius(one))
      distances += "    - " + pair_text(one.first, one.second) +
                   "mm: " + number_text(one.length_m, millimetres, metres) +
                   ", sigma_mm: " + number_text(one.sigma_m, millimetres, metres) + "}\n";
  if (!distances.empty()) text += std::string("  ") + kDistances + ":\n" + distances;
  text += angles_text(contacts, false) + angles_text(contacts, true);
  return text.empty() ? text : "contacts:\n" + text;
}

}  // namespace demecal::inline data_files
