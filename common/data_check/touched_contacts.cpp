#include "data_check/touched_contacts.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "decompositions/decompositions.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kFar = 8.0;          ///< deviations beyond which no noise goes
constexpr double kLeast_m = 3e-4;     ///< what a ball's play may be
constexpr double kLeastShown = 0.05;  ///< share of a squared error that has to show for the pose to be judged

constexpr std::string_view kOnceMoved = "\n";  ///< behind the name, which has no such end, of where a contact moved to

constexpr double kMedianVariance = 1.5;  ///< of a median of few, over that of one of them times their number

/// Of each touch, the share of its squared error that its distance from the place shows which all are fitted to: one
/// less its leverage, at the coordinate that the place leans most on.
std::vector<double> shown_shares(const ContactPlace& place, const std::vector<Touch>& touches) {
  constexpr double kRank = 1e-6;
  const std::vector<int> motions = motions_of(place);
  const int rows = rows_of(place.kind);
  Eigen::MatrixXd slopes(static_cast<Eigen::Index>(touches.size()) * rows, static_cast<Eigen::Index>(motions.size()));
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const Eigen::MatrixXd own = contact_jacobian(place, touches[i].point_m);
    for (std::size_t k = 0; k < motions.size(); ++k)
      slopes.block(static_cast<Eigen::Index>(i) * rows, static_cast<Eigen::Index>(k), rows, 1) =
          own * equivalent_motion(place, motions[k], Eigen::Vector3d::Zero(), touches[i].point_m);
  }
  const Eigen::MatrixXd basis = PivotedQr(slopes, kRank).basis();
  std::vector<double> shares;
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const double leverage =
        basis.middleRows(static_cast<Eigen::Index>(i) * rows, rows).rowwise().squaredNorm().maxCoeff();
    shares.push_back(std::max(0.0, 1.0 - leverage));
  }
  return shares;
}

}  // namespace

TouchedContacts::TouchedContacts(const DataSet& data, const CorrectedRobot& robot,
                                 const std::vector<MovedContact>& moved)
    : data_(data), groups_(contact_groups(data)) {
  for (const MovedContact& one : moved) {
    std::vector<std::size_t>& before = groups_.at(one.group);
    before.resize(before.size() - one.from_there.size());
    groups_[{one.group.contact + std::string(kOnceMoved), one.group.set}] = one.from_there;
  }
  for (const MeasuredPose& pose : data.poses)
    touches_.push_back(pose.contact.empty() ? Touch{Eigen::Vector3d::Zero()} : touch_of(robot, pose));
}

std::string TouchedContacts::name_of(const ContactGroup& group) {
  std::string name = group.contact;
  if (!name.ends_with(kOnceMoved)) return "'" + name + "'";
  name.resize(name.size() - kOnceMoved.size());
  return "'" + name + "' where it stands after it moved";
}

std::vector<std::size_t> TouchedContacts::kept(const ContactGroup& group, std::optional<std::size_t> without) const {
  std::vector<std::size_t> poses;
  for (const std::size_t pose : groups_.at(group))
    if (!left_out_.contains(pose) && pose != without) poses.push_back(pose);
  return poses;
}

std::vector<Touch> TouchedContacts::touches_at(const std::vector<std::size_t>& poses) const {
  std::vector<Touch> touches;
  for (const std::size_t pose : poses) touches.push_back(touches_[pose]);
  return touches;
}

ContactPlace TouchedContacts::place_of(const ContactGroup& group, const std::vector<std::size_t>& poses) const {
  const std::vector<Touch> touches = touches_at(poses);
  ContactPlace place = contact_place(data_.contacts.form_of(group.contact), touches);
  if (place.kind != ContactKind::point) return place;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> along;
    for (const Touch& touch : touches) along.push_back(touch.point_m[axis]);
    place.frame.translation()[axis] = median(along);
  }
  return place;
}

ContactPlace TouchedContacts::place(const ContactGroup& group, std::optional<std::size_t> without) const {
  const std::vector<std::size_t> poses = kept(group, without);
  return place_of(group, poses.empty() ? std::vector<std::size_t>{groups_.at(group).front()} : poses);
}

double TouchedContacts::distance_m(const ContactPlace& place, std::size_t pose) const {
  return contact_residual(place, touches_[pose]).norm();
}

std::vector<double> TouchedContacts::errors_m(const ContactGroup& group, std::optional<std::size_t> without) const {
  const std::vector<std::size_t> poses = kept(group, without);
  std::vector<double> errors(poses.size(), 0.0);
  if (poses.size() < 2) return errors;
  if (kind_of(group) == ContactKind::point) {
    const double others = static_cast<double>(poses.size() - 1);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      std::vector<std::size_t> rest = poses;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
      errors[i] = distance_m(place_of(group, rest), poses[i]) / std::sqrt(1.0 + kMedianVariance / others);
    }
    return errors;
  }
  const ContactPlace place = place_of(group, poses);
  const std::vector<double> shares = shown_shares(place, touches_at(poses));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (shares[i] < kLeastShown) continue;
    errors[i] = data_.poses[poses[i]].contact_weight * distance_m(place, poses[i]) / std::sqrt(shares[i]);
  }
  return errors;
}

double TouchedContacts::far_m() const {
  std::vector<double> deviations_m;
  for (const auto& [group, members] : groups_)
    for (const double error_m : errors_m(group))
      if (error_m > 0.0) deviations_m.push_back(error_m / normal_length_quantile(rows_of(kind_of(group)), 0.5));
  return deviations_m.empty() ? std::numeric_limits<double>::infinity()
                              : std::max(kLeast_m, kFar * median(std::move(deviations_m)));
}

}  // namespace demecal::inline data_check
