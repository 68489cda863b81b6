#include "data/columns.hpp"
#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data_files/data_set_file.hpp"
#include "yaml/yaml_node.hpp"

#include <algorithm>
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
constexpr const char* kFlatness = "flatness_mm";
constexpr const char* kDistances = "distances";
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
    node.with_keys({kContactKinds, kRadii, kFlatness, kDistances, kParallel, kSquare});
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
      data_.contacts.forms[radius.name].radius_m = metres(radius.positive());
    }
    for (const YamlNode& flatness : named_values(node.find(kFlatness))) {
      require_contact(flatness, flatness.name);
      if (data_.contacts.form_of(flatness.name).kind != ContactKind::plane)
        flatness.fail(flatness.name, "is no plane: only planes have a flatness");
      data_.contacts.forms[flatness.name].flatness_m = metres(flatness.positive());
    }
    if (const YamlNode* distances = node.find(kDistances))
      for (const YamlNode& one : distances->list()) read_distance(one);
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

  std::pair<std::string, std::string> read_pair(const YamlNode& node) const {
    const std::vector<YamlNode>& names = node.at("between").list(2);
    for (const YamlNode& name : names) require_contact(name, name.text());
    return between(node);
  }

  void require_centre(const YamlNode& node, const std::string& contact) const {
    const ContactKind kind = data_.contacts.form_of(contact).kind;
    if (kind == ContactKind::point || kind == ContactKind::sphere) return;
    node.fail(contact, "is a " + std::string(to_string(kind)) + ": distances are between points or centres of spheres");
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
      require_centre(node, name.text());
    }
    data_.contacts.distances.push_back(std::move(known));
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
  std::string kinds, radii, flatness;
  for (const auto& [name, form] : contacts.forms) {
    if (form.radius_m == 0.0) continue;  // a wire's end, which its column says
    kinds += "    " + yaml_text(name) + ": " + std::string(to_string(form.kind)) + "\n";
    if (form.radius_m)
      radii += "    " + yaml_text(name) + ": " + number_text(*form.radius_m, millimetres, metres) + "\n";
    if (form.flatness_m > 0.0)
      flatness += "    " + yaml_text(name) + ": " + number_text(form.flatness_m, millimetres, metres) + "\n";
  }
  std::string text;
  if (!kinds.empty()) text += std::string("  ") + kContactKinds + ":\n" + kinds;
  if (!radii.empty()) text += std::string("  ") + kRadii + ":\n" + radii;
  if (!flatness.empty()) text += std::string("  ") + kFlatness + ":\n" + flatness;
  if (!contacts.distances.empty()) text += std::string("  ") + kDistances + ":\n";
  for (const KnownDistance& one : contacts.distances)
    text += "    - " + pair_text(one.first, one.second) + "mm: " + number_text(one.length_m, millimetres, metres) +
            ", sigma_mm: " + number_text(one.sigma_m, millimetres, metres) + "}\n";
  text += angles_text(contacts, false) + angles_text(contacts, true);
  return text.empty() ? text : "contacts:\n" + text;
}

}  // namespace demecal::inline data_files
