// What was measured: the poses of one robot, the points they were measured at, where they came from, and their sets.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <compare>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data/contacts.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/drawn_arm.hpp"

namespace demecal::inline data {

/// What a pose is used for: fitting, choosing, or the one final judgement.
enum class PoseSet { calibration, validation, accept };

/// As data sets and reports name it.
std::string_view to_string(PoseSet set);

/// -1, 0 or +1 per joint: the sign of its last motion before the pose.
using ApproachSigns = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxJoints, 1>;

struct MeasuredPose {
  JointVector joints;                             ///< commanded, rad or m
  std::optional<Eigen::Vector3d> position_m;      ///< measured tool point
  std::optional<Eigen::Quaterniond> orientation;  ///< measured, unit
  std::vector<double> distances_m;                ///< measured from fixed points, in the order of DataSet::anchors
  std::optional<Eigen::Matrix3d> position_covariance_m2{};  ///< as stated, in the position's own axes
  /// What differences of the position are multiplied by (symmetric) to count as those of a pose as sure as usual;
  /// nothing: it is one.
  std::optional<Eigen::Matrix3d> position_whitening{};
  std::optional<ApproachSigns> approach;
  std::optional<JointVector> torque{};  ///< by which each drive held its joint, along its axis, as logged: Nm or N
  std::optional<double> payload_kg;
  std::optional<double> temperature_celsius;
  std::optional<double> time_s;
  PoseSet set = PoseSet::calibration;
  std::string pose_id;                            ///< equal ids are repeats of one pose
  std::string target;                             ///< which point on the tool; empty: the robot's own tool
  std::string contact{};                          ///< what the tool touches; empty: nothing
  ContactKind contact_kind = ContactKind::point;  ///< that of DataSet::contacts
  double contact_length_m = 0.0;                  ///< of the wire between tool and contact; 0 where it is none
  double contact_weight = 1.0;  ///< what differences from it are multiplied by, see weigh_by_flatness()
  std::string station{};        ///< where it was measured from; empty: the first, or only one
  std::size_t line = 0;         ///< where it stands in its file
};

/// As a pose is called that its file does not name, and whether its file names it.
std::string line_name(std::size_t line);
bool names_itself(const MeasuredPose& pose);

/// What stands beside a pose's line in a sentence: " (P7)"; nothing where its file names no poses.
std::string name_beside_line(const MeasuredPose& pose);

/// Whether positions are given in the robot's base frame or in the instrument's own.
enum class Frame { base, sensor };

/// Per link, for gravity: mass and centre of mass in the link's own frame.
struct LinkMass {
  double mass_kg = 0.0;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
};

/// Where an arm was imported from.
struct UrdfSource {
  std::string file;  ///< absolute, or as it was given
  std::string base;  ///< link
  std::string tip;   ///< link
};

/// A spring, gas spring or cylinder that relieves a revolute joint of weight, between a pivot on the link before it and
/// one on the link behind it.
struct Balancer {
  int joint = 0;
  double fixed_m = 0.0;       ///< from the joint's axis to the pivot on the link before it
  double moving_m = 0.0;      ///< and to that on the link behind it; not the same
  double shortest_rad = 0.0;  ///< where the joint stands when the pivots are nearest
};

/// The arm as its maker describes it.
struct Robot {
  std::string name;
  Chain chain;
  std::vector<LinkMass> masses;  ///< empty where unknown
  Eigen::Vector3d gravity_mps2{0.0, 0.0, -9.81};
  std::optional<double> repeatability_m;
  std::optional<double> payload_kg{};    ///< the most that it carries beyond its flange
  JointVector home{};                    ///< rad, m: where programs start that do not say it; empty: not declared
  std::vector<double> pulses_per_deg{};  ///< of each joint's motor (per mm where it slides); empty: not declared
  std::optional<DrawnArm> drawing{};     ///< where the file says more of the arm than rows; `chain` is made from it
  std::optional<UrdfSource> urdf{};      ///< the file that `drawing` was made from
  std::vector<Balancer> balancers{};     ///< at most one of a joint
};

/// A further place that instruments measured from. Its poses are given in the first station's frame, as near as base
/// and tool alone of each tell the one from the other; what that is wrong by is fitted with the rest.
struct Station {
  std::string name;
  std::string sha256;  ///< of the data set it is
  Eigen::Isometry3d first_from_own = Eigen::Isometry3d::Identity();
};

struct DataSet {
  std::string name;
  Robot robot;
  Frame frame = Frame::sensor;
  std::vector<MeasuredPose> poses;
  std::vector<MeasuredPose> excluded;              ///< by name: no part of anything but the report's list of them
  std::map<std::string, Eigen::Vector3d> tools_m;  ///< nominal tool point of each target; empty: the robot's tool
  std::vector<Eigen::Vector3d> anchors_m;          ///< known fixed points of the distances
  bool anchors_unknown = false;
  double usual_sigma_m = 0.0;       ///< of a position's coordinate, by what is stated (median); 0: nothing is
  Contacts contacts{};              ///< what is known of the contacts that the poses name
  std::vector<Station> stations{};  ///< further ones; empty: all was measured from one place
  std::string file;                 ///< of the poses, as named to the user
  std::string sha256;               ///< of the bytes the poses were read from
};

/// Those poses as a sentence names them: "P7 (line 12), line 14", by their lines too, since names may repeat.
std::string names_with_lines(const DataSet& data, const std::vector<std::size_t>& poses);

/// Indices into poses, in their order.
std::vector<std::size_t> poses_of(const DataSet& data, PoseSet set);

/// The poses of one set that touch one contact: its place is known by them alone, so that no set borrows from another.
struct ContactGroup {
  std::string contact;
  PoseSet set = PoseSet::calibration;

