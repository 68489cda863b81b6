// An unknown offset between two clocks, from what the instrument measured and the arm's joints say of it.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "tables/join.hpp"

namespace demecal::inline tables {
namespace {

constexpr std::size_t kMostTried = 40000;
constexpr double kOtherPose_m = 0.005;  ///< apart by more, two rows are of different poses
constexpr double kClearly = 2.0;        ///< a rival must fit so many times worse
constexpr double kFits_m = 0.05;        ///< nominal arm and measurement agree to this, or nothing fits

struct OffsetTrial {
  double offset_s = 0.0;
  double misfit_m = std::numeric_limits<double>::infinity();  ///< root mean square over pairs of rows
};

/// Offsets tried against the other table's rows, in the order of time.
class OffsetSearch {
 public:
  OffsetSearch(const JoinKeys& lead, const JoinKeys& other, const JoinPoints& points, double within_s)
      : lead_(lead), points_(points), within_s_(within_s) {
    for (std::size_t row = 0; row < other.times_s.size(); ++row) order_.push_back({other.times_s[row], row});
    std::ranges::stable_sort(order_, {}, &Stamped::time_s);
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
    std::vector<std::size_t> rows;
    for (const double time_s : lead_.times_s) {
      const auto row = nearest(time_s - offset_s);
      if (!row) return {offset_s};
      rows.push_back(*row);
    }
    double squares = 0.0;
    std::size_t pairs = 0;
    for (const std::size_t step : {std::size_t{1}, std::size_t{2}}) {
      for (std::size_t i = 0; i + step < rows.size(); ++i, ++pairs) {
        const double measured = (points_.measured_m[i + step] - points_.measured_m[i]).norm();
        const double predicted = (points_.predicted_m[rows[i + step]] - points_.predicted_m[rows[i]]).norm();
        squares += std::pow(measured - predicted, 2);
      }
    }
    return {offset_s, std::sqrt(squares / static_cast<double>(std::max<std::size_t>(pairs, 1)))};
  }

  /// Whether the two offsets give some row the joints of different poses.
  bool differ(double a_s, double b_s) const {
    for (const double time_s : lead_.times_s) {
      const auto a = nearest(time_s - a_s), b = nearest(time_s - b_s);
      if (!a || !b || (points_.predicted_m[*a] - points_.predicted_m[*b]).norm() > kOtherPose_m) return true;
    }
    return false;
  }

 private:
  struct Stamped {
    double time_s;
    std::size_t row;
  };

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
};

/// The middle of the offsets around the best that fit as well: the arm stands for a while.
double middle_of_plateau(const std::vector<OffsetTrial>& trials, std::size_t best) {
  const double limit_m = 1.05 * trials[best].misfit_m + 1e-6;
  std::size_t first = best, last = best;
  while (first > 0 && trials[first - 1].misfit_m <= limit_m) --first;
  while (last + 1 < trials.size() && trials[last + 1].misfit_m <= limit_m) ++last;
  return trials[first + (last - first) / 2].offset_s;
}

}  // namespace

double find_offset_s(const CsvTable& lead, const JoinKeys& lead_keys, const CsvTable& other, const JoinKeys& other_keys,
                     const JoinPoints& points, double within_s) {
  const OffsetSearch search(lead_keys, other_keys, points, within_s);
  std::vector<OffsetTrial> trials;
  for (const double offset_s : search.candidates()) trials.push_back(search.at(offset_s));
  const auto best = std::ranges::min_element(trials, {}, &OffsetTrial::misfit_m);
  if (best->misfit_m > kFits_m) {
    throw InputError(
        {lead.file, 0}, "",
        "fits " + other.file + " at no offset of the clocks: " +
            (std::isfinite(best->misfit_m) ? "distances between points differ from the arm's by " +
                                                 number_text(std::round(1e3 * best->misfit_m)) + " mm at best"
                                           : "no offset gives every row a partner within `within_s`") +
            ". Are the files of one measurement, and units and joints right? Else give `offset_s` as a number");
  }
  for (const OffsetTrial& rival : trials) {
    if (rival.misfit_m > kClearly * best->misfit_m + 1e-6 || !search.differ(best->offset_s, rival.offset_s)) continue;
    throw InputError({lead.file, 0}, "",
                     "may be " + number_text(std::round(1e3 * best->offset_s) / 1e3) + " s or " +
                         number_text(std::round(1e3 * rival.offset_s) / 1e3) + " s after " + other.file +
                         ": both fit alike. Give `offset_s` under `join` as a number");
  }
  return middle_of_plateau(trials, static_cast<std::size_t>(best - trials.begin()));
}

}  // namespace demecal::inline tables
