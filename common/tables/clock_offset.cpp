// An unknown offset between two clocks, from what the instrument measured and the arm's joints say of it.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "data/csv.hpp"
#include "data/text.hpp"
#include "decompositions/decompositions.hpp"
#include "errors/input_error.hpp"
#include "kinematics/angles.hpp"
#include "tables/join.hpp"

namespace demecal::inline tables {
namespace {

constexpr std::size_t kMostTried = 40000;
constexpr std::size_t kMostFitted = 6000;  ///< offsets for which base and tool are fitted
constexpr std::size_t kFewestFitted = 6;   ///< poses, below which base and tool suit most joints
constexpr double kOtherPose_m = 0.005;     ///< apart by more, two rows are of different poses
constexpr double kClearly = 2.0;           ///< a rival must fit so many times worse
constexpr double kFits_m = 0.05;           ///< nominal arm and measurement agree to this, or nothing fits
constexpr double kToolSuits_m = 0.01;      ///< above which another tool is tried
constexpr double kFitsFitted_m = 0.02;     ///< as kFits_m, where base and tool are fitted
constexpr int kFitSteps = 8;

struct OffsetTrial {
  double offset_s = 0.0;
  double misfit_m = std::numeric_limits<double>::infinity();  ///< root mean square over rows, or pairs of rows
  Eigen::Vector3d tool_m = Eigen::Vector3d::Zero();           ///< by which it is that
};

/// The measured points by base and tool of least squares from the flanges, Gauss-Newton steps from the registration
/// with the tool given.
OffsetTrial fitted_tool(double offset_s, const std::vector<Eigen::Vector3d>& measured,
                        const std::vector<Eigen::Isometry3d>& flanges, const Eigen::Vector3d& tool_m) {
  const auto n = static_cast<Eigen::Index>(measured.size());
  Eigen::Matrix3Xd from(3, n), to(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    from.col(i) = flanges[static_cast<std::size_t>(i)] * tool_m;
    to.col(i) = measured[static_cast<std::size_t>(i)];
  }
  Eigen::Isometry3d base = rigid_motion(from, to);
  OffsetTrial best{offset_s};
  Eigen::Vector3d tool = tool_m;
  for (int step = 0; step <= kFitSteps; ++step) {
    Eigen::Matrix<double, 9, 9> information = Eigen::Matrix<double, 9, 9>::Identity() * 1e-9;
    Eigen::Matrix<double, 9, 1> gradient = Eigen::Matrix<double, 9, 1>::Zero();
    double squares = 0.0;
    for (std::size_t i = 0; i < measured.size(); ++i) {
      const Eigen::Vector3d lever = base.linear() * (flanges[i] * tool);
      const Eigen::Vector3d error = measured[i] - base.translation() - lever;
      Eigen::Matrix<double, 3, 9> slopes;
      slopes << Eigen::Matrix3d::Identity(), -cross_matrix(lever), base.linear() * flanges[i].linear();
      information.noalias() += slopes.transpose() * slopes;
      gradient.noalias() += slopes.transpose() * error;
      squares += error.squaredNorm();
    }
    const double misfit_m = std::sqrt(squares / static_cast<double>(n));
    const bool settled = misfit_m > 0.999 * best.misfit_m;
    if (misfit_m < best.misfit_m) best = {offset_s, misfit_m, tool};
    if (settled) break;
    const Eigen::Matrix<double, 9, 1> change = PivotedCholesky(information).solve(gradient);
    base.translation() += change.head<3>();
    base.linear() = rotation_of(change.segment<3>(3)) * base.linear();
    tool += change.tail<3>();
  }
  return best;
}

/// Offsets tried against the other table's rows, in the order of time.
class OffsetSearch {
 public:
  OffsetSearch(const JoinKeys& lead, const JoinKeys& other, const JoinPoints& points, double within_s)
      : lead_(lead), points_(points), within_s_(within_s) {
    for (std::size_t row = 0; row < other.times_s.size(); ++row) order_.push_back({other.times_s[row], row});
    std::ranges::stable_sort(order_, {}, &Stamped::time_s);
    for (const Eigen::Isometry3d& flange : points.flanges) predicted_m_.push_back(flange * points.tool_m);
  }

  /// Every row of the leading table on a row of the other.
  std::vector<double> candidates() const {
    std::vector<double> offsets;
    const std::size_t rows = lead_.times_s.size();
    const std::size_t stride = std::max<std::size_t>(1, order_.size() / kMostTried + 1);
    for (const std::size_t row : {std::size_t{0}, rows / 2, rows - 1}) {
      for (std::size_t i = 0; i < order_.size(); i += stride) offsets.push_back(lead_.times_s[row] - order_[i].time_s);
    }
    std::ranges::sort(offsets);
    return offsets;
  }

  OffsetTrial at(double offset_s) const {
    const auto rows = rows_at(offset_s);
    if (!rows) return {offset_s};
    double squares = 0.0;
    std::size_t pairs = 0;
    for (const std::size_t step : {std::size_t{1}, std::size_t{2}}) {
      for (std::size_t i = 0; i + step < rows->size(); ++i, ++pairs) {
        const double measured = (points_.measured_m[i + step] - points_.measured_m[i]).norm();
        const double predicted = (predicted_m_[(*rows)[i + step]] - predicted_m_[(*rows)[i]]).norm();
        squares += std::pow(measured - predicted, 2);
      }
    }
    return {offset_s, std::sqrt(squares / static_cast<double>(std::max<std::size_t>(pairs, 1))), points_.tool_m};
  }

