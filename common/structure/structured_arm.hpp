// An arm whose links are followed by elementary transforms: where its tool is, and how it moves with every number.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "kinematics/chain.hpp"
#include "prediction/corrected_robot.hpp"
#include "structure/genome.hpp"

namespace demecal::inline structure {

/// The links of `robot` are held as they are; what follows them, its base and its tools are what can be fitted.
struct StructuredArm {
  CorrectedRobot robot;  ///< without effects; corrections are kept
  Genome genome;
  std::vector<double> values{};  ///< of the genes in their order, rad or m

  /// Pose of the tool in the frame of the measurements, at commanded joints.
  Eigen::Isometry3d predict(const JointVector& commanded, const std::string& target) const;
};

/// Which numbers of a structured arm are free, in this order: the base's six where `base` (translation, then turn, in
/// the measurements' frame about the base's origin), of each target in `tools` three (flange frame) or, with
/// `tool_turns`, six, then the genes.
struct StructureFreedom {
  bool base = false;
  bool tool_turns = false;
  std::vector<std::string> tools{};

  int tool_size() const { return tool_turns ? 6 : 3; }
  int before_genes() const { return (base ? 6 : 0) + tool_size() * static_cast<int>(tools.size()); }
};

/// Where the tool is, and its twist (6 x numbers; linear m, angular rad; measurements' frame) per unit of each number.
struct StructureMotion {
  Eigen::Isometry3d predicted = Eigen::Isometry3d::Identity();
  Eigen::Matrix<double, 6, Eigen::Dynamic> twists;
};
StructureMotion motion_of(const StructuredArm& arm, const StructureFreedom& freedom, const JointVector& commanded,
                          const std::string& target);

/// The arm with every free number changed: rotations of base and tools are turned by the rotation vector of their
/// change, all else adds.
StructuredArm changed(const StructuredArm& arm, const StructureFreedom& freedom, const Eigen::VectorXd& change);

/// A robot without transforms between its links that predicts what `arm` does, everywhere, to rounding. Every transform
/// goes into the link before it: the next axis is a line, and four numbers lead to any line (Denavit and Hartenberg,
/// 1955; Hayati's beta in place of d between axes that are nominally parallel); what turns about and shifts along that
/// line goes on to the next joint, and what is left at the flange to the tools. The base stays.
CorrectedRobot equivalent_robot(const StructuredArm& arm);

}  // namespace demecal::inline structure
