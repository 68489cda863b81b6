// The public interface of demecal: an arm, what was measured of it, its calibration in this process, and what follows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// In ten lines:
///
///     #include <demecal/demecal.hpp>
///     #include <iostream>
///     int main() {
///       const demecal::Measurements measured = demecal::Measurements::load("dataset.yaml");
///       const demecal::CalibratedArm arm = demecal::calibrate(measured);
///       std::cout << arm.errors(measured, demecal::PoseUse::validation).rms_mm << " mm rms\n";
///       for (const double joint_deg : arm.correct({{10, -80, 120, 0, 40, 0}})) std::cout << joint_deg << ' ';
///       arm.save("model.yaml");
///     }
///
/// Units are in the names. Values of joints, their limits too, are in deg, in mm where a joint slides; vectors of them
/// begin with joint 1. Quaternions are w, x, y, z, of unit length. Positions are of the tool point, in the frame of
/// the measurements unless said otherwise.
///
/// Wrong input (a file, a value, measurements that contradict the arm) is thrown as std::runtime_error, whose what()
/// names file, line, value and rule. No function prints, opens a socket, or uses a clock or chance: the same
/// measurements and settings give the same model to the last bit, on any number of threads. Objects are values, cheap
/// to copy; one may be read by many threads.
namespace demecal::inline library {

/// A joint and its link, by Denavit-Hartenberg parameters.
struct ArmLink {
  double alpha_deg = 0.0, a_mm = 0.0, d_mm = 0.0, theta_offset_deg = 0.0;
  double lower = -180.0, upper = 180.0;  ///< limits of the joint, deg (mm)
  bool prismatic = false;
  double mass_kg = 0.0;  ///< of the link; where all links have none, effects of gravity are not looked for
  std::array<double, 3> centre_of_mass_mm{};  ///< in the link's own frame
};

/// An arm as its maker describes it.
struct ArmDescription {
  std::string name = "arm";
  std::vector<ArmLink> links;       ///< 1 to 9
  bool modified_dh = false;         ///< Rx Tx Rz Tz in place of Rz Tz Tx Rx
  std::array<double, 3> tool_mm{};  ///< the tool point in the flange's frame
};

struct ToolPose {
  std::array<double, 3> position_mm{};
  std::array<double, 4> quaternion_wxyz{1.0, 0.0, 0.0, 0.0};
};

/// Where a robot is sent, and what its errors there depend on besides.
struct JointCommand {
  std::vector<double> joints;   ///< one per joint, deg (mm)
  std::vector<int> approach{};  ///< sign of each joint's last motion before, -1, 0 or 1; empty: unknown
  double payload_kg = 0.0;      ///< at the tool point
  std::optional<double> temperature_celsius{};
  std::optional<double> time_s{};
};

/// What a pose is for: fitting, choosing between models, or judging the final one.
enum class PoseUse { calibration, validation, accept };

/// One measured pose.
struct PoseMeasurement {
  JointCommand command;
  std::array<double, 3> position_mm{};
  std::optional<std::array<double, 4>> quaternion_wxyz{};
  std::optional<PoseUse> use{};  ///< where no pose says it, 30 % of the poses validate, drawn with a fixed seed
  std::string id{};              ///< poses with equal ids are repeats of one; empty: numbered
};

/// An arm, nominal.
class Arm {
 public:
  /// The arm of a ROBOT.yaml.
  static Arm load(const std::filesystem::path& robot_file);
  explicit Arm(const ArmDescription& description);

  std::string name() const;
  int joints() const;
  /// Where the tool is, in the frame of the arm's base.
  ToolPose pose(const std::vector<double>& joints) const;

  struct Implementation;
  explicit Arm(std::shared_ptr<const Implementation> implementation);
  const Implementation& implementation() const { return *implementation_; }

 private:
  std::shared_ptr<const Implementation> implementation_;
};

/// What was measured of an arm.
class Measurements {
 public:
  /// The data set of a DATASET.yaml, with the robot and the poses that it names.
  static Measurements load(const std::filesystem::path& dataset_file);
  /// `in_base_frame`: positions are given in the frame of the arm's base, otherwise in the instrument's own.
  Measurements(const Arm& arm, const std::vector<PoseMeasurement>& poses, bool in_base_frame = false);

  Arm arm() const;
  std::size_t size() const;
  std::size_t count(PoseUse use) const;
  /// What looks wrong in them, each in one sentence: signs, units, columns, single rows; none: nothing does. Rows that
  /// are copies of others are not counted as poses.
  const std::vector<std::string>& findings() const;
  /// Whether what was found means that they cannot be of this arm.
  bool contradict_arm() const;

