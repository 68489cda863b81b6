// A robot program as correction sees it: the targets that stand in its text, number by number.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "data/pose.hpp"
#include "programs/cell.hpp"
#include "programs/program_text.hpp"

namespace demecal {

enum class Language { val2, csv, krl, rapid, urscript };

/// How a file writes the tool's orientation.
enum class OrientationForm {
  unknown,          ///< not at all
  columns,          ///< nine numbers, the frame's x, y and z axes one after the other; they are read and kept
  quaternion,       ///< w, x, y, z
  zyx_angles,       ///< about z, then the new y, then the new x
  rotation_vector,  ///< axis times angle
};

/// What a target says of the joints that its pose is to be reached with.
struct ArmHint {
  JointVector near{};                           ///< joints close by; empty: unknown
  std::vector<std::optional<int>> quadrants{};  ///< of each joint: 0 from 0 to 90 degrees, -1 from -90 to 0, ...
  std::vector<std::optional<bool>> negative{};  ///< of each joint: whether its angle is below 0
  bool empty() const { return near.size() == 0 && quadrants.empty() && negative.empty(); }
};

/// How a program comes to a target.
enum class Motion {
  joints,  ///< every joint on its own; also where the program does not say
  line     ///< the tool along a straight line, so that the arm keeps its configuration
};

/// In what a target's pose is written, as the program states it.
struct StatedFrames {
  Eigen::Isometry3d base_from_frame = Eigen::Isometry3d::Identity();
  std::string frame{};                      ///< as the program names it; empty: the base frame
  std::optional<Eigen::Isometry3d> tool{};  ///< flange from tool; nothing where the program states none
  std::string tool_name{};                  ///< as the program names it
  std::string unknown_frame{};              ///< why the frame cannot be known; empty: it is known
  std::string unknown_tool{};               ///< the same of the tool
};

/// A target of joints or of a pose.
struct Target {
  std::string name{};  ///< as the file has it; empty: it has none
  TextPlace place{};
  std::vector<Cell> joints{};    ///< one per joint (rad or m inside), or none
  std::vector<Cell> position{};  ///< x, y, z of the tool point in the frame stated, or none
  OrientationForm form = OrientationForm::unknown;
  std::vector<Cell> orientation{};
  ArmHint hint{};
  Motion motion = Motion::joints;
  std::size_t order = 0;  ///< targets are visited by this, then in the order of the text
  StatedFrames frames{};
  std::optional<ApproachSigns> approach{};  ///< where the file says it
  std::optional<double> payload_kg{}, temperature_celsius{}, time_s{};

  bool is_pose() const { return joints.empty(); }
  /// The first byte of its numbers.
  std::size_t begin() const { return (is_pose() ? position : joints).front().begin; }
};

/// The place of remarks about a program as a whole.
inline constexpr TextPlace kWholeProgram{0, 0};

/// A sentence about a place in the program.
struct Remark {
  TextPlace place;
  std::string name;  ///< of the target it is about; may be empty
  std::string sentence;
};

struct Program {
  Language language = Language::csv;
  std::string file;             ///< as named to the user
  std::vector<Target> targets;  ///< in the order of the text
  std::vector<Remark> left;     ///< what looks like a target but cannot be corrected, and why
};

/// The unit of a joint in files that count in degrees and mm.
CellUnit degrees_or_mm(const Joint& joint);
inline constexpr CellUnit kMillimetres{1e-3, kDecimalsMm};

}  // namespace demecal
