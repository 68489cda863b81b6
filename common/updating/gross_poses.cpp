#include "updating/gross_poses.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
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

/// A pose by its place, by how many times it is further out than is usual when it has no part in the sizes.
struct Suspect {
  std::size_t place;
  double times;
  BeliefSizes without;  ///< likeliest without it
};

/// The places of what may be gross, the worst first. Among few poses one that is bends what the others predict so far
/// that another may look worse.
std::vector<std::size_t> suspected_places(const LeftOut& found) {
  constexpr double kSuspect = 2.0;
  constexpr std::size_t kFew = 20, kMost = 8;
  std::vector<std::size_t> places(found.standard.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::ranges::stable_sort(places, std::greater{}, [&](std::size_t place) { return found.standard[place]; });
  if (places.size() <= kFew) {
    places.resize(std::min(places.size(), kMost));
  } else {
    places.resize(1);
    if (found.standard[places[0]] < kSuspect * median(found.standard)) places.clear();
  }
  return places;
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
    result.squares += error.squaredNorm();
    const double square = error.dot(whitened.segment(first, count)) / static_cast<double>(count);
    result.standard.push_back(std::sqrt(std::max(0.0, square)));
  }
  return result;
}

std::vector<std::size_t> gross_poses(const PriorModel& prior, const NewRows& rows, const BeliefSizes& sizes,
                                     JointSizes joints) {
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
    std::optional<Suspect> worst;
    for (const std::size_t place : suspected_places(left_out_by(prior, present, all))) {
      std::vector<std::size_t> fewer = kept;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(place));
      const NewRows others = rows_at_places(rows, fewer);
      BeliefSizes without = likeliest_sizes(prior, others, joints);
      const double times =
          left_out_by(prior, without, all).standard[place] / most_expected(left_out_by(prior, without, others));
      if (times > 1.0 && (!worst || times > worst->times)) worst = Suspect{place, times, std::move(without)};
    }
    if (!worst) break;
    gross.push_back(kept[worst->place]);
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(worst->place));
    present = std::move(worst->without);
  }
  for (std::size_t& place : gross) place = rows.field.poses[place];
  std::ranges::sort(gross);
  return gross;
}

}  // namespace demecal::inline updating
