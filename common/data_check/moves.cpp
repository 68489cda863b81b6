#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "data_check/searches.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "trials/explanations.hpp"
#include "trials/projected_columns.hpp"
#include "trials/trial_fit.hpp"

namespace demecal::inline data_check {
namespace {

std::string clause_of(const Chain& chain, const InstrumentMove& move) {
  if (move.joint >= 0)
    return fmt::format("a change of the zero of joint {} by {}", move.joint + 1, zero_text(chain, move.joint, move.by));
  if (!move.other_tools.empty())
    return fmt::format("a tool that stands {} elsewhere on the flange", distance_text(move.shift_m));
  return fmt::format("an instrument that moved by {}", distance_text(move.shift_m));
}

/// " These poses do not tell it from an instrument that moved by 0.21 mm."; empty where they do.
std::string rivals_text(const Chain& chain, const InstrumentMove& move) {
  std::string text;
  for (const InstrumentMove& rival : move.rivals)
    text += (text.empty() ? " These poses do not tell it from " : " or ") + clause_of(chain, rival);
  return text.empty() ? text : text + ".";
}

/// What besides the zero turns points about the axis of the first joint, or of the last.
std::string same_turn(const Chain& chain, int joint) {
  if (joint == 0) return ", or the instrument turned about the axis of joint 1";
  if (joint + 1 != chain.size()) return "";
  return fmt::format(", or the tool {} the axis of joint {}",
                     is_revolute(chain, joint) ? "turned about" : "moved along", joint + 1);
}

/// Gives every row the place of the instrument, the zero and the tool that the trial's moves say.
class MovesTakenOut {
 public:
  MovesTakenOut(const DataSet& data, CheckedRows& rows, TrialFit& fit) : data_(data), rows_(rows), fit_(fit) {}

  /// The rows that are not of the trial get the station of their neighbours.
  std::vector<Finding> run() {
    const Trial given = rows_.trial;
    const TrialFit given_fit = fit_;
    const std::vector<InstrumentMove> moves = find_moves(rows_.trial, fit_);
    for (const InstrumentMove& move : moves)
      if (move.joint >= 0) note_zero(move, goes_with_ways(given, given_fit, move));
    assign_stations();
    assign_tools();
    for (const InstrumentMove& move : moves) {
      if (!move.other_tools.empty()) note_tool(move);
      if (move.joint < 0 && move.other_tools.empty()) note_move(move);
    }
    return std::move(found_);
  }

 private:
  const std::string& id_of(const TrialRow& row) const { return data_.poses[row.pose].pose_id; }

  /// Of each pose the sides from which joints came by the way from the stop before: a joint that rested keeps its side,
  /// and before it first moves it has that of its first way.
  std::vector<JointVector> sides_by_ways() const {
    constexpr double kLeastWay = 1e-4;  // rad or m: less may turn no gear
    const auto ways = ways_of(data_, rows_.whole, -1);
    std::vector<JointVector> sides(data_.poses.size(), JointVector::Zero(rows_.whole.chain.size()));
    for (int joint = 0; joint < rows_.whole.chain.size(); ++joint) {
      const auto moves = [&](const auto& way) { return way && std::abs((*way)[joint]) > kLeastWay; };
      const auto first = std::ranges::find_if(ways, moves);
      double side = first == ways.end() ? 0.0 : side_of(*first, joint);
      for (std::size_t row = 0; row < ways.size(); ++row) {
        if (moves(ways[row])) side = side_of(ways[row], joint);
        sides[rows_.whole.rows[row].pose][joint] = side;
      }
    }
    return sides;
  }

