#include "kinematics/drawn_arm.hpp"
#include "urdf/urdf_arm.hpp"
#include "urdf/urdf_file.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "data/text.hpp"
#include "errors/input_error.hpp"

namespace demecal::inline urdf {
namespace {

/// A link without children, and the joints that are commanded on the way to it.
struct Leaf {
  std::string link;
  std::set<std::string> commanded;
};

std::vector<Leaf> leaves_below(const UrdfFile& urdf, const std::string& base) {
  std::vector<Leaf> leaves;
  for (const UrdfLink& link : urdf.links) {
    if (!urdf.joints_from(link.name).empty()) continue;
    Leaf leaf{link.name, {}};
    std::string at = link.name;
    for (const UrdfJoint* joint = urdf.joint_to(at); at != base && joint != nullptr; joint = urdf.joint_to(at)) {
      if (moves(*joint) && !joint->mimics) leaf.commanded.insert(joint->name);
      at = joint->parent;
    }
    if (at == base && !leaf.commanded.empty()) leaves.push_back(std::move(leaf));
  }
  return leaves;
}

/// Whether another leaf is reached over all joints of this one, and more: this is fixed to the arm on its way.
bool is_on_the_way(const Leaf& leaf, const std::vector<Leaf>& all) {
  return std::ranges::any_of(all, [&](const Leaf& other) {
    return other.commanded.size() > leaf.commanded.size() && std::ranges::includes(other.commanded, leaf.commanded);
  });
}

[[noreturn]] void ask(const UrdfFile& urdf, const std::vector<Leaf>& leaves) {
  std::vector<std::string> names;
  for (const Leaf& leaf : leaves) names.push_back(leaf.link);
  throw InputError({urdf.file, 0}, joined_words(names, ", "),
                   "are links that an arm could end at; say --tip LINK, one of these or a link before them");
}

/// Whether the joint that leads last to the leaf has others that follow it, as fingers of a gripper do.
bool ends_in_gripper(const UrdfFile& urdf, const Leaf& leaf) {
  const UrdfJoint* joint = urdf.joint_to(leaf.link);
  while (joint != nullptr && !moves(*joint)) joint = urdf.joint_to(joint->parent);
  return joint != nullptr &&
         std::ranges::any_of(urdf.joints, [&](const UrdfJoint& other) { return other.mimics == joint->name; });
}

/// Whether the leaf has the origin of the last moving joint: a body of its link rather than a flange.
bool is_body(const UrdfFile& urdf, const Leaf& leaf) {
  const UrdfJoint* joint = urdf.joint_to(leaf.link);
  for (; joint != nullptr && !moves(*joint); joint = urdf.joint_to(joint->parent)) {
    if (!joint->origin.xyz_m.isZero(0.0)) return false;
  }
  return true;
}

/// The one of several ends of the same arm that is its flange, where one can be told.
const Leaf* flange_of(const UrdfFile& urdf, const std::vector<Leaf>& ends) {
  const auto tool0 = std::ranges::find(ends, "tool0", &Leaf::link);
  if (tool0 != ends.end()) return &*tool0;
  const auto is_flange = [&](const Leaf& end) { return !is_body(urdf, end); };
  if (std::ranges::count_if(ends, is_flange) != 1) return nullptr;
  return &*std::ranges::find_if(ends, is_flange);
}

}  // namespace

std::vector<const UrdfJoint*> joints_down(const UrdfFile& urdf, const std::string& above, const std::string& below) {
  std::vector<const UrdfJoint*> joints;
  for (std::string at = below; at != above; at = joints.back()->parent) {
    const UrdfJoint* joint = urdf.joint_to(at);
    if (joint == nullptr)
      throw InputError({urdf.file, urdf.link(below).line}, below, "is a link that does not hang on link " + above);
    joints.push_back(joint);
  }
  std::ranges::reverse(joints);
  return joints;
}

std::string root_link(const UrdfFile& urdf) {
  std::vector<std::string> roots;
  for (const UrdfLink& link : urdf.links) {
    if (urdf.joint_to(link.name) == nullptr) roots.push_back(link.name);
  }
  if (roots.size() == 1) return roots.front();
  throw InputError({urdf.file, 0}, joined_words(roots, ", "), "are links that hang on no other; say --base LINK");
}

std::string tip_link(const UrdfFile& urdf, const std::string& base, std::vector<std::string>& notes) {
  std::vector<Leaf> all = leaves_below(urdf, base);
  // A link beside the arm, as ROS calls the controller's frame, is fixed to one that the arm begins at.
  const UrdfJoint* up = urdf.joint_to(base);
  for (; all.empty() && up != nullptr && !moves(*up); up = urdf.joint_to(up->parent))
    all = leaves_below(urdf, up->parent);
  if (all.empty())
    throw InputError({urdf.file, urdf.link(base).line}, base,
                     "is a link with no moving joint beyond it or a link that it is fixed to");
  std::vector<Leaf> ends;
  std::ranges::copy_if(all, std::back_inserter(ends), [&](const Leaf& leaf) { return !is_on_the_way(leaf, all); });
  if (std::ranges::any_of(ends, [&](const Leaf& end) { return ends_in_gripper(urdf, end); })) ask(urdf, all);
  if (ends.size() == 1) return ends.front().link;
  const bool one_arm =
      std::ranges::all_of(ends, [&](const Leaf& end) { return end.commanded == ends.front().commanded; });
  const Leaf* const flange = one_arm ? flange_of(urdf, ends) : nullptr;
  if (flange == nullptr) ask(urdf, ends);
  std::vector<std::string> others;
  for (const Leaf& end : ends) {
    if (end.link != flange->link) others.push_back(end.link);
  }
  notes.push_back("the arm is taken to end at link " + flange->link + ", not at " + joined_words(others, ", ") +
                  "; --tip LINK takes another");
  return flange->link;
}

}  // namespace demecal::inline urdf
