#include <fmt/format.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "data/stated_radius.hpp"
#include "data_check/searches.hpp"
#include "decompositions/decompositions.hpp"
#include "kinematics/chain.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/posterior.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "random/distributions.hpp"
#include "trials/finding.hpp"

namespace demecal::inline data_check {
namespace {

constexpr double kMakersScatter_m = 5e-4;  ///< of links about their description, at least: else few of them tell it

/// The lengths of links that the model found: as described, as fitted, and what is known of the difference.
struct LinkLengths {
  Eigen::VectorXd described_m, difference_m;
  Eigen::MatrixXd covariance_m2;
};

LinkLengths lengths_of_links(const Chain& described, const Chain& fitted, const Posterior& posterior) {
  std::vector<double> before_m, change_m;
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < posterior.ids.size(); ++i) {
    const ParameterId& id = posterior.ids[i];
    if (id.kind != ParameterId::Kind::link || (id.link != LinkParameter::a && id.link != LinkParameter::d)) continue;
    const auto joint = static_cast<std::size_t>(id.index);
    const double length_m = described.joints[joint].parameter(id.link);
    if (length_m == 0.0) continue;
    before_m.push_back(length_m);
    change_m.push_back(fitted.joints[joint].parameter(id.link) - length_m);
    rows.push_back(static_cast<Eigen::Index>(i));
  }
  const Eigen::MatrixXd factor = posterior.factor(rows, Eigen::all);
  return {Eigen::Map<Eigen::VectorXd>(before_m.data(), std::ssize(before_m)),
          Eigen::Map<Eigen::VectorXd>(change_m.data(), std::ssize(change_m)), factor * factor.transpose()};
}

/// What errors of the arm that no fit explains leave open of the scale, as a share of it: they do not average over the
/// touches of a contact as noise does, and are taken to be half of what its touches scatter by.
double open_share(const DataSet& data, const CorrectedRobot& robot) {
  constexpr double kShared = 0.5;
  const std::vector<double> errors_m = tool_errors_m(robot, data, poses_of(data, PoseSet::calibration));
  double squares_m2 = 0.0;
  for (const double error_m : errors_m) squares_m2 += error_m * error_m;
  const double shared_m2 = kShared * kShared * squares_m2 / (3.0 * static_cast<double>(errors_m.size()));
  double information = 0.0;
  for (const KnownDistance& known : data.contacts.distances) {
    const double ends = is_radius(known) ? 1.0 : 2.0;
    information += known.length_m * known.length_m / (known.sigma_m * known.sigma_m + ends * shared_m2);
  }
  return 1.0 / std::sqrt(information);
}

/// Whether any radius is stated, exactly or not.
bool shows_radii(const Contacts& contacts) {
  return std::ranges::any_of(contacts.distances,
                             [](const KnownDistance& one) { return is_radius(one) && !is_wire_zero(one); }) ||
         std::ranges::any_of(contacts.forms, [](const auto& form) { return form.second.radius_m.value_or(0.0) > 0.0; });
}

/// By how much all lengths together are longer, and how surely, where each scatters about that by itself too.
struct CommonFactor {
  double change = 0.0, deviation = 0.0;
  double misfit = 0.0;  ///< squares of what is left, over those expected, times their number
};

CommonFactor common_factor(const LinkLengths& lengths, double scatter_m) {
  Eigen::MatrixXd covariance = lengths.covariance_m2;
  covariance.diagonal().array() += scatter_m * scatter_m;
  const Cholesky root(covariance);
  const Eigen::VectorXd slope = root.whitened(lengths.described_m), change = root.whitened(lengths.difference_m);
  CommonFactor factor{.change = slope.dot(change) / slope.squaredNorm(), .deviation = 1.0 / slope.norm()};
  factor.misfit = (change - factor.change * slope).squaredNorm();
  return factor;
}

/// The same with the scatter that the lengths show.
CommonFactor common_factor(const LinkLengths& lengths) {
  constexpr double kStep = 1.1;
  const double expected = static_cast<double>(lengths.described_m.size() - 1);
  double scatter_m = kMakersScatter_m;
  CommonFactor factor = common_factor(lengths, scatter_m);
  while (factor.misfit > expected) {
    scatter_m *= kStep;
    factor = common_factor(lengths, scatter_m);
  }
  return factor;
}

}  // namespace

std::optional<Finding> find_common_factor(const DataSet& data, const CorrectedRobot& robot,
                                          const Posterior& posterior) {
  constexpr std::ptrdiff_t kFewest = 3;
  constexpr double kMakersCount = 20.0;  // lengths that what is assumed of makers' scatter is worth
  constexpr double kLeast = 2e-3, kAsFourDeviations = 0.99993666;  ///< probability within four of a normal number
  if (has_instrument(data) || data.contacts.distances.empty()) return std::nullopt;
  LinkLengths lengths = lengths_of_links(data.robot.chain, robot.chain, posterior);
  if (lengths.described_m.size() < kFewest) return std::nullopt;
  lengths.covariance_m2 += std::pow(open_share(data, robot), 2) * lengths.described_m * lengths.described_m.transpose();
  const CommonFactor factor = common_factor(lengths);
  const double limit = std::sqrt(
      fisher_quantile(kAsFourDeviations, 1.0, static_cast<double>(lengths.described_m.size() - 1) + kMakersCount));
  const double most = factor.deviation * limit;
  if (!(std::abs(factor.change) > std::max(kLeast, most))) return std::nullopt;
  std::vector<std::string_view> keys = length_keys(data.contacts);
  if (shows_radii(data.contacts)) keys.emplace_back("contacts.radii_mm");
  return Finding{
      .kind = FindingKind::disagreeing_length,
      .sentence = fmt::format(
          "All links of the arm are fitted {:.2f} % {} than described, by one factor (± {:.2f} %): known lengths and "
          "stated radii, which the scale is from, are {} by that much, or the description is of another arm. Check "
          "{}, their unit, and the robot's lengths.",
          100.0 * std::abs(factor.change), factor.change > 0.0 ? "longer" : "shorter", 100.0 * factor.deviation,
          factor.change > 0.0 ? "too long" : "too short", fmt::join(keys, " and "))};
}

}  // namespace demecal::inline data_check
