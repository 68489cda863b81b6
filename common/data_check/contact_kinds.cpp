#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data_check/searches.hpp"
#include "data_check/touched_contacts.hpp"
#include "kinematics/units.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"
#include "trials/finding.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kScattered_m = 1e-2;       ///< of touches at the median: no arm as described scatters so
constexpr double kFits = 0.15;              ///< of the scatter: what another kind may leave of it
constexpr double kFitsMost_m = 5e-3;        ///< and at most
constexpr std::size_t kFewestTouches = 8;   ///< that tell a kind
constexpr std::size_t kFewestPlaces = 6;    ///< of them
constexpr double kApart = 8.0;              ///< times what touches leave a contact by: from there on places differ
constexpr std::size_t kFewestAgreeing = 6;  ///< touches of points, or as many numbers of other contacts

using ContactNames = std::set<std::string>;

/// The calibration poses at those contacts and no others.
DataSet at_contacts(DataSet data, const ContactNames& contacts) {
  std::erase_if(data.poses, [&](const MeasuredPose& pose) {
    return pose.set != PoseSet::calibration || !contacts.contains(pose.contact);
  });
  std::erase_if(data.contacts.angles, [](const KnownAngle&) { return true; });
  return data;
}

DataSet with_kind(DataSet data, const std::string& contact, ContactKind kind) {
  data.contacts.forms[contact] = {.kind = kind, .radius_m = {}};
  for (MeasuredPose& pose : data.poses)
    if (pose.contact == contact) pose.contact_kind = kind;
  return data;
}

/// How far touches are from their contact by `robot`, at the median.
double median_distance_m(const TouchedContacts& touched, const ContactGroup& group) {
  const ContactPlace place = touched.place(group);
  std::vector<double> distances_m;
  for (const std::size_t pose : touched.groups().at(group)) distances_m.push_back(touched.distance_m(place, pose));
  return median(std::move(distances_m));
}

/// How far apart contacts have their touches by an arm fitted to these alone: each's median, the greatest first found.
struct ContactScatter {
  std::map<std::string, double> of_contact_m;

  double most_m() const {
    double most_m = 0.0;
    for (const auto& [contact, scatter_m] : of_contact_m) most_m = std::max(most_m, scatter_m);
    return most_m;
  }
  double sum_m() const {
    double sum_m = 0.0;
    for (const auto& [contact, scatter_m] : of_contact_m) sum_m += scatter_m;
    return sum_m;
  }
};

std::optional<ContactScatter> scatter_at(const DataSet& data, const ContactNames& contacts) {
  const DataSet own = at_contacts(data, contacts);
  const std::optional<CorrectedRobot> robot = stiff_arm(own);
  if (!robot) return std::nullopt;
  const TouchedContacts touched(own, *robot, {});
  ContactScatter scatter;
  for (const auto& [group, poses] : touched.groups())
    scatter.of_contact_m[group.contact] = median_distance_m(touched, group);
  return scatter;
}

/// The contacts that agree as they are stated, once those are left out that spoil the others most.
ContactNames agreeing_contacts(const DataSet& data) {
  ContactNames rest;
  for (const auto& [group, poses] : contact_groups(data))
    if (group.set == PoseSet::calibration) rest.insert(group.contact);
  std::optional<ContactScatter> scatter = scatter_at(data, rest);
  while (scatter && scatter->most_m() > kScattered_m) {
    std::optional<ContactScatter> best;
    std::string out;
    for (const auto& [contact, scatter_m] : scatter->of_contact_m) {
      if (scatter_m < kScattered_m) continue;
      ContactNames others = rest;
      others.erase(contact);
      std::optional<ContactScatter> left = scatter_at(data, others);
      if (!left || (best && left->sum_m() > best->sum_m())) continue;
      best = std::move(left);
      out = contact;
    }
    if (!best) return {};
    rest.erase(out);
    scatter = std::move(best);
  }
  return scatter ? rest : ContactNames{};
}

/// How a contact is found, and how the touches lie then.
struct OtherKind {
  ContactKind kind = ContactKind::point;
  double left_m = std::numeric_limits<double>::infinity();  ///< from the place, at the median
  std::size_t places = 0;  ///< of touches farther apart than they leave the place by: few where sockets share a name
};

OtherKind found_as(const DataSet& data, const ContactNames& agreeing, const std::string& contact, ContactKind kind) {
  ContactNames contacts = agreeing;
  contacts.insert(contact);
  const DataSet changed = with_kind(at_contacts(data, contacts), contact, kind);
  const std::optional<CorrectedRobot> robot = stiff_arm(changed);
  if (!robot) return {};
  const ContactGroup group{contact, PoseSet::calibration};
  const TouchedContacts touched(changed, *robot, {});
  const double left_m = median_distance_m(touched, group);
  std::vector<Eigen::Vector3d> places;
  for (const std::size_t pose : touched.groups().at(group)) {
    const Eigen::Vector3d point_m = touch_of(*robot, changed.poses[pose]).point_m;
    const auto is_near = [&](const Eigen::Vector3d& place_m) { return (place_m - point_m).norm() < kApart * left_m; };
    if (std::ranges::none_of(places, is_near)) places.push_back(point_m);
  }
  return {kind, left_m, places.size()};
}

