#include "parameters/declared_model.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "effects/effect.hpp"
#include "errors/check.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"

namespace demecal::inline parameters {
namespace {

struct DeclaredWord {
  std::string_view word;
  bool DeclaredModel::*flag;
};
constexpr std::array<DeclaredWord, 5> kDeclaredWords{{{"registration", &DeclaredModel::registration},
                                                      {"tool", &DeclaredModel::tool},
                                                      {"joint_offset", &DeclaredModel::joint_offset},
                                                      {"geometry", &DeclaredModel::geometry},
                                                      {"joint_corrections", &DeclaredModel::joint_corrections}}};

constexpr std::array<const char*, 3> kAxisNames{"x", "y", "z"};

std::string link_name(LinkParameter parameter) {
  switch (parameter) {
    case LinkParameter::theta:
      return "theta_deg";
    case LinkParameter::d:
      return "d_mm";
    case LinkParameter::a:
      return "a_mm";
    case LinkParameter::alpha:
      return "alpha_deg";
    case LinkParameter::beta:
      return "beta_deg";
  }
  DEMECAL_CHECK(false, "link parameter " << static_cast<int>(parameter));
}

using Kind = ParameterId::Kind;

void add_axes(std::vector<ParameterId>& ids, Kind kind, const std::string& target) {
  for (int axis = 0; axis < 3; ++axis) ids.push_back({kind, axis, LinkParameter::theta, target});
}

void add_link(std::vector<ParameterId>& ids, int joint, LinkParameter parameter) {
  ids.push_back({Kind::link, joint, parameter, {}});
}

/// A revolute joint's geometry. Between near-parallel axes beta takes the place of d, unless the d it would be lumped
/// with is not free: that of a prismatic neighbour whose offset is not declared.
void add_revolute(std::vector<ParameterId>& ids, const Chain& chain, int joint, bool parallel, bool offsets) {
  const int neighbour = chain.convention == Convention::standard_dh ? joint + 1 : joint - 1;
  const bool lumped = parallel && (offsets || is_revolute(chain, neighbour));
  if (!lumped) add_link(ids, joint, LinkParameter::d);
  add_link(ids, joint, LinkParameter::a);
  add_link(ids, joint, LinkParameter::alpha);
  if (parallel) add_link(ids, joint, LinkParameter::beta);
}

/// A prismatic joint has a direction but no place: two angles. About a near-parallel neighbour theta would only repeat
/// that joint's own, and beta takes its place.
void add_prismatic(std::vector<ParameterId>& ids, int joint, bool parallel) {
  add_link(ids, joint, parallel ? LinkParameter::beta : LinkParameter::theta);
  add_link(ids, joint, LinkParameter::alpha);
}

void add_links(std::vector<ParameterId>& ids, const Chain& chain, const DeclaredModel& declared) {
  for (int joint = 0; joint < chain.size(); ++joint) {
    const bool revolute = is_revolute(chain, joint);
    const bool parallel = leads_between_parallels(chain, joint, kNearParallel_rad);
    if (declared.joint_offset) add_link(ids, joint, revolute ? LinkParameter::theta : LinkParameter::d);
    if (declared.geometry && revolute) add_revolute(ids, chain, joint, parallel, declared.joint_offset);
    if (declared.geometry && !revolute) add_prismatic(ids, joint, parallel);
  }
}

void add_tools(std::vector<ParameterId>& ids, const DataSet& data) {
  std::set<std::string> targets, turned;
  for (const MeasuredPose& pose : data.poses) {
    targets.insert(pose.target);
    if (pose.orientation) turned.insert(pose.target);
  }
  for (const std::string& target : targets) {
    add_axes(ids, Kind::tool_translation, target);
    if (turned.contains(target)) add_axes(ids, Kind::tool_rotation, target);
  }
}

/// Further stations that any pose was measured from, by name.
std::set<std::string> stations_of(const DataSet& data) {
  std::set<std::string> stations;
  for (const MeasuredPose& pose : data.poses)
    if (!pose.station.empty()) stations.insert(pose.station);
  return stations;
}

/// "gear_harmonic joint 2 (ratio 107)": which law, where, with which settings.
std::string effect_name(const Effect& effect) {
  std::ostringstream name;
  name << effect.kind;
  if (effect.joint >= 0) name << " joint " << effect.joint + 1;
  const char* before = " (";
  for (const auto& [setting, value] : effect.settings) {
    name << before << setting << ' ' << value;
    before = ", ";
  }
  if (!effect.settings.empty()) name << ')';
  return name.str();
}

constexpr std::array<const char*, 7> kMotionNames{"x_mm", "y_mm", "z_mm", "rx_deg", "ry_deg", "rz_deg", "radius_mm"};

std::string contact_number_name(const ParameterId& id) {
  return "contact " + id.target + " " + kMotionNames.at(static_cast<std::size_t>(id.index));
}

/// What of a joint is where the arm stands, which contacts leave open: a move of the base does the same.
bool is_where_the_arm_stands(const ParameterId& id, const Chain& chain) {
  if (id.kind != Kind::link || id.index != 0) return false;
  const bool before_axis = chain.convention == Convention::modified_dh;
  return before_axis || id.link == LinkParameter::theta || id.link == LinkParameter::d;
}

std::string ratio_text(double share) {
  std::ostringstream text;
  text.precision(2);
  text << share;
  return text.str();
}

}  // namespace

std::vector<std::string> declared_words() {
  std::vector<std::string> words;
  for (const DeclaredWord& known : kDeclaredWords) words.emplace_back(known.word);
  return words;
}

bool DeclaredModel::*declared_flag(std::string_view word) {
  const auto* const found = std::ranges::find(kDeclaredWords, word, &DeclaredWord::word);
  return found == kDeclaredWords.end() ? nullptr : found->flag;
}

std::vector<std::string> DeclaredModel::words() const {
  std::vector<std::string> words;
  for (const DeclaredWord& known : kDeclaredWords) {
    if (this->*known.flag) words.emplace_back(known.word);
  }
  return words;
}

bool DeclaredModel::holds(std::string_view kind) const {
  bool DeclaredModel::*const flag = declared_flag(kind);
  return flag != nullptr && this->*flag;
}

std::string ParameterId::name() const {
  if (kind == Kind::link) return "joint " + std::to_string(index + 1) + " " + link_name(link);
  if (kind == Kind::effect) return effect;
  if (kind == Kind::contact) return contact_number_name(*this);
  if (kind == Kind::station) return "station " + target + " " + kMotionNames.at(static_cast<std::size_t>(index));
  const std::string axis = kAxisNames.at(static_cast<std::size_t>(index));
  const std::string of_what = kind == Kind::base_translation || kind == Kind::base_rotation ? "base_" : "tool_";
  const std::string suffix = target.empty() ? "" : " of " + target;
  return of_what + (is_angle() ? "r" + axis + "_deg" : axis + "_mm") + suffix;
}

bool ParameterId::is_angle() const {
  if (kind == Kind::effect) return false;
  if (kind == Kind::contact) return index >= 3 && index != kRadiusMotion;
  if (kind == Kind::station) return index >= 3;
  if (kind != Kind::link) return kind == Kind::base_rotation || kind == Kind::tool_rotation;
  return link == LinkParameter::theta || link == LinkParameter::alpha || link == LinkParameter::beta;
}

std::vector<ParameterId> effect_parameters(const CorrectedRobot& robot) {
  std::vector<ParameterId> ids;
  for (std::size_t i = 0; i < robot.effects.size(); ++i) {
    const Effect& effect = robot.effects[i];
    int coefficient = 0;
    for (const CoefficientLabel& label : law_of(effect).coefficients(effect, robot.described)) {
      ids.push_back({.kind = Kind::effect,
                     .index = static_cast<int>(i),
                     .coefficient = coefficient++,
                     .effect = effect_name(effect) + ' ' + label.name});
    }
  }
  return ids;
}

std::vector<ParameterId> free_parameters(const DataSet& data, const DeclaredModel& declared) {
  std::vector<ParameterId> ids;
  const bool placed = has_instrument(data) || !has_contacts(data);
  if (declared.registration && placed) {
    add_axes(ids, Kind::base_translation, {});
    add_axes(ids, Kind::base_rotation, {});
    for (const std::string& station : stations_of(data))
      for (int motion = 0; motion < 6; ++motion)
        ids.push_back({.kind = Kind::station, .index = motion, .target = station});
  }
  add_links(ids, data.robot.chain, declared);
  if (!placed) std::erase_if(ids, [&](const ParameterId& id) { return is_where_the_arm_stands(id, data.robot.chain); });
  if (declared.tool) add_tools(ids, data);
  return ids;
}

std::vector<ParameterId> contact_parameters(const DataSet& data, std::span<const std::size_t> poses) {
  std::vector<ParameterId> ids;
  for (const auto& [group, members] : contact_groups(data, poses)) {
    const ContactForm form = data.contacts.form_of(group.contact);
    for (const int motion : motions_of({.kind = form.kind, .is_radius_known = form.radius_m.has_value()})) {
      ids.push_back({.kind = Kind::contact, .index = motion, .target = group.contact, .set = group.set});
    }
  }
  return ids;
}

CorrectedRobot with_contacts_of(CorrectedRobot robot, const std::vector<ParameterId>& ids, const DataSet& data) {
  std::set<ContactGroup> lacking;
  for (const ParameterId& id : ids)
    if (id.kind == Kind::contact && !robot.contacts.contains({id.target, id.set})) lacking.insert({id.target, id.set});
  if (lacking.empty()) return robot;
  std::vector<std::size_t> poses;
  for (std::size_t i = 0; i < data.poses.size(); ++i)
    if (lacking.contains(group_of(data.poses[i]))) poses.push_back(i);
  return with_own_contacts(std::move(robot), data, poses);
}

std::string UnidentifiedDirection::sentence() const {
  const std::string kept = weak ? "; kept near nominal" : "";
  if (parts.size() == 1)
    return parts[0].first.name() + (weak ? " hardly shows" : " does not show") + " in these poses" + kept;
  std::string names, ratios;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    names += (i == 0 ? "" : i + 1 < parts.size() ? ", " : " and ") + parts[i].first.name();
    ratios += (i == 0 ? "" : " : ") + ratio_text(parts[i].second / parts[0].second);
  }
  return names + (weak ? " have nearly" : " have") +
         " the same effect in these poses: only their combination is identified (" + ratios + " by effect)" + kept;
}

}  // namespace demecal::inline parameters
