#include "planning/stops.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "kinematics/chain.hpp"
#include "planning/travel.hpp"
#include "planning/way.hpp"

namespace demecal::inline planning {
namespace {

/// Of short travel; where sockets are touched, one after another.
std::vector<PlannedStop> in_order(const Chain& chain, const std::vector<PlannedStop>& stops) {
  std::map<std::size_t, std::vector<std::size_t>> by_socket;
  for (std::size_t i = 0; i < stops.size(); ++i) by_socket[stops[i].pose.socket.value_or(0)].push_back(i);
  std::vector<PlannedStop> ordered;
  for (const auto& [socket, members] : by_socket) {
    std::vector<PlannedPose> poses;
    for (const std::size_t i : members) poses.push_back(stops[i].pose);
    for (const std::size_t i : short_order(chain, poses)) ordered.push_back(stops[members[i]]);
  }
  return ordered;
}

std::vector<PlannedPose> planned_poses(const std::vector<PlannedStop>& stops) {
  std::vector<PlannedPose> poses;
  for (const PlannedStop& stop : stops) poses.push_back(stop.pose);
  return poses;
}

/// The stops as the way comes to them, those that it does not reach last.
std::vector<PlannedStop> along(MeasuringWay& way, const std::vector<PlannedStop>& stops) {
  std::vector<PlannedStop> ordered;
  for (WayStop& stop : way.stops) {
    if (stop.pose < 0) continue;
    ordered.push_back(stops[static_cast<std::size_t>(stop.pose)]);
    stop.pose = static_cast<int>(ordered.size()) - 1;
  }
  for (std::size_t& pose : way.blocked) {
    ordered.push_back(stops[pose]);
    pose = ordered.size() - 1;
  }
  return ordered;
}

/// Poses of a set that were measured, repeats counted once.
int measured_before(const std::optional<DataSet>& measured, PoseSet set) {
  std::set<std::string> ids;
  if (measured)
    for (const MeasuredPose& pose : measured->poses)
      if (pose.set == set) ids.insert(pose.pose_id);
  return static_cast<int>(ids.size());
}

/// The highest number that the ids of measured poses end in; 0 without any.
std::size_t highest_number(const std::optional<DataSet>& measured) {
  constexpr std::size_t kMostDigits = 9;
  std::size_t highest = 0;
  if (!measured) return highest;
  for (const MeasuredPose& pose : measured->poses) {
    const std::size_t begin = pose.pose_id.find_last_not_of("0123456789") + 1;  // 0 where it is all digits
    const std::string digits = pose.pose_id.substr(begin);
    if (!digits.empty() && digits.size() <= kMostDigits) highest = std::max<std::size_t>(highest, std::stoul(digits));
  }
  return highest;
}

}  // namespace

int judging(const PlanRequest& request, PoseSet set, int calibration) {
  constexpr int kFewest = 10;
  constexpr double kOfCalibration = 0.3;
  const std::optional<int>& asked = set == PoseSet::validation ? request.validation : request.accept;
  if (asked) return *asked;
  const int all = calibration + measured_before(request.measured, PoseSet::calibration);
  const int usual = std::max(kFewest, static_cast<int>(std::lround(kOfCalibration * all)));
  return std::max(0, usual - measured_before(request.measured, set));
}

std::vector<PlannedPose> poses_but(std::vector<PlannedPose> poses, const std::vector<PlannedStop>& stops,
                                   const std::vector<std::size_t>& but) {
  std::erase_if(poses, [&](const PlannedPose& pose) {
    return std::ranges::any_of(but, [&](std::size_t i) { return stops[i].pose.joints == pose.joints; });
  });
  return poses;
}

void add_stops(std::span<const PlannedPose> from, std::size_t count, PoseSet set, std::vector<PlannedStop>& stops) {
  for (const PlannedPose& pose : from.first(std::min(count, from.size()))) stops.push_back({{}, set, pose});
}

std::size_t at_sockets(const std::optional<int>& asked, std::size_t usual, std::size_t sockets) {
  constexpr std::size_t kFewestEach = 4;
  return asked ? usual : std::max(usual, kFewestEach * sockets);
}

std::string poses_by_hand(const Plan& plan) {
  std::string ids;
  for (const std::size_t i : plan.way.blocked) ids += (ids.empty() ? "" : ", ") + plan.stops[i].id;
  return ids;
}

void order_stops(const FeasibleSpace& space, const std::optional<DataSet>& measured, std::vector<PlannedStop> stops,
                 RandomStream random, Plan& plan) {
  const Chain& chain = space.robot().chain;
  stops = in_order(chain, stops);
  if (plan.sockets.empty()) {
    plan.way = way_along(space, planned_poses(stops), random);
    stops = along(plan.way, stops);
  }
  std::size_t number = highest_number(measured);
  for (PlannedStop& stop : stops) {
    stop.id = "P" + std::to_string(++number);
    ++plan.counts[static_cast<std::size_t>(stop.set)];
    plan.stops.push_back(std::move(stop));
  }
  for (std::size_t i = 1; i < plan.way.stops.size(); ++i)
    plan.travel_rad += travel(chain, plan.way.stops[i - 1].joints, plan.way.stops[i].joints);
}

}  // namespace demecal::inline planning
