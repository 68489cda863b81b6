// What may be wrong with a data set as a whole: how the arm or its poses are read, the axes of positions, the order of
// rows, or an instrument that moved.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "trials/finding.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline trials {

/// One way to read the data otherwise than they are given.
struct Explanation {
  FindingKind kind = FindingKind::joint_sign;
  int joint = -1;      ///< from 0; -1: of no joint
  std::string clause;  ///< what fits: "joint 3 is taken with the other sign"
  std::function<void(Trial&)> apply;
};

/// Signs and offsets of 90 and 180 degrees of every joint, both together, pairs of joints exchanged, units of angles
/// and lengths, the other Denavit-Hartenberg convention, mirrored positions, and joints reported as sums with the one
/// before: the likelier of those that can mean the same come first.
std::vector<Explanation> whole_set_explanations(const Chain& chain);

/// Positions in another unit of length than is stated, or than the robot's lengths are in.
std::vector<Explanation> position_unit_explanations();

/// The same of x, y or z alone.
std::vector<Explanation> column_unit_explanations();

/// An explanation (or several together) and how well the arm fits with it.
struct BestExplanation {
  std::vector<Explanation> explanations;
  TrialFit fit;
  std::vector<Explanation> equals{};  ///< others, each by itself, that fit as well: the points cannot tell
};

/// The explanation, units of single columns included, by which the trial fits best; of equals the first. Of those that
/// leave more than `good_m` at the median, pairs of joint explanations, sets of signs and, one after the other, up to
/// four are tried too. `placed`: the trial's own fit of base and tools. Sets of signs are held against mirrored
/// positions, which are none of points in a `right_handed` frame. Nothing where none lowers its median.
std::optional<BestExplanation> best_explanation(const Trial& trial, const TrialFit& placed, double good_m,
                                                bool right_handed = false);

/// How a mirrored or exchanged pair of axes reads, by where the base then stands: `sensor_from_base` is that of a fit
/// to points whose y is negated. In a frame that is the base's own, `is_base`, the axes can be named.
Explanation axes_explanation(const Eigen::Isometry3d& sensor_from_base, bool is_base);

/// Whether the map from a base to positions said to be in it is no identity: exchanged axes, a turned first joint, or
/// another frame. Nothing where it is.
std::optional<Explanation> base_frame_explanation(const Eigen::Isometry3d& sensor_from_base);

/// Rows that fit the arm otherwise than in the order given.
struct RowReordering {
  std::string clause;  ///< what fits: "each measured point is taken from the row before"
  double median_m = 0.0;
  std::vector<std::size_t> poses{};  ///< those it concerns; empty: all
};

/// "each measured point is taken from 2 rows further down"
std::string shift_clause(int shift);

/// The shift of measured points against joints, by up to 30 rows either way, at which an arm fits best; `whole` has all
/// rows in the file's order. Where only the rows behind or before a certain one are shifted it says so.
std::optional<RowReordering> best_shift(const Trial& whole);

/// The shift, by up to 3 rows, of only the rows behind a certain one, or only of those before it.
std::optional<RowReordering> shift_of_rest(const Trial& whole);

/// Whether the measured points are those of the arm in another order: the two clouds of points, brought together from
/// many turns by nearest neighbours (iterative closest point, Besl and McKay 1992), lie within `near_m` of each other
/// and closer by far than points of a cloud do.
std::optional<RowReordering> find_shuffled_rows(const Trial& whole, double near_m);

/// One tool in the place of another, by their numbers.
struct OtherTool {
  int before = 0, behind = 0;
};

/// A move of the instrument (or of the base) between two rows, of a joint's zero, or of a tool.
struct InstrumentMove {
  std::size_t first_row = 0;  ///< of the trial, from which it stood elsewhere
  double shift_m = 0.0;       ///< how far measured points jump, root mean square over the rows behind
  double as_given_m = 0.0;    ///< median error of the rows on the shorter side with one place of the instrument
  double if_changed_m = 0.0;  ///< with two
  int joint = -1;             ///< from 0, of which the zero changed; -1: the instrument moved
  double by = 0.0;            ///< what must be added to that joint from the row on, rad or m
  std::vector<OtherTool> other_tools{};  ///< from the row on
  int numbers = 6;                       ///< that describe the move
  /// Others that explain the rows as well, to within what the points tell; theirs is empty.
  std::vector<InstrumentMove> rivals{};
};

/// A joint's zero, or a tool, that changed between two rows.
struct Jump {
  InstrumentMove move;
  Trial trial;  ///< with joints, or tools, as they were if so
  TrialFit fit;
};

/// The row and joint where another zero from there on explains the rows far better than one zero does, better than
/// drift of all joints, linear or settling, from the first row on, and beyond what goes with sides of approach, payload
/// and temperature.
std::optional<Jump> find_zero_jump(const Trial& trial, const TrialFit& fit);

/// The same of a tool, or of all of them at once, that stands elsewhere on the flange from a row on: bent, or another.
/// Drift of instrument, joints and that tool must explain it worse.
std::optional<Jump> find_tool_jump(const Trial& trial, const TrialFit& fit);

/// A joint whose zero is another at some stations of the instrument than at the others.
struct StationZero {
  int joint = -1;               ///< from 0
  double by = 0.0;              ///< what must be added to the joint at those stations, rad or m
  std::vector<int> stations{};  ///< one, or one and all behind it
  double as_given_m = 0.0;      ///< the larger median error, of those stations' rows and of the others, with one zero
  double if_changed_m = 0.0;    ///< the same with two
};

/// The zero that differs most, where two explain the rows far better than one does, and beyond what goes with sides of
/// approach, payload and temperature. Stations have bases of their own, so that of joint 1 cannot be told, and with
/// tools of their own that of the last joint neither.
std::optional<StationZero> find_station_zero(const Trial& trial, const TrialFit& fit);

/// Splits the rows, in the order of measuring, where two places of the instrument explain them far better than one, and
/// beyond drift, linear, settling or there and back, and what goes with sides of approach, payload and temperature, or
/// two zeros of a joint, or two tools, do in fewer nats, with what comes near them as rivals, and looks again; `trial`
/// comes back with a station for every place, joints of one zero, and a tool for every one that there was, `fit` fitted
/// to it.
std::vector<InstrumentMove> find_moves(Trial& trial, TrialFit& fit);

/// How a set of poses differs from the others by its frame or by its tool.
struct OtherSet {
  bool by_tool = false;       ///< another tool point explains it as well as another frame
  double shift_m = 0.0;       ///< how far the points, or the tool point, are off
  double as_given_m = 0.0;    ///< median error of the set
  double if_changed_m = 0.0;  ///< the same in its own frame, or with its own tool
};

/// Whether `rows`, of one set, fit `fit` only in another frame or with another tool. A set that does is brought into
/// the fit's frame (or its predicted points are): its rows come back with their points moved.
std::optional<OtherSet> find_other_set(const TrialFit& fit, std::vector<TrialRow>& rows);

/// Whether measured points fit predicted ones only after a rigid motion, as after the instrument was set up anew.
std::optional<OtherSet> find_other_frame(const std::vector<Eigen::Vector3d>& predicted,
                                         const std::vector<Eigen::Vector3d>& measured);

}  // namespace demecal::inline trials