  /// Whether lost motion, by the way that each joint came, does what the other zero does, where no file states sides.
  bool goes_with_ways(const Trial& given, const TrialFit& given_fit, const InstrumentMove& move) const {
    constexpr double kLeastBeyond = 25.0;  // nats for each row of a pose
    constexpr double kShareBeyond = 0.05;  // of what the other zero gains
    if (std::ranges::any_of(data_.poses, [](const MeasuredPose& pose) { return pose.approach.has_value(); }))
      return false;
    const std::vector<JointVector> sides = sides_by_ways();
    const auto side = [&](std::size_t row, int joint) { return sides[given.rows[row].pose][joint]; };
    Eigen::MatrixXd jump = joint_column(given, given_fit, move.joint);
    jump.topRows(3 * static_cast<Eigen::Index>(move.first_row)).setZero();
    const ProjectedColumns projected(given, given_fit);
    const double beyond = projected.gain_beyond(jump, joint_columns(given, given_fit, side));
    const double sharper = given_fit.deviation_m / fit_.deviation_m;
    return beyond < kShareBeyond * projected.gain(jump) ||
           sharper * sharper * beyond < kLeastBeyond * fit_.rows_per_pose;
  }

  void note_move(const InstrumentMove& move) {
    const std::size_t row = first_row_of(rows_.trial.rows[move.first_row].station);
    const MeasuredPose& pose = data_.poses[rows_.whole.rows[row].pose];
    Finding finding{.kind = FindingKind::instrument_moved,
                    .as_given_mm = millimetres(move.as_given_m),
                    .if_changed_mm = millimetres(move.if_changed_m)};
    for (std::size_t i = row; i < rows_.whole.rows.size(); ++i) finding.poses.push_back(id_of(rows_.whole.rows[i]));
    finding.sentence = fmt::format(
        "The instrument (or the robot's base) moved before line {}{}: from there on points lie {} elsewhere {}. "
        "Treat the poses before and after as two data sets, or measure again.{}",
        pose.line, name_beside_line(pose), distance_text(move.shift_m),
        before_and_after(move.as_given_m, move.if_changed_m), rivals_text(rows_.whole.chain, move));
    found_.push_back(std::move(finding));
  }

  /// Names the rows that have the other tools.
  void note_tool(const InstrumentMove& move) {
    Finding finding{.kind = FindingKind::wrong_tool,
                    .as_given_mm = millimetres(move.as_given_m),
                    .if_changed_mm = millimetres(move.if_changed_m)};
    const auto has_it = [&](const TrialRow& row) {
      return std::ranges::any_of(move.other_tools, [&](const OtherTool& other) { return row.target == other.behind; });
    };
    const auto first = std::ranges::find_if(rows_.whole.rows, has_it);
    if (first == rows_.whole.rows.end()) return;
    for (auto row = first; row != rows_.whole.rows.end(); ++row)
      if (has_it(*row)) finding.poses.push_back(id_of(*row));
    const MeasuredPose& there = data_.poses[first->pose];
    const bool one_of_several = move.other_tools.size() == 1 && !there.target.empty();
    finding.sentence = fmt::format(
        "The tool{} changed before line {}{}, as after a collision, with a bent or loosened mount, or as another tool: "
        "from there on it stands {} elsewhere on the flange {}. Give the poses from there on a target of their own "
        "(column `target`, `tools_mm`), or measure again.{}",
        one_of_several ? " point of target " + there.target : "", there.line, name_beside_line(there),
        distance_text(move.shift_m), before_and_after(move.as_given_m, move.if_changed_m),
        rivals_text(rows_.whole.chain, move));
    found_.push_back(std::move(finding));
  }