  auto operator<=>(const ContactGroup&) const = default;
};

/// The group of a pose that touches something.
inline ContactGroup group_of(const MeasuredPose& pose) {
  return {pose.contact, pose.set};
}

/// The poses of every group among these poses, in their order.
std::map<ContactGroup, std::vector<std::size_t>> contact_groups(const DataSet& data,
                                                                std::span<const std::size_t> poses);
std::map<ContactGroup, std::vector<std::size_t>> contact_groups(const DataSet& data);

/// Takes wires from fixed points that nobody knows for contacts ("anchor 1" ...): a pose with several becomes a row for
/// each, "id wire 1" ... Throws InputError where such a pose touches something else.
void take_wires_for_contacts(DataSet& data);

/// Settles what the stated covariances of positions make of each, against the median over the set. Poses without one
/// count as usual.
void weigh_by_stated_uncertainty(DataSet& data);

/// Settles how much less poses on uneven planes count: touches scatter by the robot's repeatability (0.05 mm where it
/// is not stated) and by the plane's flatness over the root of 12.
void weigh_by_flatness(DataSet& data);

/// Whether any of the poses touches something; whether any was measured by something with a place of its own, so that
/// it can be told where the base stands.
bool has_contacts(const DataSet& data);
bool has_instrument(const DataSet& data);

/// The nominal tool point of a pose, in the flange frame, m.
Eigen::Vector3d nominal_tool(const DataSet& data, const MeasuredPose& pose);

/// Fractions of the poses, each 0 to 1; the rest is for calibration.
struct SplitFractions {
  double validation = 0.3;
  double accept = 0.0;
};

/// A random index below its argument.
using DrawIndex = std::function<std::size_t(std::size_t)>;

/// Sets every pose's set, by pose id: repeats stay together. Each set gets its fraction of the ids, rounded;
/// calibration keeps one at least. The poses of every contact are divided by themselves, so that calibration and
/// validation see it where enough poses touch it. Equal draws give equal sets.
void split_by_pose(std::span<MeasuredPose> poses, const SplitFractions& fractions, const DrawIndex& draw);

}  // namespace demecal::inline data
