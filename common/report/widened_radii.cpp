#include <fmt/format.h>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "data/data_set.hpp"
#include "effects/arm_state.hpp"
#include "parameters/widening.hpp"
#include "report/evaluation.hpp"

namespace demecal::inline report {
namespace {

/// Of one joint or circumstance: at how many measurements, and the one that is worst.
struct Widened {
  std::size_t rows = 0;
  WideningReason worst{};
};

std::string listed(const std::map<std::string, Widened>& all) {
  std::string text;
  for (const auto& [subject, one] : all)
    text += fmt::format("{}{}{}", text.empty() ? "" : "; ", one.worst.sentence,
                        one.rows > 1 ? fmt::format(" ({} measurements, this one the farthest)", one.rows) : "");
  return text;
}

}  // namespace

std::vector<std::string> widened_sentences(const CalibratedModel& model, const DataSet& data,
                                           std::span<const std::size_t> rows) {
  std::map<std::string, Widened> outside, unstated;
  std::size_t rows_outside = 0, rows_unstated = 0;
  for (const std::size_t row : rows) {
    const Widening there_by = widening_at(model, Stop(data.poses[row]));
    const bool flagged = is_outside_measured(model, Stop(data.poses[row]), there_by);
    rows_outside += flagged ? 1 : 0;
    bool states_all = true;
    for (const WideningReason& reason : there_by.reasons) {
      const bool is_outside = reason.growth > 0.0;
      states_all &= is_outside;
      if (is_outside && !flagged) continue;
      Widened& one = (is_outside ? outside : unstated)[reason.subject];
      ++one.rows;
      if (one.rows == 1 || reason.growth > one.worst.growth || reason.unstated_m > one.worst.unstated_m)
        one.worst = reason;
    }
    rows_unstated += states_all ? 0 : 1;
  }
  std::vector<std::string> sentences;
  if (rows_outside > 0)
    sentences.push_back(
        fmt::format("{} of the {} measurements {} outside of what the model was measured at, and {} "
                    "widened by judgement: {}.",
                    rows_outside, rows.size(), rows_outside == 1 ? "lies" : "lie",
                    rows_outside == 1 ? "its radius is" : "their radii are", listed(outside)));
  if (rows_unstated > 0)
    sentences.push_back(
        fmt::format("{} of the {} measurements {} not state what the model's errors depend on, and {} "
                    "whatever was measured: {}.",
                    rows_unstated, rows.size(), rows_unstated == 1 ? "does" : "do",
                    rows_unstated == 1 ? "its radius holds" : "their radii hold", listed(unstated)));
  return sentences;
}

}  // namespace demecal::inline report