/// The simplest kind that fits hardly worse than the best: a plane is nearly on a large sphere. A line is on planes
/// that lean to an arm's errors: it has to fit, however much nearer one of these comes.
std::optional<OtherKind> other_kind(const DataSet& data, const ContactNames& agreeing, const std::string& contact,
                                    double scatter_m) {
  constexpr double kHardlyWorse = 2.0;
  const ContactKind stated = data.contacts.form_of(contact).kind;
  const double most_m = std::min(kFits * scatter_m, kFitsMost_m);
  std::optional<OtherKind> best;
  for (const ContactKind kind : {ContactKind::sphere, ContactKind::plane, ContactKind::line}) {
    if (kind == stated) continue;
    const OtherKind one = found_as(data, agreeing, contact, kind);
    const bool is_line = kind == ContactKind::line && one.left_m < most_m;
    if (!best || is_line || one.left_m < kHardlyWorse * best->left_m) best = one;
  }
  if (!best || best->left_m > most_m) return std::nullopt;
  return best->places < kFewestPlaces ? std::nullopt : best;
}

Finding of_kind(const DataSet& data, const std::string& contact, double scatter_m, const OtherKind& other) {
  Finding finding{.kind = FindingKind::wrong_kind,
                  .as_given_mm = millimetres(scatter_m),
                  .if_changed_mm = millimetres(other.left_m)};
  for (const MeasuredPose& pose : data.poses)
    if (pose.contact == contact && pose.set == PoseSet::calibration) finding.poses.push_back(pose.pose_id);
  finding.sentence = fmt::format(
      "Contact '{0}' is no {1}: its {2} calibration touches lie {3} from one (median) by the arm as described, but {4} "
      "from a {5}. State contacts.kinds: {{{0}: {5}}}, or correct the names of the contacts.",
      contact, to_string(data.contacts.form_of(contact).kind), finding.poses.size(), distance_text(scatter_m),
      distance_text(other.left_m), to_string(other.kind));
  return finding;
}

/// Whether a wrong arm could not have these contacts agree: points, spheres by what their touches tell beyond place and
/// radius, and planes of three directions alike; level planes agree whatever joint 1 does.
bool are_telling(const DataSet& data, const ContactNames& agreeing) {
  constexpr double kThreeDirections = 0.1;  ///< volume that three normals span
  const DataSet own = at_contacts(data, agreeing);
  const std::optional<CorrectedRobot> robot = stiff_arm(own);
  if (!robot) return false;
  const TouchedContacts touched(own, *robot, {});
  std::size_t points = 0, of_spheres = 0, of_planes = 0;
  Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
  for (const auto& [group, poses] : touched.groups()) {
    const ContactPlace place = touched.place(group);
    const std::size_t taken = motions_of(place).size();
    const std::size_t beyond = poses.size() > taken ? poses.size() - taken : 0;
    if (place.kind == ContactKind::point) points += poses.size();
    if (place.kind == ContactKind::sphere) of_spheres += beyond;
    if (place.kind != ContactKind::plane) continue;
    of_planes += beyond;
    const Eigen::Vector3d normal = place.frame.linear().col(2);
    normals += normal * normal.transpose();
  }
  if (normals.determinant() < kThreeDirections * kThreeDirections) of_planes = 0;
  constexpr std::size_t kNumbersOfPoint = 3;
  return points >= kFewestAgreeing || of_spheres + of_planes >= kNumbersOfPoint * kFewestAgreeing;
}

}  // namespace

std::vector<Finding> find_wrong_kinds(const DataSet& data) {
  const ContactNames agreeing = agreeing_contacts(data);
  if (agreeing.empty() || !are_telling(data, agreeing)) return {};
  std::vector<Finding> found;
  for (const auto& [group, poses] : contact_groups(data)) {
    if (group.set != PoseSet::calibration || agreeing.contains(group.contact) || poses.size() < kFewestTouches)
      continue;
    ContactNames contacts = agreeing;
    contacts.insert(group.contact);
    const std::optional<ContactScatter> scatter = scatter_at(data, contacts);
    if (!scatter) continue;
    const double scatter_m = scatter->of_contact_m.at(group.contact);
    if (const auto other = other_kind(data, agreeing, group.contact, scatter_m))
      found.push_back(of_kind(data, group.contact, scatter_m, *other));
  }
  return found;
}

}  // namespace demecal::inline data_check
