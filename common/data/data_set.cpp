#include "data/data_set.hpp"

#include "data/stated_radius.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "decompositions/decompositions.hpp"
#include "errors/check.hpp"
#include "errors/input_error.hpp"

namespace demecal::inline data {
namespace {

std::vector<std::string> distinct_ids(std::span<const MeasuredPose> poses) {
  std::vector<std::string> ids;
  std::map<std::string, bool> seen;
  for (const MeasuredPose& pose : poses) {
    if (!std::exchange(seen[pose.pose_id], true)) ids.push_back(pose.pose_id);
  }
  return ids;
}

void shuffle(std::vector<std::string>& ids, const DrawIndex& draw) {
  for (std::size_t left = ids.size(); left > 1; --left) std::swap(ids[left - 1], ids[draw(left)]);
}

}  // namespace

std::string_view to_string(PoseSet set) {
  switch (set) {
    case PoseSet::calibration:
      return "calibration";
    case PoseSet::validation:
      return "validation";
    case PoseSet::accept:
      return "accept";
  }
  DEMECAL_CHECK(false, "set=" << static_cast<int>(set));
  return "";
}

std::string line_name(std::size_t line) {
  return "line " + std::to_string(line);
}

bool names_itself(const MeasuredPose& pose) {
  return pose.pose_id != line_name(pose.line);
}

std::string name_beside_line(const MeasuredPose& pose) {
  return names_itself(pose) ? " (" + pose.pose_id + ")" : "";
}

std::vector<std::size_t> poses_of(const DataSet& data, PoseSet set) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < data.poses.size(); ++i) {
    if (data.poses[i].set == set) indices.push_back(i);
  }
  return indices;
}

std::map<ContactGroup, std::vector<std::size_t>> contact_groups(const DataSet& data,
                                                                std::span<const std::size_t> poses) {
  std::map<ContactGroup, std::vector<std::size_t>> groups;
  for (const std::size_t pose : poses)
    if (!data.poses[pose].contact.empty()) groups[group_of(data.poses[pose])].push_back(pose);
  return groups;
}

std::map<ContactGroup, std::vector<std::size_t>> contact_groups(const DataSet& data) {
  std::vector<std::size_t> all(data.poses.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return contact_groups(data, all);
}

void take_wires_for_contacts(DataSet& data) {
  std::vector<MeasuredPose> rows;
  for (const MeasuredPose& pose : data.poses) {
    const std::size_t wires = pose.distances_m.size();
    if (wires > 0 && !pose.contact.empty())
      throw InputError(
          {data.file, pose.line}, pose.contact,
          "is touched while wires from anchors that nobody knows are measured: give each a row of its own");
    for (std::size_t i = 0; i < std::max(wires, std::size_t{1}); ++i) {
      MeasuredPose& row = rows.emplace_back(pose);
      row.distances_m.clear();
      if (wires == 0) continue;
      row.contact = "anchor " + std::to_string(i + 1);
      row.contact_kind = ContactKind::sphere;
      row.contact_length_m = pose.distances_m[i];
      if (data.contacts.forms.try_emplace(row.contact, ContactForm{ContactKind::sphere, {}}).second)
        data.contacts.distances.push_back({row.contact, {}, 0.0, kWireZeroDeviation_m});
      if (wires > 1) row.pose_id += " wire " + std::to_string(i + 1);
      if (i > 0) row.position_m.reset(), row.orientation.reset();
    }
  }
  data.poses = std::move(rows);
}

void weigh_by_stated_uncertainty(DataSet& data) {
  std::vector<double> sigmas_m;
  for (const MeasuredPose& pose : data.poses)
    if (pose.position_covariance_m2) sigmas_m.push_back(std::sqrt(pose.position_covariance_m2->trace() / 3.0));
  if (sigmas_m.empty()) return;
  const auto middle = sigmas_m.begin() + static_cast<std::ptrdiff_t>(sigmas_m.size() / 2);
  std::ranges::nth_element(sigmas_m, middle);
  data.usual_sigma_m = *middle;
  for (MeasuredPose& pose : data.poses) {
    if (!pose.position_covariance_m2) continue;
    const auto own = eigen_system_of_three(*pose.position_covariance_m2);
    pose.position_whitening = data.usual_sigma_m * (own.vectors * own.values.cwiseInverse().cwiseSqrt().asDiagonal() *
                                                    own.vectors.transpose());
  }
}

void weigh_by_flatness(DataSet& data) {
  constexpr double kUsualTouch_m = 5e-5;
  const double touch_m = data.robot.repeatability_m.value_or(kUsualTouch_m);
  for (auto* poses : {&data.poses, &data.excluded}) {
    for (MeasuredPose& pose : *poses) {
      // Anywhere between two planes: a flatness of 1 has a standard deviation of the twelfth's root.
      const double bumps_m = data.contacts.form_of(pose.contact).flatness_m / std::sqrt(12.0);
      pose.contact_weight = touch_m / std::hypot(touch_m, bumps_m);
    }
  }
}

bool has_contacts(const DataSet& data) {
  return std::ranges::any_of(data.poses, [](const MeasuredPose& pose) { return !pose.contact.empty(); });
}

bool has_instrument(const DataSet& data) {
  return std::ranges::any_of(data.poses, [](const MeasuredPose& pose) {
    return pose.position_m || pose.orientation || !pose.distances_m.empty();
  });
}

Eigen::Vector3d nominal_tool(const DataSet& data, const MeasuredPose& pose) {
  if (pose.target.empty()) return data.robot.chain.tool_m;
  const auto tool = data.tools_m.find(pose.target);
  DEMECAL_CHECK(tool != data.tools_m.end(), "target=" << pose.target);
  return tool->second;
}

void split_by_pose(std::span<MeasuredPose> poses, const SplitFractions& fractions, const DrawIndex& draw) {
  std::vector<std::string> ids = distinct_ids(poses);
  if (ids.empty()) return;
  shuffle(ids, draw);
  const auto share = [&](double fraction, std::size_t most) {
    return std::min(static_cast<std::size_t>(std::lround(fraction * static_cast<double>(ids.size()))), most);
  };
  const std::size_t validation = share(fractions.validation, ids.size() - 1);
  const std::size_t accept = share(fractions.accept, ids.size() - 1 - validation);
  std::map<std::string, PoseSet> set_of;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    set_of[ids[i]] = i < validation            ? PoseSet::validation
                     : i < validation + accept ? PoseSet::accept
                                               : PoseSet::calibration;
  }
  for (MeasuredPose& pose : poses) pose.set = set_of[pose.pose_id];
}

}  // namespace demecal::inline data