  struct Implementation;
  explicit Measurements(std::shared_ptr<const Implementation> implementation);
  const Implementation& implementation() const { return *implementation_; }

 private:
  std::shared_ptr<const Implementation> implementation_;
};

struct CalibrationSettings {
  /// A JOB.yaml with all that may be set; the data set that it names is not used. Empty: its defaults.
  std::filesystem::path job_file{};
  /// In place of the job's: of "registration", "tool", "joint_offset", "geometry", "joint_corrections". Empty: the
  /// job's, by default the first and the last.
  std::vector<std::string> declared{};
  std::optional<std::uint64_t> seed{};  ///< in place of the job's
  std::optional<int> max_effects{};     ///< in place of the job's: that may be added to what is declared; 0: none
  unsigned threads = 0;                 ///< that evolve formulas; 0: one per core. Changes the time alone
  bool force = false;                   ///< go on although the measurements contradict the arm
  /// Told in a sentence what begins or was found; returns false to end early with what was reached.
  std::function<bool(const std::string&)> progress{};
};

/// Distances from predicted to measured tool points, over some poses; NaN where there are none.
struct PositionErrors {
  double mean_mm, rms_mm, p95_mm, max_mm;
};

/// How far a pose was measured from where the model predicts it, and how far that was to be expected.
struct PoseError {
  std::string id;
  PoseUse use = PoseUse::calibration;
  double error_mm = 0.0;       ///< between predicted and measured tool points
  double interval95_mm = 0.0;  ///< radius that holds 95 % of such errors; NaN where the model does not state it
};

/// An effect that was added to what was declared.
struct AddedEffect {
  std::string kind;      ///< "backlash", "gear_harmonic", ...
  int joint = 0;         ///< from 1; 0: of the arm or the instrument as a whole
  std::string sentence;  ///< what is the matter and how much of it, for a person
};

/// The model of an arm as it really is.
class CalibratedArm {
 public:
  /// The model of a model.yaml; a fleet's mean, which is no robot's, is refused.
  static CalibratedArm load(const std::filesystem::path& model_file);
  /// As model.yaml, for the program demecal too; replaces a file of that name.
  void save(const std::filesystem::path& model_file) const;

  /// The arm as its maker describes it.
  Arm nominal() const;
  /// Where the tool really is when the robot is sent there.
  ToolPose predict(const JointCommand& command) const;
  /// The joints to send, deg (mm), so that the tool really is where it would nominally be at `command`, in the frame of
  /// the arm's own base: neither the instrument's place nor its errors are corrected. Where that cannot be reached
  /// (singular poses, fewer than 6 joints) as near as it can be, the position first.
  std::vector<double> correct(const JointCommand& command) const;
  /// The radius that holds the real tool point 95 % of the time about where predict() has it at `command`, or correct()
  /// sends it (k = 2): by the covariance of the model and its own error, without measurement noise, without what is not
  /// known of the instrument's place, and larger outside what was measured and, where effects depend on the
  /// temperature, without one. NaN where the model does not state it.
  double error95_mm(const JointCommand& command) const;
  /// Why that radius is larger than where the arm was measured: "joint 2 at 63 deg, measured -60 .. 60 deg".
  std::vector<std::string> widened_by(const JointCommand& command) const;
  /// The text of a robot program with its targets corrected, as `demecal apply` does: what is not known to get better
  /// stays as it is. `file` names the program's language by its ending. `warnings`, where given, are added to.
  std::string correct_program(const std::string& text, const std::string& file,
                              std::vector<std::string>* warnings = nullptr) const;

  /// Over the poses of one use; `measured` must be of the same arm.
  PositionErrors errors(const Measurements& measured, PoseUse use) const;
  /// One by one, in the order of measuring.
  std::vector<PoseError> pose_errors(const Measurements& measured) const;
  std::vector<AddedEffect> effects() const;
  /// Of a joint, from 1: what is added to its commanded angle theta (rad), as a formula; "0" where nothing is.
  std::string correction(int joint) const;

  struct Implementation;
  explicit CalibratedArm(std::shared_ptr<const Implementation> implementation);
  const Implementation& implementation() const { return *implementation_; }

 private:
  std::shared_ptr<const Implementation> implementation_;
};

/// Fits what is declared, evolves a correction of every joint on islands in this process, looks for effects that the
/// model lacks, and adds those that the validation poses confirm: as `demecal calibrate` does, with the same bits.
CalibratedArm calibrate(const Measurements& measured, const CalibrationSettings& settings = {});

}  // namespace demecal::inline library