  /// The same with base and tool fitted.
  OffsetTrial fitted_at(double offset_s) const {
    const auto rows = rows_at(offset_s);
    if (!rows) return {offset_s};
    std::vector<Eigen::Isometry3d> flanges;
    for (const std::size_t row : *rows) flanges.push_back(points_.flanges[row]);
    return fitted_tool(offset_s, points_.measured_m, flanges, points_.tool_m);
  }

  /// Whether the two offsets give some row the joints of different poses.
  bool differ(double a_s, double b_s) const {
    for (const double time_s : lead_.times_s) {
      const auto a = nearest(time_s - a_s), b = nearest(time_s - b_s);
      if (!a || !b || (predicted_m_[*a] - predicted_m_[*b]).norm() > kOtherPose_m) return true;
    }
    return false;
  }

 private:
  struct Stamped {
    double time_s;
    std::size_t row;
  };

  /// Each leading row's partner; nothing where one has none.
  std::optional<std::vector<std::size_t>> rows_at(double offset_s) const {
    std::vector<std::size_t> rows;
    for (const double time_s : lead_.times_s) {
      const auto row = nearest(time_s - offset_s);
      if (!row) return std::nullopt;
      rows.push_back(*row);
    }
    return rows;
  }

  std::optional<std::size_t> nearest(double time_s) const {
    const auto after = std::ranges::lower_bound(order_, time_s, {}, &Stamped::time_s);
    const Stamped* found = after == order_.end() ? nullptr : &*after;
    if (after != order_.begin()) {
      const Stamped& before = *(after - 1);
      if (found == nullptr || time_s - before.time_s <= found->time_s - time_s) found = &before;
    }
    if (found == nullptr || std::abs(found->time_s - time_s) > within_s_) return std::nullopt;
    return found->row;
  }

  const JoinKeys& lead_;
  const JoinPoints& points_;
  double within_s_;
  std::vector<Stamped> order_;
  std::vector<Eigen::Vector3d> predicted_m_;
};

std::size_t best_of(const std::vector<OffsetTrial>& trials) {
  return static_cast<std::size_t>(std::ranges::min_element(trials, {}, &OffsetTrial::misfit_m) - trials.begin());
}

/// Base and tool fitted for offsets spread over all, and for each between the neighbours of the best.
std::vector<OffsetTrial> with_tool_fitted(const OffsetSearch& search, const std::vector<double>& offsets) {
  const std::size_t stride = offsets.size() / kMostFitted + 1;
  std::vector<OffsetTrial> rough;
  for (std::size_t i = 0; i < offsets.size(); i += stride) rough.push_back(search.fitted_at(offsets[i]));
  if (stride == 1) return rough;
  const std::size_t best = stride * best_of(rough);
  std::vector<OffsetTrial> trials;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const bool near = i + stride > best && i < best + stride;
    if (near || i % stride == 0) trials.push_back(near ? search.fitted_at(offsets[i]) : rough[i / stride]);
  }
  return trials;
}

/// The middle of the offsets around the best that fit as well: the arm stands for a while.
double middle_of_plateau(const std::vector<OffsetTrial>& trials, std::size_t best) {
  const double limit_m = 1.05 * trials[best].misfit_m + 1e-6;
  std::size_t first = best, last = best;
  while (first > 0 && trials[first - 1].misfit_m <= limit_m) --first;
  while (last + 1 < trials.size() && trials[last + 1].misfit_m <= limit_m) ++last;
  return trials[first + (last - first) / 2].offset_s;
}

std::string milliseconds_text(double seconds) {
  return number_text(std::round(1e3 * seconds) / 1e3) + " s";
}

}  // namespace

ClockOffset find_offset(const CsvTable& lead, const JoinKeys& lead_keys, const CsvTable& other,
                        const JoinKeys& other_keys, const JoinPoints& points, double within_s) {
  const OffsetSearch search(lead_keys, other_keys, points, within_s);
  const std::vector<double> offsets = search.candidates();
  std::vector<OffsetTrial> trials;
  for (const double offset_s : offsets) trials.push_back(search.at(offset_s));
  OffsetTrial best = trials[best_of(trials)];
  bool fitted = false;
  if (std::isfinite(best.misfit_m) && best.misfit_m > kToolSuits_m && points.measured_m.size() >= kFewestFitted) {
    std::vector<OffsetTrial> others = with_tool_fitted(search, offsets);
    const OffsetTrial other_best = others[best_of(others)];
    fitted = other_best.misfit_m < std::min(kFitsFitted_m, best.misfit_m / kClearly);
    if (fitted) best = other_best, trials = std::move(others);
  }
  if (best.misfit_m > kFits_m) {
    throw InputError(
        {lead.file, 0}, "",
        "fits " + other.file + " at no offset of the clocks: " +
            (std::isfinite(best.misfit_m) ? "distances between points differ from the arm's by " +
                                                number_text(std::round(1e3 * best.misfit_m)) + " mm at best"
                                          : "no offset gives every row a partner within `within_s`") +
            ". Are the files of one measurement, and units and joints right? Else give `offset_s` as a number");
  }
  ClockOffset found{.misfit_m = best.misfit_m};
  if (fitted) found.tool_m = best.tool_m;
  for (const OffsetTrial& rival : trials) {
    if (rival.misfit_m > found.rival_m || !search.differ(best.offset_s, rival.offset_s)) continue;
    found.rival_m = rival.misfit_m;
    if (rival.misfit_m > kClearly * best.misfit_m + 1e-6) continue;
    throw InputError({lead.file, 0}, "",
                     "may be " + milliseconds_text(best.offset_s) + " or " + milliseconds_text(rival.offset_s) +
                         " after " + other.file + ": both fit alike. Give `offset_s` under `join` as a number");
  }
  found.offset_s = middle_of_plateau(trials, best_of(trials));
  return found;
}

}  // namespace demecal::inline tables
