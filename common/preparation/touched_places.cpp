#include "preparation/touched_places.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "decompositions/decompositions.hpp"
#include "random/distributions.hpp"

namespace demecal::inline preparation {
namespace {

constexpr std::size_t kMostForTool = 400;  ///< flanges; of more every few are taken
constexpr double kToolSpread_m = 0.15;     ///< how far a tool point may be from where its file says
constexpr double kErrors_m = 5e-3;         ///< an arm's own, within which no gap is one
constexpr double kLeastGap_m = 10e-3;

std::vector<Eigen::Isometry3d> some_of(const std::vector<Eigen::Isometry3d>& flanges) {
  const std::size_t step = flanges.size() / kMostForTool + 1;
  std::vector<Eigen::Isometry3d> some;
  for (std::size_t i = 0; i < flanges.size(); i += step) some.push_back(flanges[i]);
  return some;
}

/// One step of reweighted least squares.
Eigen::Vector3d reweighted(const std::vector<Eigen::Isometry3d>& flanges, const Eigen::Vector3d& nominal_m,
                           const Eigen::Vector3d& tool_m, double scale_m) {
  const double hold = 0.01 * std::pow(scale_m / kToolSpread_m, 2.0);
  Eigen::Matrix3d square = hold * Eigen::Matrix3d::Identity();
  Eigen::Vector3d right = hold * nominal_m;
  for (std::size_t i = 1; i < flanges.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Eigen::Matrix3d turn = flanges[i].linear() - flanges[j].linear();
      const Eigen::Vector3d shift = flanges[i].translation() - flanges[j].translation();
      const double apart = (turn * tool_m + shift).squaredNorm(), scale = scale_m * scale_m;
      const double weight = std::pow(scale / (scale + apart), 2.0);
      square += weight * turn.transpose() * turn;
      right -= weight * turn.transpose() * shift;
    }
  }
  return solve_pivoted(square, right);
}

/// Two clusters becoming one.
struct Merge {
  std::size_t first, second;  ///< a place of either
  double apart_m;
  std::size_t first_size, second_size;
  double first_top_m, second_top_m;  ///< at which these were joined themselves; 0 of single places
};

/// Average linkage by chains of nearest neighbours (Murtagh, 1983).
class Agglomeration {
 public:
  explicit Agglomeration(const std::vector<Eigen::Vector3d>& places_m)
      : size_(places_m.size(), 1), top_m_(places_m.size(), 0.0), alive_(places_m.size()) {
    const auto count = static_cast<Eigen::Index>(places_m.size());
    apart_m_.resize(count, count);
    for (Eigen::Index i = 0; i < count; ++i)
      for (Eigen::Index j = 0; j < count; ++j)
        apart_m_(i, j) = (places_m[static_cast<std::size_t>(i)] - places_m[static_cast<std::size_t>(j)]).norm();
    std::iota(alive_.begin(), alive_.end(), std::size_t{0});
  }

  std::vector<Merge> run() {
    std::vector<Merge> merges;
    std::vector<std::size_t> chain;
    while (alive_.size() > 1) {
      if (chain.empty()) chain.push_back(alive_.front());
      const std::size_t last = chain.back();
      const std::size_t before = chain.size() > 1 ? chain[chain.size() - 2] : last;
      const std::size_t next = nearest(last, before);
      if (next != before || chain.size() < 2) {
        chain.push_back(next);
        continue;
      }
      chain.resize(chain.size() - 2);
      merges.push_back(join(last, before));
    }
    return merges;
  }

 private:
  double apart_m(std::size_t one, std::size_t other) const {
    return apart_m_(static_cast<Eigen::Index>(one), static_cast<Eigen::Index>(other));
  }

  /// Of equally near ones the one before in the chain, so that chains end.
  std::size_t nearest(std::size_t cluster, std::size_t before) const {
    std::size_t best = before;
    double least_m = before == cluster ? std::numeric_limits<double>::infinity() : apart_m(cluster, before);
    for (const std::size_t other : alive_) {
      if (other == cluster || apart_m(cluster, other) >= least_m) continue;
      best = other;
      least_m = apart_m(cluster, other);
    }
    return best;
  }

