#include "data/data_set.hpp"

#include "data/stated_radius.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "decompositions/decompositions.hpp"
#include "errors/check.hpp"
#include "errors/input_error.hpp"

namespace demecal::inline data {
namespace {

void shuffle(std::vector<std::string>& ids, const DrawIndex& draw) {
  for (std::size_t left = ids.size(); left > 1; --left) std::swap(ids[left - 1], ids[draw(left)]);
}

struct SetSizes {
  std::size_t validation = 0, accept = 0;
};

/// Of so many poses in all; calibration keeps one at least.
SetSizes sizes_of(std::size_t count, const SplitFractions& fractions) {
  const auto share = [&](double fraction, std::size_t most) {
    return std::min(static_cast<std::size_t>(std::lround(fraction * static_cast<double>(count))), most);
  };
  const std::size_t validation = share(fractions.validation, count - 1);
  return {validation, share(fractions.accept, count - 1 - validation)};
}

/// Of the poses of one contact after another. One touch alone of a set tells nothing of the arm, so every set gets none
/// or two at least; what a contact's rounding leaves is made up for at the next.
class SharesOfContacts {
 public:
  explicit SharesOfContacts(const SplitFractions& fractions) : fractions_(fractions) {}

  SetSizes next(std::size_t count) {
    const std::size_t validation = part(count, count, fractions_.validation, owed_validation_);
    return {validation, part(count, count - validation, fractions_.accept, owed_accept_)};
  }

 private:
  static constexpr std::size_t kFewest = 2;

  /// Of the `left` of `count` poses; too few to be divided go to one set together.
  static std::size_t part(std::size_t count, std::size_t left, double fraction, double& owed) {
    owed += fraction * static_cast<double>(count);
    std::size_t taken = 0;
    if (left >= 2 * kFewest) {
      taken = std::min(static_cast<std::size_t>(std::lround(std::max(owed, 0.0))), left - kFewest);
      if (taken < kFewest) taken = 0;
    } else if (left == count && count >= kFewest && 2.0 * owed >= static_cast<double>(count)) {
      taken = count;
    }
    owed -= static_cast<double>(taken);
    return taken;
  }

  SplitFractions fractions_;
  double owed_validation_ = 0.0, owed_accept_ = 0.0;
};

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

std::string names_with_lines(const DataSet& data, const std::vector<std::size_t>& poses) {
  std::string names;
  for (const std::size_t i : poses) {
    const MeasuredPose& pose = data.poses[i];
    const std::string line = line_name(pose.line);
    names += (names.empty() ? "" : ", ") + (names_itself(pose) ? pose.pose_id + " (" + line + ")" : line);
  }
  return names;
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
  std::map<std::string, std::vector<std::string>> ids_at;
  std::set<std::string> seen;
  for (const MeasuredPose& pose : poses)
    if (seen.insert(pose.pose_id).second) ids_at[pose.contact].push_back(pose.pose_id);
  std::map<std::string, PoseSet> set_of;
  SharesOfContacts shares(fractions);
  for (auto& [contact, ids] : ids_at) {
    shuffle(ids, draw);
    const SetSizes sizes = contact.empty() ? sizes_of(ids.size(), fractions) : shares.next(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) {
      set_of[ids[i]] = i < sizes.validation                  ? PoseSet::validation
                       : i < sizes.validation + sizes.accept ? PoseSet::accept
                                                             : PoseSet::calibration;
    }
  }
  for (MeasuredPose& pose : poses) pose.set = set_of[pose.pose_id];
}

}  // namespace demecal::inline data
