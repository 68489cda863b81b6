// A URDF: its links and joints, read strictly, each with where it stands in the file. An SDF is read into the same.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/drawn_arm.hpp"
#include "urdf/xml.hpp"

namespace demecal::inline urdf {

enum class UrdfType {
  revolute,
  continuous,
  prismatic,
  fixed,
  floating,
  planar,
  ball,  ///< this one and the following in SDFs only
  universal,
  screw,
  revolute2,
  gearbox
};
inline constexpr UrdfType kLastUrdfType = UrdfType::planar;

/// As the files call it.
std::string_view to_string(UrdfType type);
/// Nothing where neither URDFs nor SDFs have such a type.
std::optional<UrdfType> type_named(std::string_view name);

struct UrdfJoint {
  std::string name, parent, child;
  UrdfType type = UrdfType::fixed;
  Origin origin;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  double lower = 0.0, upper = 0.0;  ///< rad or m; equal: not stated
  std::optional<std::string> mimics;
  std::size_t line = 0;
  XmlElement element;
  Eigen::Vector3d written_rpy = Eigen::Vector3d::Zero();  ///< the angles as the file has them, of an SDF's poses too
};

struct UrdfLink {
  std::string name;
  std::optional<LinkMass> mass;  ///< in the link's own frame
  std::size_t line = 0;
  /// About the centre of mass in the axes of the link's own frame, kg m^2; beside a mass alone.
  std::optional<Eigen::Matrix3d> inertia_kgm2{};
};

struct UrdfFile {
  std::string file, robot;
  bool is_sdf = false;  ///< the text holds no origins that could be written anew
  std::vector<UrdfLink> links{};
  std::vector<UrdfJoint> joints{};

  /// The joint that leads to a link; null for the root.
  const UrdfJoint* joint_to(const std::string& link) const;
  std::vector<const UrdfJoint*> joints_from(const std::string& link) const;
  const UrdfLink& link(const std::string& name) const;
};

inline bool moves(const UrdfJoint& joint) {
  return joint.type != UrdfType::fixed;
}

/// Throws InputError with file, line, value and rule where the text is no URDF, or its links and joints make no tree.
UrdfFile parse_urdf(const std::string& text, const std::string& file);
UrdfFile parse_urdf(const XmlElement& root, const std::string& file);

/// Throws InputError where names are given twice or unknown, or links and joints make no tree.
void check_tree(const UrdfFile& urdf);

}  // namespace demecal::inline urdf
