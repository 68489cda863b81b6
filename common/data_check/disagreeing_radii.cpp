#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data/stated_radius.hpp"
#include "data_check/searches.hpp"
#include "decompositions/decompositions.hpp"
#include "fitting/fit.hpp"
#include "fitting/least_squares.hpp"
#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/observation.hpp"
#include "parameters/parameter_space.hpp"
#include "prediction/contact_place.hpp"
#include "prediction/corrected_robot.hpp"
#include "trials/finding.hpp"

namespace demecal::inline data_check {
namespace {

/// Takes all radii that are stated out of the data, exact ones too. Returns them, by the contacts' names.
std::map<std::string, KnownDistance> take_radii(Contacts& contacts) {
  std::map<std::string, KnownDistance> radii;
  const auto is_taken = [](const KnownDistance& one) { return is_radius(one) && !is_wire_zero(one); };
  for (const KnownDistance& one : contacts.distances)
    if (is_taken(one)) radii[one.first] = one;
  std::erase_if(contacts.distances, is_taken);
  for (auto& [contact, form] : contacts.forms) {
    if (!(form.radius_m.value_or(0.0) > 0.0)) continue;
    radii[contact] = {contact, {}, *form.radius_m, 0.0};
    form.radius_m.reset();
  }
  return radii;
}

/// The standard deviation that rows and makers' figures leave each of `ids` about a fit, m and rad.
Eigen::VectorXd deviations_of(const DataSet& data, const std::vector<std::size_t>& poses,
                              const std::vector<ParameterId>& ids, const Fit& fit) {
  constexpr double kAnywhere = 10.0;  ///< m or rad: what nothing is believed of
  const ParameterSpace space(fit.robot, ids);
  const ModelPoint point = space.at(Eigen::VectorXd::Zero(space.size()));
  Eigen::MatrixXd information = link_prior(space, nominal_robot(data), {}).precision.cwiseAbs2().asDiagonal();
  information.diagonal().array() += 1.0 / (kAnywhere * kAnywhere);
  RowScales scales{};
  scales[kPosition] = fit.sigma_position_m;
  ScaledRows rows;
  for (const Observation& observation : observe(data, poses, fit.robot)) {
    scaled_rows(data, space, point, observation, scales, rows);
    information += rows.jacobian.transpose() * rows.jacobian;
  }
  const Eigen::MatrixXd known = relation_rows(data, space, point).jacobian;
  information += known.transpose() * known;
  const Eigen::MatrixXd covariance =
      PivotedCholesky(information).solve(Eigen::MatrixXd::Identity(space.size(), space.size()));
  return covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
}

Finding of_radius(const KnownDistance& stated, double found_m, double deviation_m, bool lengths_known) {
  constexpr double kOfDiameter = 0.1;  // of the radius: a tip adds to it
  const double error_m = std::abs(found_m - stated.length_m);
  const bool is_diameter = std::abs(found_m - 0.5 * stated.length_m) < kOfDiameter * found_m;
  return {
      .kind = FindingKind::disagreeing_length,
      .as_given_mm = millimetres(error_m),
      .sentence = fmt::format(
          "The radius of '{}' is {:.6g} mm as given, and {:.3f} mm by all else that is known of the calibration "
          "poses: {:.0f} times the standard uncertainty of both ({:.3f} mm). {}Correct contacts.radii_mm (the ball's "
          "radius and that of the tip that touches it together){}, or state under contacts.radii_sigma_mm how well "
          "it is known.",
          stated.first, millimetres(stated.length_m), millimetres(found_m), error_m / deviation_m,
          millimetres(deviation_m), is_diameter ? "What is given seems to be the diameter. " : "",
          lengths_known ? " or contacts.distances" : "")};
}

}  // namespace

std::vector<Finding> find_disagreeing_radii(const DataSet& data) {
  constexpr double kDisagrees_deviations = 4.0, kLeast_m = 1e-5;
  DataSet rest = data;
  const std::map<std::string, KnownDistance> radii = take_radii(rest.contacts);
  if (radii.empty()) return {};
  const std::vector<std::size_t> poses = poses_of(rest, PoseSet::calibration);
  const DeclaredModel declared{.registration = true, .tool = true, .joint_offset = true, .geometry = true};
  const Fit fit = fit_declared(rest, poses, declared, nominal_robot(rest));
  if (fit.status != FitStatus::converged) return {};
  std::vector<ParameterId> ids = free_parameters(rest, declared);
  std::ranges::move(contact_parameters(rest, poses), std::back_inserter(ids));
  const Eigen::VectorXd deviations_m = deviations_of(rest, poses, ids, fit);
  std::vector<Finding> found;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto stated = radii.find(ids[i].target);
    if (ids[i].kind != ParameterId::Kind::contact || ids[i].index != kRadiusMotion || stated == radii.end()) continue;
    const double found_m = fit.robot.contacts.at({ids[i].target, ids[i].set}).radius_m;
    const double deviation_m = std::hypot(stated->second.sigma_m, deviations_m[static_cast<Eigen::Index>(i)], kLeast_m);
    if (std::abs(found_m - stated->second.length_m) > kDisagrees_deviations * deviation_m)
      found.push_back(of_radius(stated->second, found_m, deviation_m, !rest.contacts.distances.empty()));
  }
  return found;
}

}  // namespace demecal::inline data_check
