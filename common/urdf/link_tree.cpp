#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "errors/check.hpp"
#include "errors/input_error.hpp"
#include "urdf/urdf_file.hpp"

namespace demecal::inline urdf {
namespace {

/// As SDFs and URDFs call them.
constexpr std::array<std::pair<std::string_view, UrdfType>, 11> kTypes{{{"revolute", UrdfType::revolute},
                                                                        {"continuous", UrdfType::continuous},
                                                                        {"prismatic", UrdfType::prismatic},
                                                                        {"fixed", UrdfType::fixed},
                                                                        {"floating", UrdfType::floating},
                                                                        {"planar", UrdfType::planar},
                                                                        {"ball", UrdfType::ball},
                                                                        {"universal", UrdfType::universal},
                                                                        {"screw", UrdfType::screw},
                                                                        {"revolute2", UrdfType::revolute2},
                                                                        {"gearbox", UrdfType::gearbox}}};

[[noreturn]] void refuse_joint(const UrdfFile& urdf, const UrdfJoint& joint, const std::string& value,
                               const std::string& rule) {
  throw InputError({urdf.file, joint.line}, value, rule);
}

void check_names(const UrdfFile& urdf) {
  std::set<std::string> links, joints, children;
  for (const UrdfLink& link : urdf.links) {
    if (!links.insert(link.name).second) throw InputError({urdf.file, link.line}, link.name, "is a link given twice");
  }
  for (const UrdfJoint& joint : urdf.joints) {
    if (!joints.insert(joint.name).second) refuse_joint(urdf, joint, joint.name, "is a joint given twice");
    for (const std::string& end : {joint.parent, joint.child}) {
      if (links.contains(end)) continue;
      const std::vector<std::string> known(links.begin(), links.end());
      refuse_joint(urdf, joint, end,
                   "is no link of this file: joint " + joint.name + " (nearest is " + nearest_name(end, known) + ")");
    }
    if (!children.insert(joint.child).second) {
      refuse_joint(urdf, joint, joint.child, "is the child of a second joint, " + joint.name + ": links make no tree");
    }
  }
}

/// No way from child to parent ends where it began.
void check_rings(const UrdfFile& urdf) {
  for (const UrdfJoint& joint : urdf.joints) {
    const UrdfJoint* at = &joint;
    for (std::size_t steps = 0; at != nullptr; at = urdf.joint_to(at->parent)) {
      if (++steps > urdf.joints.size())
        refuse_joint(urdf, joint, joint.name, "is part of a ring of joints: links make no tree");
    }
  }
}

}  // namespace

std::string_view to_string(UrdfType type) {
  return std::ranges::find(kTypes, type, &std::pair<std::string_view, UrdfType>::second)->first;
}

std::optional<UrdfType> type_named(std::string_view name) {
  const auto* const known = std::ranges::find(kTypes, name, &std::pair<std::string_view, UrdfType>::first);
  return known == kTypes.end() ? std::nullopt : std::optional(known->second);
}

const UrdfJoint* UrdfFile::joint_to(const std::string& link) const {
  const auto found = std::ranges::find(joints, link, &UrdfJoint::child);
  return found == joints.end() ? nullptr : &*found;
}

std::vector<const UrdfJoint*> UrdfFile::joints_from(const std::string& link) const {
  std::vector<const UrdfJoint*> all;
  for (const UrdfJoint& joint : joints) {
    if (joint.parent == link) all.push_back(&joint);
  }
  return all;
}

const UrdfLink& UrdfFile::link(const std::string& name) const {
  const auto found = std::ranges::find(links, name, &UrdfLink::name);
  DEMECAL_CHECK(found != links.end(), "link " << name);
  return *found;
}

void check_tree(const UrdfFile& urdf) {
  check_names(urdf);
  check_rings(urdf);
}

}  // namespace demecal::inline urdf
