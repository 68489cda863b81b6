// A robot program as correction sees it: the targets that stand in its text, number by number, and the frames it
// states; and what a controller keeps outside of programs, which name it only: frames and tools, and what a pulse is.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "parsed_programs/orientation.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline parsed_programs {

/// What a target states of one part of the arm by itself. Neither word nor kept: any side will do.
struct PartHint {
  std::string word{};  ///< for a side, of which the same is known as of ArmHint::configuration
  bool kept = false;   ///< the side that it is on before
};

/// What a target says of the joints that its pose is to be reached with.
struct ArmHint {
  JointVector near{};                           ///< joints close by; empty: unknown
  std::vector<std::optional<int>> quadrants{};  ///< of each joint: 0 from 0 to 90 degrees, -1 from -90 to 0, ...
  std::vector<std::optional<bool>> negative{};  ///< of each joint: whether its angle is below 0
  /// The words that state it, where makers do not say the same by them: all that is known is that targets with the same
  /// words are reached in the same configuration. Empty: none.
  std::string configuration{};
  /// Of shoulder, elbow and wrist, where words do not state all of them; empty: none is stated. The words of
  /// `configuration` are then those of the three, a blank between them.
  std::vector<PartHint> parts{};
  /// The joints, from 0, of which the words also state whether they are beyond half a turn, or by how many turns.
  std::vector<std::size_t> counted_turns{};
  /// Of each joint, where the words state by how many whole turns: 0 from -180 to 180 degrees, 1 from 180 to 540, ...
  std::vector<std::optional<int>> turns{};
  /// Along a line KUKA's controllers go on from where the arm is: what S and T say counts for PTP alone.
  bool counts_on_lines() const { return negative.empty(); }
  bool empty() const {
    return near.size() == 0 && quadrants.empty() && negative.empty() && configuration.empty() && parts.empty();
  }
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
  bool several_tools = false;               ///< motions go to it with different ones
};

/// A place near a target that the program moves to in its stead, as by appro, Offs or JAPPRO.
struct NearPlace {
  std::optional<Eigen::Vector3d> shift_m{};  ///< from the target; nothing: it turns, or is not told in numbers
  bool along_tool = true;                    ///< by the tool's axes at the target; otherwise by those of the frame
  Motion motion = Motion::joints;
};

/// A target of joints or of a pose.
struct Target {
  std::string name{};  ///< as the file has it; empty: it has none
  TextPlace place{};
  std::vector<Cell> joints{};    ///< one per joint (rad or m inside) behind those of `carried`, or none
  std::vector<Cell> position{};  ///< x, y, z of the tool point in the frame stated, or none
  OrientationForm form = OrientationForm::unknown;
  std::vector<Cell> orientation{};
  /// Where the rails that carry the arm stand: the model's first joints, which stay as they are. Poses are counted from
  /// where the rails are, and do not move along.
  std::vector<Cell> carried{};
  ArmHint hint{};
  Motion motion = Motion::joints;
  std::size_t order = 0;                            ///< targets are visited by this, then in the order of the text
  std::vector<std::size_t> further_motions{};       ///< bytes at which the program moves to it again
  std::map<std::size_t, NearPlace> near_motions{};  ///< by the bytes at which it moves near it
  StatedFrames frames{};
  /// Why the robot may be sent elsewhere than to these numbers, which are then left as they are; empty: it is not.
  std::string not_sent_to{};
  /// That reason is only that the program records in it where the arm stands.
  bool only_recorded = false;
  std::optional<ApproachSigns> approach{};  ///< where the file says it; NaN of joints of which it does not
  std::optional<double> payload_kg{}, temperature_celsius{}, time_s{};

  bool is_pose() const { return joints.empty(); }
  /// So many joints, from the base on, stay as they are.
  int held() const { return static_cast<int>(carried.size()); }
  /// The first byte of its numbers.
  std::size_t begin() const { return (is_pose() ? position : joints).front().begin; }
};

