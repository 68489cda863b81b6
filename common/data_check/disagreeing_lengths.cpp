#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data/stated_radius.hpp"
#include "data_check/searches.hpp"
#include "effects/arm_state.hpp"
#include "kinematics/units.hpp"
#include "parameters/posterior.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "prediction/place_uncertainty.hpp"
#include "trials/finding.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kDisagrees = 4.0;  ///< standard deviations

/// How the mean of the points of a contact's poses moves with each of the posterior's independent numbers.
struct PlacedContact {
  Eigen::MatrixXd spread_m;  ///< 3 x numbers
  ContactPlace place{};
  std::vector<Touch> touches{};
};

class PlacedContacts {
 public:
  PlacedContacts(const DataSet& data, const CorrectedRobot& robot, const Posterior& posterior)
      : data_(data), robot_(robot), posterior_(posterior), groups_(contact_groups(data)) {}

  PlacedContact at(const ContactGroup& group) const {
    const std::vector<std::size_t>& members = groups_.at(group);
    PlacedContact placed{.spread_m = Eigen::MatrixXd::Zero(3, posterior_.factor.cols())};
    for (const std::size_t index : members) {
      const MeasuredPose& pose = data_.poses[index];
      placed.touches.push_back(touch_of(robot_, pose));
      placed.spread_m +=
          pose_spread(posterior_, robot_, Stop(pose), pose.target).topRows<3>() / static_cast<double>(members.size());
    }
    placed.place = contact_place(data_.contacts.form_of(group.contact), placed.touches);
    return placed;
  }

 private:
  const DataSet& data_;
  const CorrectedRobot& robot_;
  const Posterior& posterior_;
  std::map<ContactGroup, std::vector<std::size_t>> groups_;
};

/// What the model leaves open of a length, m^2: contacts' places are means of so many touches, but what it errs by
/// beyond its posterior touches have in common.
double open_m2(const PlacedContact& first, const PlacedContact& second, const Eigen::Vector3d& along,
               const PredictionInterval& interval) {
  const Eigen::RowVectorXd spread_m = along.transpose() * (first.spread_m - second.spread_m);
  return spread_m.squaredNorm() + placed_m2(first.place, first.touches, second.place, interval.noise_m) +
         placed_m2(second.place, second.touches, first.place, interval.noise_m) +
         2.0 * std::pow(interval.model_error_m, 2);
}

/// Whether a radius is stated of the contact, from which the model has its scale too.
bool is_stated_sphere(const DataSet& data, const std::string& contact) {
  const KnownDistance* const stated = stated_radius(data.contacts, contact);
  return data.contacts.form_of(contact).radius_m || (stated != nullptr && !is_wire_zero(*stated));
}

}  // namespace

std::vector<Finding> find_disagreeing_lengths(const DataSet& data, const CorrectedRobot& robot,
                                              const Posterior& posterior, const PredictionInterval& interval) {
  std::vector<Finding> found;
  const PlacedContacts places(data, robot, posterior);
  for (const LengthError& one : length_errors(robot, data)) {
    const KnownDistance& known = *one.known;
    const PlacedContact first = places.at({known.first, one.set}), second = places.at({known.second, one.set});
    const double deviation_m = std::sqrt(known.sigma_m * known.sigma_m + open_m2(first, second, one.along, interval));
    if (!(std::abs(one.error_m) > kDisagrees * deviation_m)) continue;
    Finding finding{.kind = FindingKind::disagreeing_length, .as_given_mm = millimetres(std::abs(one.error_m))};
    finding.sentence = fmt::format(
        "'{}' and '{}' are {:.6g} mm apart as given, and {:.3f} mm by the model at the {} poses: {:.0f} times the "
        "standard uncertainty of both ({:.3f} mm). ",
        known.first, known.second, millimetres(known.length_m), millimetres(known.length_m + one.error_m),
        to_string(one.set), std::abs(one.error_m) / deviation_m, millimetres(deviation_m));
    const auto radii = std::ranges::count_if(data.contacts.distances, is_radius);
    finding.sentence +=
        std::ssize(data.contacts.distances) > radii + 1
            ? fmt::format("Known lengths contradict each other, or the model's scale is wrong: check all of {}, ",
                          fmt::join(length_keys(data.contacts), ", "))
            : fmt::format("The length or the model's scale is wrong: check {}, ", known.key());
    finding.sentence += is_stated_sphere(data, known.first) || is_stated_sphere(data, known.second)
                            ? "contacts.radii_mm, and the names of the contacts."
                            : "and the names of the contacts.";
    found.push_back(std::move(finding));
  }
  return worst_lengths(std::move(found));
}

}  // namespace demecal::inline data_check
