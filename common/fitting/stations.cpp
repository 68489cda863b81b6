#include "fitting/stations.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "errors/input_error.hpp"
#include "fitting/fit.hpp"
#include "kinematics/chain.hpp"
#include "parameters/declared_model.hpp"

namespace demecal::inline fitting {
namespace {

void require_joinable(const DataSet& set, const DataSet& first) {
  const std::string difference = first_difference(first.robot.chain, set.robot.chain);
  if (!difference.empty())
    throw InputError({set.file, 0}, set.robot.name,
                     "is not the arm of " + first.name + ": " + difference + "; stations measure one robot");
  const auto other = [](const MeasuredPose& pose) {
    return !pose.distances_m.empty() || !pose.contact.empty() || !(pose.position_m || pose.orientation);
  };
  if (const auto found = std::ranges::find_if(set.poses, other); found != set.poses.end())
    throw InputError({set.file, found->line}, found->pose_id,
                     "was not measured as a point: stations are joined by points, so give a data set of distances or "
                     "contacts a job of its own");
}

/// The robot where base and tool alone have it.
CorrectedRobot placed_robot(const DataSet& set) {
  const Fit fit = fit_registration(set, poses_of(set, PoseSet::calibration), {.registration = true, .tool = true},
                                   nominal_robot(set));
  if (fit.status != FitStatus::converged)
    throw InputError({set.file, 0}, set.name, "cannot be placed beside the other stations: " + fit.sentence);
  return fit.robot;
}

/// A name that no station has yet.
std::string station_name(const DataSet& set, const std::set<std::string>& taken) {
  const std::string name = set.name.empty() ? "station" : set.name;
  if (!taken.contains(name)) return name;
  int number = 2;
  while (taken.contains(name + ' ' + std::to_string(number))) ++number;
  return name + ' ' + std::to_string(number);
}

/// Names, targets and frame of a further station's pose in the joined set.
void bring(MeasuredPose& pose, const Station& station, StationTools tools) {
  pose.station = station.name;
  pose.pose_id = station.name + '/' + pose.pose_id;
  if (tools == StationTools::own) pose.target = target_at_station(station.name, pose.target);
  if (pose.position_m) pose.position_m = station.first_from_own * *pose.position_m;
  if (pose.position_covariance_m2) {
    const Eigen::Matrix3d turn = station.first_from_own.linear();
    pose.position_covariance_m2 = (turn * *pose.position_covariance_m2 * turn.transpose()).eval();
  }
  if (pose.orientation) pose.orientation = Eigen::Quaterniond(station.first_from_own.linear()) * *pose.orientation;
}

void bring_tools(const DataSet& set, const Station& station, StationTools tools, DataSet& joined) {
  std::map<std::string, Eigen::Vector3d> points_m = set.tools_m;
  for (const MeasuredPose& pose : set.poses) points_m.try_emplace(pose.target, nominal_tool(set, pose));
  for (const auto& [target, point_m] : points_m) {
    if (tools == StationTools::own) {
      joined.tools_m[target_at_station(station.name, target)] = point_m;
      continue;
    }
    constexpr double kSame_m = 1e-6;
    const auto known = joined.tools_m.find(target);
    const Eigen::Vector3d there = known != joined.tools_m.end() ? known->second : joined.robot.chain.tool_m;
    if ((known == joined.tools_m.end() && !target.empty()) || (there - point_m).norm() > kSame_m)
      throw InputError({set.file, 0}, target.empty() ? "tool_mm" : target,
                       "is another tool point than at the first station: stations that share a tool describe it alike; "
                       "leave `station_tools: shared` out where it was changed in between");
  }
}

/// Stations' clocks are their own: times say in which order poses were taken only where no two stations' overlap.
void settle_times(std::vector<MeasuredPose>& poses) {
  std::map<std::string, std::pair<double, double>> spans;
  for (const MeasuredPose& pose : poses) {
    if (!pose.time_s) continue;
    auto& [from, to] = spans.try_emplace(pose.station, *pose.time_s, *pose.time_s).first->second;
    from = std::min(from, *pose.time_s);
    to = std::max(to, *pose.time_s);
  }
  std::vector<std::pair<double, double>> ordered;
  for (const auto& [station, span] : spans) ordered.push_back(span);
  std::ranges::sort(ordered);
  for (std::size_t i = 1; i < ordered.size(); ++i) {
    if (ordered[i].first > ordered[i - 1].second) continue;
    for (MeasuredPose& pose : poses) pose.time_s.reset();
    return;
  }
}

}  // namespace

std::string target_at_station(const std::string& station, const std::string& target) {
  if (station.empty()) return target;
  return target.empty() ? station : target + " of " + station;
}

DataSet joined_stations(std::vector<DataSet> sets, StationTools tools) {
  DataSet joined = std::move(sets.front());
  if (sets.size() == 1) return joined;
  require_joinable(joined, joined);
  const CorrectedRobot first = placed_robot(joined);
  joined.stations = {{station_name(joined, {}), joined.sha256, Eigen::Isometry3d::Identity()}};
  std::set<std::string> taken{joined.stations.front().name};
  for (std::size_t i = 1; i < sets.size(); ++i) {
    DataSet& set = sets[i];
    require_joinable(set, joined);
    const CorrectedRobot own = placed_robot(set);
    const Station station{station_name(set, taken), set.sha256,
                          first.sensor_from_base * own.sensor_from_base.inverse()};
    taken.insert(station.name);
    bring_tools(set, station, tools, joined);
    for (std::vector<MeasuredPose>* poses : {&set.poses, &set.excluded})
      for (MeasuredPose& pose : *poses) bring(pose, station, tools);
    std::ranges::move(set.poses, std::back_inserter(joined.poses));
    std::ranges::move(set.excluded, std::back_inserter(joined.excluded));
    if (set.frame == Frame::sensor) joined.frame = Frame::sensor;
    joined.name += " + " + set.name;
    joined.file += ", " + set.file;
    joined.sha256 += set.sha256;
    joined.stations.push_back(station);
  }
  settle_times(joined.poses);
  weigh_by_stated_uncertainty(joined);
  return joined;
}

std::vector<Station> stations_as_found(const CorrectedRobot& robot, const DataSet& data) {
  std::vector<Station> found = data.stations;
  for (Station& station : found) {
    const auto moved = robot.stations.find(station.name);
    if (moved != robot.stations.end()) station.first_from_own = moved->second * station.first_from_own;
  }
  return found;
}

CorrectedRobot with_tools_of_stations(CorrectedRobot robot, const DataSet& data) {
  const CorrectedRobot nominal = nominal_robot(data);
  for (const MeasuredPose& pose : data.poses)
    if (!pose.station.empty()) robot.tools.try_emplace(pose.target, nominal.tool(pose.target));
  return robot;
}

namespace {

/// The one of `known` that measured the data, or their first station's.
std::vector<Station>::const_iterator first_station_of(const std::vector<Station>& known, const DataSet& data) {
  const std::string& sha256 = data.stations.empty() ? data.sha256 : data.stations.front().sha256;
  return std::ranges::find(known, sha256, &Station::sha256);
}

/// By the data's targets, what the model calls them, where it knows the station under another name.
std::map<std::string, std::string> targets_at_first(const CorrectedRobot& robot, const std::vector<Station>& known,
                                                    const DataSet& data) {
  std::map<std::string, std::string> names;
  const auto first = first_station_of(known, data);
  if (first == known.end() || first == known.begin()) return names;
  for (const MeasuredPose& pose : data.poses) {
    const std::string there = target_at_station(first->name, pose.target);
    if (pose.station.empty() && robot.tools.contains(there)) names.emplace(pose.target, there);
  }
  return names;
}

}  // namespace

CorrectedRobot seen_from_stations(CorrectedRobot robot, const std::vector<Station>& known, const DataSet& data) {
  robot.stations.clear();
  if (known.empty() && data.stations.empty()) return robot;
  const auto first = first_station_of(known, data);
  Eigen::Isometry3d own_from_first = Eigen::Isometry3d::Identity();  // of the data's first station, from the model's
  if (first != known.end()) {
    own_from_first = first->first_from_own.inverse();
    const std::map<std::string, Eigen::Isometry3d> tools = robot.tools;
    for (const auto& [target, there] : targets_at_first(robot, known, data)) robot.tools[target] = tools.at(there);
  }
  robot.sensor_from_base = own_from_first * robot.sensor_from_base;
  for (std::size_t i = 1; i < data.stations.size(); ++i) {
    const Station& station = data.stations[i];
    const auto found = std::ranges::find(known, station.sha256, &Station::sha256);
    if (found == known.end())
      throw InputError({data.file, 0}, station.name,
                       "is a station that the model does not know: give --refit-base, or evaluate its data set alone");
    robot.stations[station.name] = own_from_first * found->first_from_own * station.first_from_own.inverse();
  }
  return robot;
}

Posterior posterior_seen(const Posterior& posterior, const CorrectedRobot& robot, const CorrectedRobot& seen,
                         const std::vector<Station>& known, const DataSet& data) {
  const std::map<std::string, std::string> names = targets_at_first(robot, known, data);
  Posterior there = posterior.without([&](const ParameterId& id) {
    return id.is_of_tool() && names.contains(id.target) && names.at(id.target) != id.target;
  });
  for (const auto& [target, name] : names)
    for (ParameterId& id : there.ids)
      if (id.is_of_tool() && id.target == name) id.target = target;
  return with_turned_base(std::move(there),
                          seen.sensor_from_base.linear() * robot.sensor_from_base.linear().transpose());
}

}  // namespace demecal::inline fitting