/// The place of remarks about a program as a whole.
inline constexpr TextPlace kWholeProgram{0, 0, 0};

/// A sentence about a place in the program.
struct Remark {
  TextPlace place;
  std::string name;  ///< of the target it is about; may be empty
  std::string sentence;
};

/// A file that a program has besides its first.
struct FurtherFile {
  std::string name{};     ///< as named to the user
  std::size_t begin = 0;  ///< where it begins in the text of the whole program
};

/// What is run in one go, up to where the next begins in the text. Before one that comes behind no other, such as where
/// a routine begins, it is not known where the arm stands.
struct Stretch {
  std::size_t begin = 0;
  std::vector<std::size_t> next{};  ///< the numbers of those that may come behind it
  /// The first stretches of the routines that it begins by calling: one of them, where several may be meant.
  std::vector<std::size_t> calls{};
  bool leaves = false;  ///< behind it a routine may end
};

/// A statement that says what the arm carries from then on.
struct PayloadStatement {
  TextPlace place{};
  std::size_t begin = 0;       ///< its first byte
  std::optional<double> kg{};  ///< nothing where it names a number of the controller's, or computes it
  /// It holds for motions up to this byte alone, whatever other statements say; 0: from then on.
  std::size_t alone_until = 0;
};

struct Program {
  std::string language{};              ///< the name of its row in all_languages()
  std::string file{};                  ///< the first, as named to the user
  std::vector<FurtherFile> further{};  ///< in the order of the text
  std::vector<Target> targets;         ///< in the order of the text
  std::vector<Remark> uncorrected;     ///< what looks like a target but cannot be corrected, and why
  std::vector<Remark> remarks{};       ///< what else should be known before it runs
  /// How its joints are taken to count where controllers of this language usually count otherwise than the robot's
  /// description: a sentence, else empty.
  std::string joint_counting{};
  /// Bytes where the joints before say nothing of those after: of motions to a place that is none of the targets, of
  /// what may stop a motion on its way, and of calls of routines that move.
  std::vector<std::size_t> joints_lost_at{};
  std::vector<PayloadStatement> payload_statements{};  ///< in the order of the text
  /// In the order of the text; empty: all of it is run in its order.
  std::vector<Stretch> way{};

  /// The name of a file by its number (TextPlace::file).
  const std::string& file_name(std::size_t number) const { return number == 0 ? file : further[number - 1].name; }
  /// The number of the file that a byte of the text is of.
  std::size_t file_at(std::size_t offset) const;
};

/// Whether the file's orientation is kept as it is.
bool keeps_orientation(const Target& target);
/// Where a pose target, as written, has the tool point: base frame, axes of the flange. Its orientation must be known.
Eigen::Isometry3d stated_tool_pose(const Target& target);
/// Its tool point alone, base frame.
Eigen::Vector3d stated_point(const Target& target);
/// A place this far before a target, against the direction of the tool's z axis; where it is not told, near it.
NearPlace place_before(std::optional<double> distance_mm);
/// The axes of the tool at the target, as the program has them, or of the frame that it is stated in, in the base.
Eigen::Matrix3d stated_axes(const Target& target, bool of_tool);
/// The tool's axes on the flange, as the program has them.
Eigen::Matrix3d tool_axes(const Target& target);
/// The signs that the target states, and of joints of which it states none those of `motions`.
ApproachSigns approach_of(const Target& target, const ApproachSigns& motions);
/// The values of the cells, in SI units or rad.
std::vector<double> inside(const std::vector<Cell>& cells);
/// Of all joints, of a target that states them.
JointVector stated_joints(const Target& target);

// What readers are made of

inline constexpr CellUnit kMillimetres{1e-3, kDecimalsMm};
/// The units of the arm's joints in files that count in degrees and mm, from joint `first` (from 0) on.
std::vector<CellUnit> joint_units(const Chain& arm, int first = 0);

/// A frame in a program: its pose, or why it has none that can be known.
struct KnownFrame {
  std::string name{};  ///< as the program has it
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  std::string unknown{};  ///< empty: `pose` is known

