// The searches that a check runs one after another, those of what poses touch included; each returns what it finds.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "parameters/posterior.hpp"
#include "prediction/corrected_robot.hpp"
#include "trials/finding.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {

// What a real arm may leave. Base, tools and links are fitted, links held near their description (5 mm and 1 degree
// standard deviation): five measured series of the shared data then leave .011 to .19 % of their reach at the median, a
// cable-driven arm the most; simulated arms .002 to .023 %; mistakes of a whole set 2.8 % and more. Thus:
inline constexpr double kImplausibleShare = 0.006;  ///< of the reach: more than this no real arm leaves
inline constexpr double kManyRows = 0.15;           ///< share of rows that are no single ones
inline constexpr double kNotableShare = 0.0008;  ///< of the reach: from here on explanations are tried, and poses named
inline constexpr std::size_t kFewestRecorded = 20;  ///< rows that tell what recording did

/// The rows of a data set for the check: all of them, and those calibration rows that explanations are tried on.
struct CheckedRows {
  Trial whole;  ///< in the file's order
  Trial trial;
};

/// The points that were measured, in the order of the poses, as the description has the arm; tools in the order in
/// which they occur, which `target_of` is set to where it is given.
Trial measured_trial(const DataSet& data, std::map<std::string, int>* target_of = nullptr);

/// A change of a joint's zero in words: "0.057 deg".
std::string zero_text(const Chain& chain, int joint, double by);

/// What contradicts the robot's description, if anything does: `fit` is that of links to `rows.trial`, `placed` that of
/// base and tools alone. Where the median error is notable the explanations of whole_set_explanations(), shifts of rows
/// and moves of the instrument are tried; one that halves the error is named (a move is not: no contradiction). An
/// error that is implausible, and that nothing explains, means shuffled rows or another robot. Where most rows fit and
/// many do not a shift of the others is looked for.
std::vector<Finding> find_contradictions(const DataSet& data, const CheckedRows& rows, const TrialFit& placed,
                                         const TrialFit& fit);

/// Where 15 % of the rows of a set and more are off while the others fit `fit` to a tenth of that: how they fit, if
/// by a sign, offset, exchange, unit, pair of axes or targets, or a shift of rows. Fewer rows that stand together, five
/// at least, are read in the same ways, but for offsets of any size; so are most rows of a set that was not fitted.
/// Base, tools and links are held.
std::optional<Finding> explain_wrong_rows(const DataSet& data, const Trial& whole, const TrialFit& fit,
                                          PoseSet set = PoseSet::calibration);

/// The same rows where they are farther off than any arm errs, and nothing that was tried explains them. Of a set that
/// was not fitted most rows may lack an offset of one joint, which is named then: try another frame and tool before.
std::optional<Finding> name_wrong_rows(const DataSet& data, const Trial& whole, const TrialFit& fit,
                                       PoseSet set = PoseSet::calibration);

/// Moves of the instrument among the calibration poses, and zeros of joints and tools that changed. Rows come back with
/// the stations, zeros and tools that say so, `fit` fitted to them.
std::vector<Finding> take_out_moves(const DataSet& data, CheckedRows& rows, TrialFit& fit);

/// Whether base and tools alone bring the nominal arm to the points as closely as their file is rounded, or to a
/// hundred thousandth of its reach: then nobody measured them. `placed`: the fit of base and tools to `trial`.
std::optional<Finding> find_computed_positions(const Trial& trial, const TrialFit& placed);

/// Axes of the instrument that are stretched against each other, or not square, by more than base, tools, links, gears
/// and elasticity of the arm can explain. Rows come back without that, `placed` and `fit` fitted to them.
std::optional<Finding> find_wrong_axes(const DataSet& data, CheckedRows& rows, TrialFit& placed, TrialFit& fit);

/// In data said to be in the base's frame: axes, a turn of joint 1, or another frame where the fitted base is not
/// there.
std::vector<Finding> find_other_base(const DataSet& data, const TrialFit& fit);

/// Whether a change of a tool point is more than 10 mm and than 5 of its standard deviations.
bool is_another_tool(const Eigen::Vector3d& change_m, const Eigen::Matrix3d& covariance_m2);

