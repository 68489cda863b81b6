// Structures of an arm as genomes: sequences of elementary transforms that stand after its links (thesis, appendix B);
// and the arm that they make: where its tool is, and how it moves with every number.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <compare>
#include <cstddef>
#include <string>
#include <vector>

#include "kinematics/chain.hpp"
#include "prediction/corrected_robot.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline structure {

/// An elementary transform whose amount is not yet known.
struct Gene {
  bool rotates = false;  ///< about the axis; otherwise it translates along it
  int axis = 0;          ///< 0 x, 1 y, 2 z, of the frame it stands in

  auto operator<=>(const Gene&) const = default;
};

using GeneSection = std::vector<Gene>;

/// Section i stands between link i and what follows it (from 0): before the own motion of joint i + 1, in the frame
/// whose z is its axis; the last section stands at the flange. The links themselves never change their order.
using Genome = std::vector<GeneSection>;

/// The longest section that crossover and mutation make, and that genomes begin with.
inline constexpr std::size_t kLongestSection = 5;

/// Sections of 0 to kLongestSection random genes each, one section per link.
Genome random_genome(int links, RandomStream& random);

/// Section by section, the first genes of one parent's and the last ones of the same section of the other's; the order
/// of the links cannot change. Both must have equally many sections.
Genome crossed(const Genome& a, const Genome& b, RandomStream& random);

/// With a gene put in, taken out or made another at a random place.
Genome mutated(Genome genome, RandomStream& random);

/// What a genome says: of consecutive equal genes all but the first are left out, since their amounts only add up.
Genome expressed(const Genome& genome);

/// How many genes it has.
std::size_t gene_count(const Genome& genome);

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