  /// Of the rows between two of the trial those are behind the change that fit better so.
  void note_zero(const InstrumentMove& move, bool goes_with_ways) {
    const std::size_t pose = rows_.trial.rows[move.first_row].pose, before = rows_.trial.rows[move.first_row - 1].pose;
    auto first = std::ranges::find(rows_.whole.rows, pose, &TrialRow::pose);
    while (first != rows_.whole.rows.begin() && std::prev(first)->pose != before) {
      TrialRow other = *std::prev(first);
      other.joints[move.joint] += move.by;
      if (error(other) >= error(*std::prev(first))) break;
      --first;
    }
    Finding finding{.kind = FindingKind::joint_zero_changed,
                    .joint = move.joint,
                    .as_given_mm = millimetres(move.as_given_m),
                    .if_changed_mm = millimetres(move.if_changed_m)};
    const MeasuredPose& there = data_.poses[first->pose];
    for (auto row = first; row != rows_.whole.rows.end(); ++row) {
      row->joints[move.joint] += move.by;
      finding.poses.push_back(id_of(*row));
    }
    const Chain& chain = rows_.whole.chain;
    finding.sentence = fmt::format(
        "The zero of joint {} changed before line {}{}, by {}, as after a collision or a new mastering{}: from there "
        "on points lie {} elsewhere {}. Treat the poses before and after as two data sets, or measure again.{}{}",
        move.joint + 1, there.line, name_beside_line(there), zero_text(chain, move.joint, move.by),
        same_turn(chain, move.joint), distance_text(move.shift_m), before_and_after(move.as_given_m, move.if_changed_m),
        rivals_text(chain, move),
        goes_with_ways ? " Joints turn back near there, and lost motion of theirs explains it as well: state the side "
                         "of approach of every pose (columns `approach`), or measure poses from both sides in turn."
                       : "");
    found_.push_back(std::move(finding));
  }

  /// Rows between two of the trial belong to the station of which their errors say so, in one change.
  void assign_stations() {
    if (rows_.trial.stations == 1) return;
    std::size_t next = 0;
    for (TrialRow& row : rows_.whole.rows) {
      while (next + 1 < rows_.trial.rows.size() && rows_.trial.rows[next].pose < row.pose) ++next;
      row.station = rows_.trial.rows[next].station;
    }
    for (int station = 1; station < rows_.trial.stations; ++station) {
      // Rows just before the change in the trial may belong to either side.
      const auto first = std::ranges::find(rows_.whole.rows, station, &TrialRow::station);
      for (auto row = first; row != rows_.whole.rows.begin() && row != rows_.whole.rows.end();) {
        TrialRow other = *row;
        other.station = station - 1;
        if (error(*row) <= error(other) || row->pose == trial_first_pose(station)) break;
        row->station = station - 1;
        ++row;
      }
    }
  }

  std::size_t trial_first_pose(int station) const {
    return std::ranges::find(rows_.trial.rows, station, &TrialRow::station)->pose;
  }
  std::size_t first_row_of(int station) const {
    return static_cast<std::size_t>(std::ranges::find(rows_.whole.rows, station, &TrialRow::station) -
                                    rows_.whole.rows.begin());
  }
  /// As the nearest row of the trial before it that had the same tool at first, or as the next one if that fits better.
  void assign_tools() {
    if (rows_.trial.tools_m.size() == rows_.whole.tools_m.size()) return;
    rows_.whole.tools_m = rows_.trial.tools_m;
    for (TrialRow& row : rows_.whole.rows) {
      const std::string& target = data_.poses[row.pose].target;
      const TrialRow *before = nullptr, *behind = nullptr;
      for (const TrialRow& other : rows_.trial.rows) {
        if (data_.poses[other.pose].target != target) continue;
        if (other.pose <= row.pose) before = &other;
        if (other.pose >= row.pose && behind == nullptr) behind = &other;
      }
      if (before == nullptr) before = behind;
      if (before == nullptr) continue;
      row.target = before->target;
      TrialRow other = row;
      if (behind != nullptr) other.target = behind->target;
      if (error(other) < error(row)) row.target = other.target;
    }
  }

  double error(const TrialRow& row) const { return (row.point_m - predicted_point(fit_, row)).norm(); }

  const DataSet& data_;
  CheckedRows& rows_;
  TrialFit& fit_;
  std::vector<Finding> found_;
};

}  // namespace

std::string zero_text(const Chain& chain, int joint, double by) {
  return is_revolute(chain, joint) ? fmt::format("{:.3f} deg", degrees(std::abs(by))) : distance_text(std::abs(by));
}

std::vector<Finding> take_out_moves(const DataSet& data, CheckedRows& rows, TrialFit& fit) {
  return MovesTakenOut(data, rows, fit).run();
}

}  // namespace demecal::inline data_check
