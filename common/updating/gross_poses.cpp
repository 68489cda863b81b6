#include "updating/gross_poses.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "random/distributions.hpp"

namespace demecal::inline updating {
namespace {

double most_expected(const LeftOut& found) {
  constexpr double kGross = 4.0;  ///< times what is usual
  return kGross * std::max(1.0, median(found.standard));
}

/// The rows of these places among the poses.
NewRows rows_at_places(const NewRows& rows, const std::vector<std::size_t>& places) {
  std::vector<Eigen::Index> kept;
  NewRows some;
  some.field.first_row = {0};
  for (const std::size_t place : places) {
    for (Eigen::Index row = rows.field.first_row[place]; row < rows.field.first_row[place + 1]; ++row)
      kept.push_back(row);
    some.field.poses.push_back(rows.field.poses[place]);
    some.field.first_row.push_back(std::ssize(kept));
  }
  some.columns = rows.columns(kept, Eigen::all);
  some.values = rows.values(kept);
  return some;
}

LeftOut left_out_by(const PriorModel& prior, const BeliefSizes& sizes, const NewRows& rows) {
  return left_out(prior.covariance(sizes.factors, sizes.of_joint), rows, sizes.noise);
}

}  // namespace

LeftOut left_out(const Eigen::MatrixXd& covariance, const NewRows& rows, double noise) {
  Eigen::MatrixXd all = rows.columns * covariance * rows.columns.transpose();
  all.diagonal().array() += noise;
  const Eigen::MatrixXd inverse = Cholesky(all).inverse();
  const Eigen::VectorXd whitened = inverse * rows.values;
  LeftOut result;
  for (std::size_t pose = 0; pose < rows.field.poses.size(); ++pose) {
    const Eigen::Index first = rows.field.first_row[pose], count = rows.field.rows_of_pose(pose);
    const Eigen::VectorXd error =
        Cholesky(inverse.block(first, first, count, count)).solve(whitened.segment(first, count));
    result.by_pose.push_back(error.squaredNorm());
    result.squares += result.by_pose.back();
    const double square = error.dot(whitened.segment(first, count)) / static_cast<double>(count);
    result.standard.push_back(std::sqrt(std::max(0.0, square)));
  }
  return result;
}

std::vector<std::size_t> gross_poses(const PriorModel& prior, const NewRows& rows, const BeliefSizes& sizes,
                                     JointSizes joints) {
  constexpr double kSuspect = 2.0;
  constexpr std::size_t kFew = 20;
  constexpr std::size_t kOneIn = 10;  ///< poses is looked for so, and one of few: more of them are no errors
  constexpr std::size_t kFewest = 6;  ///< of fewer, base and tool follow the one that is
  const std::size_t poses = rows.field.poses.size(),
                    most = poses < kFewest ? 0 : std::max<std::size_t>(1, poses / kOneIn);
  const LeftOut found = left_out_by(prior, sizes, rows);
  std::vector<std::size_t> kept, gross;
  for (std::size_t i = 0; i < found.standard.size(); ++i)
    (found.standard[i] <= most_expected(found) ? kept : gross).push_back(i);
  BeliefSizes present = sizes;
  for (std::size_t searched = 0; searched < most; ++searched) {
    const NewRows all = rows_at_places(rows, kept);
    const LeftOut by_all = left_out_by(prior, present, all);
    const auto worst = std::ranges::max_element(by_all.standard);
    // One that is gross bends what few others predict, so that these look bad as well.
    if (kept.size() > kFew && *worst < kSuspect * median(by_all.standard)) break;
    const auto place = worst - by_all.standard.begin();
    std::vector<std::size_t> fewer = kept;
    fewer.erase(fewer.begin() + place);
    const NewRows others = rows_at_places(rows, fewer);
    present = likeliest_sizes(prior, others, joints);
    const double standard = left_out_by(prior, present, all).standard[static_cast<std::size_t>(place)];
    if (standard <= most_expected(left_out_by(prior, present, others))) break;
    gross.push_back(kept[static_cast<std::size_t>(place)]);
    kept = std::move(fewer);
  }
  for (std::size_t& place : gross) place = rows.field.poses[place];
  std::ranges::sort(gross);
  return gross;
}

}  // namespace demecal::inline updating