/// Tools that the points put elsewhere than their description does, by more than 10 mm and than 5 standard deviations:
/// a quarter turn of the last joint, or another tool. `target_of`: the number of each target's tool in `trial`.
std::vector<Finding> find_other_tools(const Trial& trial, const std::map<std::string, int>& target_of,
                                      const TrialFit& fit);

/// Measured orientations that scatter by 5 degrees or more (median) about one turn of the tool on the flange, by a fit
/// of positions: another order or direction of quaternions, the sign of a joint, or nothing that is known. Where most
/// agree: the rows that are 8 times the median and a degree off.
std::vector<Finding> find_wrong_orientations(const DataSet& data, const Trial& trial, const TrialFit& fit);

/// What is known of the rows of a data set by a fit.
struct PointPrediction {
  std::function<Eigen::Vector3d(const TrialRow&)> point;  ///< tool point at the row's joints, m, instrument's frame
  std::function<double(const TrialRow&)> deviations_off;  ///< how far off the row is, in standard deviations
};

/// A finding for each pose among `rows` (of any sets) that lies farther out than 8 standard deviations, than 3.5
/// times what four in five poses keep, and than `least_m`, which good poses may err by: rows whose points fit each
/// other's joints (a cycle of up to four), points that stand beside other joints too, one coordinate with the other
/// sign or two exchanged, by which it fits ten times better and lies no farther out than those above do; one joint with
/// another value (or two exchanged) by which the pose fits to within the noise and ten times better; and what is left
/// as outliers, each with its error. Fifty times better is enough for all of these.
std::vector<Finding> find_single_poses(const DataSet& data, const std::vector<TrialRow>& rows,
                                       const PointPrediction& predict, double least_m);

/// Joints that move by less than 2 degrees (5 mm) over the calibration poses, and measured points on a line or plane.
std::vector<Finding> find_lacking_spread(const DataSet& data);

/// Poses that carry more than the arm can.
std::optional<Finding> find_implausible_payloads(const DataSet& data);

/// Values rounded coarsely: positions, and joints whose errors do not follow position or side of a joint.
std::vector<Finding> find_coarse_values(const DataSet& data, const Trial& trial, const TrialFit& fit);

/// Of each row the way that the joints came from the stop before (`direction` -1), or have from the one behind (1), in
/// the order of measuring; none of the row at that end. `share`: where it is positive, the share of its own way that
/// each of those stops lacks itself.
std::vector<std::optional<JointVector>> ways_of(const DataSet& data, const Trial& trial, int direction,
                                                double share = 0.0);

/// The sign of a joint's way; 0 where it did not move or there is none.
double side_of(const std::optional<JointVector>& way, int joint);

/// A share of every joint's way that joints or points are off by, all joints alike, since they were taken while the arm
/// moved. Where errors are no larger than an arm's may be it explains more than lost motion of each joint, a wrong gain
/// of each, and the way on the other side of the stop. Or the same of one joint alone, which explains what no lost
/// motion or gears of all joints do. It leaves no more than `most_m` at the median. Rows come back as the arm stood,
/// `placed` and `fit` fitted to them.
std::optional<Finding> find_taken_in_motion(const DataSet& data, double most_m, CheckedRows& rows, TrialFit& placed,
                                            TrialFit& fit);

/// Points that wander with the order of rows, of data without times: from first to last, linear or settling, or there
/// and back. `fit` has links.
std::optional<Finding> find_drift_without_times(const DataSet& data, const Trial& trial, const TrialFit& fit);

/// Of data without positions: joint angles said to be in degrees that are all as small as radians are.
std::vector<Finding> find_small_angles(const DataSet& data);

/// Validation or accept poses, one in twenty of their set and two at least, at the joints of calibration poses: what
/// was fitted judges itself there.
std::vector<Finding> find_shared_poses(const DataSet& data);
/// Those of one set.
std::optional<Finding> find_shared_poses(const DataSet& data, PoseSet set);