  Merge join(std::size_t one, std::size_t other) {
    const std::size_t kept = std::min(one, other), gone = std::max(one, other);
    const Merge merge{kept, gone, apart_m(kept, gone), size_[kept], size_[gone], top_m_[kept], top_m_[gone]};
    const double kept_share = static_cast<double>(size_[kept]) / static_cast<double>(size_[kept] + size_[gone]);
    std::erase(alive_, gone);
    for (const std::size_t third : alive_) {
      if (third == kept) continue;
      const double mean_m = kept_share * apart_m(kept, third) + (1.0 - kept_share) * apart_m(gone, third);
      apart_m_(static_cast<Eigen::Index>(kept), static_cast<Eigen::Index>(third)) = mean_m;
      apart_m_(static_cast<Eigen::Index>(third), static_cast<Eigen::Index>(kept)) = mean_m;
    }
    size_[kept] += size_[gone];
    top_m_[kept] = merge.apart_m;
    return merge;
  }

  Eigen::MatrixXd apart_m_;
  std::vector<std::size_t> size_;
  std::vector<double> top_m_;
  std::vector<std::size_t> alive_;
};

/// Whether both parts are more than stray places.
bool joins_groups(const Merge& merge) {
  constexpr std::size_t kLeastPlaces = 3;
  return std::min(merge.first_size, merge.second_size) >= kLeastPlaces;
}

/// Where the mean distances of joined groups leap most, from those at which half of the near places were joined.
double widest_gap_m(const std::vector<Merge>& merges) {
  std::vector<double> near_m, heights_m;
  for (const Merge& merge : merges) {
    if (merge.apart_m >= kNeverOne_m) continue;
    near_m.push_back(merge.apart_m);
    if (joins_groups(merge)) heights_m.push_back(merge.apart_m);
  }
  if (near_m.empty()) return kNeverOne_m;
  std::ranges::sort(heights_m);
  heights_m.push_back(kNeverOne_m);
  double most = 0.0, cut_m = kNeverOne_m, below_m = std::max(median(std::move(near_m)), kErrors_m);
  for (const double height_m : heights_m) {
    if (height_m >= kLeastGap_m && height_m / below_m > most) {
      most = height_m / below_m;
      cut_m = std::sqrt(below_m * height_m);
    }
    below_m = std::max(below_m, height_m);
  }
  return cut_m;
}

/// Whether the parts are as far apart as no distances within either suggest.
bool may_be_two(const Merge& merge) {
  constexpr double kFarApart = 3.0, kLeastScatter_m = 1e-3;
  return joins_groups(merge) &&
         merge.apart_m > kFarApart * std::max({merge.first_top_m, merge.second_top_m, kLeastScatter_m});
}

std::size_t root_of(std::vector<std::size_t>& parents, std::size_t place) {
  while (parents[place] != place) place = parents[place] = parents[parents[place]];
  return place;
}

}  // namespace

Eigen::Vector3d common_tool_point(const std::vector<Eigen::Isometry3d>& flanges, const Eigen::Vector3d& nominal_m) {
  constexpr double kScales_m[] = {0.2, 0.1, 0.05, 0.03, 0.02, 0.015};
  constexpr int kSteps = 3;
  const std::vector<Eigen::Isometry3d> some = some_of(flanges);
  Eigen::Vector3d tool_m = nominal_m;
  for (const double scale_m : kScales_m)
    for (int step = 0; step < kSteps; ++step) tool_m = reweighted(some, nominal_m, tool_m, scale_m);
  return tool_m;
}

PlaceGroups group_places(const std::vector<Eigen::Vector3d>& places_m, const std::optional<double>& gap_m) {
  const std::vector<Merge> merges = Agglomeration(places_m).run();
  const double cut_m = gap_m ? *gap_m : widest_gap_m(merges);
  PlaceGroups groups;
  groups.nearest_apart_m = kNeverOne_m;
  std::vector<std::size_t> parents(places_m.size());
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  for (const Merge& merge : merges) {
    if (merge.apart_m > cut_m) {
      if (joins_groups(merge)) groups.nearest_apart_m = std::min(groups.nearest_apart_m, merge.apart_m);
      continue;
    }
    if (joins_groups(merge)) groups.widest_within_m = std::max(groups.widest_within_m, merge.apart_m);
    parents[root_of(parents, merge.second)] = root_of(parents, merge.first);
  }
  std::map<std::size_t, std::size_t> numbers;
  for (std::size_t place = 0; place < places_m.size(); ++place)
    groups.group_of.push_back(numbers.emplace(root_of(parents, place), numbers.size()).first->second);
  groups.groups = numbers.size();
  for (const Merge& merge : merges)
    if (merge.apart_m <= cut_m && may_be_two(merge))
      groups.doubtful.push_back({groups.group_of[merge.first], merge.first_size, merge.second_size, merge.apart_m});
  return groups;
}

}  // namespace demecal::inline preparation