  static KnownFrame computed(const std::string& what);  ///< "WHAT is computed when the program runs"
};

/// Takes a declaration of a frame; one that is declared with different numbers is unknown from then on.
template <typename Key>
void declare(std::map<Key, KnownFrame>& declared, const Key& key, const KnownFrame& frame) {
  const auto [before, fresh] = declared.try_emplace(key, frame);
  if (!fresh && before->second.unknown.empty() && !(frame.unknown.empty() && frame.pose.isApprox(before->second.pose)))
    before->second.unknown = frame.name + " is given more than once";
}

void set_tool(StatedFrames& frames, const KnownFrame& tool);
void set_frame(StatedFrames& frames, const KnownFrame& frame);

/// One motion to a target.
struct TargetUse {
  std::size_t begin = 0;  ///< of the motion in the text
  Motion motion = Motion::joints;
  StatedFrames frames{};
  std::optional<NearPlace> near{};  ///< of a motion that does not go to the target itself
};

/// Gives the target what its uses (at least one) say: the place of the first that goes to it (of the first, where none
/// does), a line only where all are lines, and their frames, unknown where they differ.
void take_uses(const std::vector<TargetUse>& uses, Target& target);

/// Whether a target's numbers must be numbers: those that declare it as data; elsewhere they may be expressions.
enum class Numbers { required, or_expressions };

/// The cells of the items, each with the unit beside it. Nothing, and a remark in `program`, where one is an expression
/// and may be one; throws InputError where one is neither.
std::optional<std::vector<Cell>> cells_of(const ProgramText& text, std::span<const BracketItem> items,
                                          std::span<const CellUnit> units, Numbers numbers, Program& program,
                                          const Target& target);

/// Says in `program` why this target cannot be corrected.
void skip_target(Program& program, const Target& target, const std::string& why);

/// Says in `program` that the motion at `begin` of the text goes to a place that is none of its targets, and why it is
/// none: what is known of the joints ends there.
void note_unknown_motion(Program& program, std::size_t begin, const Target& target, const std::string& why);

/// That motions to it go to none of the program's targets, as it is taken out of them.
void end_at_motions_to(const Target& target, Program& program);

/// Within which an arm's error changes little.
inline constexpr double kCloseToPoint_mm = 100.0;

/// Says in `program` that a place so far from the target of this name (nothing: it is not known how far) is given the
/// target's correction; not where it is close by.
void note_offset(Program& program, const TextPlace& place, const std::string& name, std::optional<double> distance_mm);

/// Throws InputError at the place unless w, x, y, z are a unit quaternion, to the digits that files keep.
void require_quaternion(const ProgramText& text, std::span<const Cell> cells);

/// Throws InputError unless the arm has the six joints that this language's targets have.
void require_six_joints(const Chain& arm, const std::string& file, const std::string& language);

/// How many rails carry the arm: joints that slide, before the six that this language's targets have. Throws InputError
/// unless it has six behind them.
int rails_of(const Chain& arm, const std::string& file, const std::string& language);

struct ControllerData {
  std::map<std::string, Eigen::Isometry3d> frames{};  ///< base from frame, by number or name in small letters
  std::map<std::string, Eigen::Isometry3d> tools{};   ///< flange from tool, likewise
  std::vector<double> pulses_per_deg{};               ///< of each joint (per mm where it slides); empty: unknown
  std::vector<ProgramFile> applications{};  ///< files beside the program that may describe the application it is of

  /// The frame of this key or, where it is not here, one that is unknown since it "is not given in this file". `name`
  /// is how people call it.
  KnownFrame frame(std::string_view key, const std::string& name) const;
  KnownFrame tool(std::string_view key, const std::string& name) const;
};

/// What a reader is given.
struct ReaderInput {
  const ProgramSource& source;
  const Chain& arm;
  const ControllerData& controller;
};

}  // namespace demecal::inline parsed_programs