/// Takes rows out that repeat another to the last digit of what was measured, joints included, and names each: a repeat
/// with noise does not, unless its digits are as coarse as the noise.
std::vector<Finding> take_out_copies(DataSet& data);

/// Checks data that contacts alone tell of. The nominal arm with its tool fitted, known lengths left aside, must hold
/// poses together; where it does not, joints are read in other ways, and one that does is named. Then known lengths are
/// held against it. Then links are fitted too: where poses disagree by more than any arm errs the description is
/// contradicted, else single poses are named, of all sets.
std::vector<Finding> check_contacts(const DataSet& data);

/// The nominal arm with its tool where the calibration poses have it: known lengths and angles have no say, since it
/// would follow wrong ones. Nothing where the poses are too few.
std::optional<CorrectedRobot> stiff_arm(const DataSet& data);

/// Contacts whose touches lie far apart for what the contact is said to be, or taken for, and on a plane, sphere or
/// line instead, while other contacts agree.
std::vector<Finding> find_wrong_kinds(const DataSet& data);

/// Two points whose names are exchanged from a row on: with the names the other way round from there the calibration
/// poses of both agree far better.
std::optional<Finding> find_exchanged_contacts(const DataSet& data);

/// Known lengths that are not those of this arm's contacts by far, in another unit or by another factor, or in one set
/// alone, whose contacts are then exchanged. `robot` predicts the tool, by lengths of its own, and leaves poses of one
/// contact `apart_m` from their middle.
std::vector<Finding> find_wrong_lengths(const DataSet& data, const CorrectedRobot& robot, double apart_m);

/// Where the data set states the lengths between two contacts that it has.
std::vector<std::string_view> length_keys(const Contacts& contacts);

/// The three of these lengths that are off most, and how many more there are.
std::vector<Finding> worst_lengths(std::vector<Finding> found);

/// Contacts that moved, and poses that the contact they name does not fit, before it moved or after: those that fit
/// another one, or that alone name it, as wrong_contact, others as outlier; and planes that are not flat. `robot`
/// predicts the tool.
std::vector<Finding> find_wrong_contacts(const DataSet& data, const CorrectedRobot& robot);

/// A contact whose poses of one set stand in one place up to some row and in another from there on: a ball or socket
/// that slipped.
struct MovedContact {
  ContactGroup group;
  std::vector<std::size_t> from_there;  ///< poses of the data set
  double shift_m = 0.0;
};

/// `robot` predicts the tool. Poses `elsewhere` touched another contact than they name, and tell nothing of theirs.
std::vector<MovedContact> find_moved_contacts(const DataSet& data, const CorrectedRobot& robot,
                                              const std::set<std::size_t>& elsewhere);

Finding of_moved_contact(const DataSet& data, const MovedContact& moved);

/// Whether the nominal arm, its tool fitted (`stiff`), holds all poses of its contacts together to within the rounding
/// of the joints, or two hundred thousandths of its reach: then these joints were computed, and touched nothing.
std::optional<Finding> find_computed_contacts(const DataSet& data, const CorrectedRobot& stiff);

/// Known lengths that a model, fitted to them or not, has otherwise by more than four times what their own uncertainty,
/// its posterior, and noise and model error of its interval leave open.
std::vector<Finding> find_disagreeing_lengths(const DataSet& data, const CorrectedRobot& robot,
                                              const Posterior& posterior, const PredictionInterval& interval);

/// Whether a fitted arm, whose scale known lengths tell, has all its links longer or shorter than described by one
/// factor, by more than .2 % and than four standard deviations of what its posterior and makers' figures leave open.
std::optional<Finding> find_common_factor(const DataSet& data, const CorrectedRobot& robot, const Posterior& posterior);

/// Planes and lines stated as square or parallel that are not, by far, where `robot` predicts the tool.
std::vector<Finding> find_wrong_angles(const DataSet& data, const CorrectedRobot& robot);

/// Stated radii of spheres that the calibration poses, links and what else is known have otherwise by more than four
/// times what their own uncertainty and that of such a fit without them leave open.
std::vector<Finding> find_disagreeing_radii(const DataSet& data);

}  // namespace demecal::inline data_check
