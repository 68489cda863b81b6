#include <fmt/format.h>
#include <cstddef>
#include <map>
#include <set>
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

/// Measurements whose radii are wider for one kind of reason.
struct WidenedRows {
  std::map<std::string, Widened> all{};  ///< by joint or circumstance
  std::size_t rows = 0;

  void take(const WideningReason& reason) {
    Widened& one = all[reason.subject];
    ++one.rows;
    if (one.rows == 1 || reason.growth > one.worst.growth || reason.unstated_m > one.worst.unstated_m)
      one.worst = reason;
  }
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
  WidenedRows outside, unstated, unsure;
  for (const std::size_t row : rows) {
    const Widening there_by = widening_at(model, Stop(data.poses[row]));
    const bool flagged = is_outside_measured(model, Stop(data.poses[row]), there_by);
    std::set<WidenedRows*> concerned;
    for (const WideningReason& reason : there_by.reasons) {
      const bool is_outside = reason.growth > 0.0;
      if (is_outside && !flagged) continue;
      WidenedRows& kind = is_outside ? outside : reason.unstated_m > 0.0 ? unstated : unsure;
      kind.take(reason);
      concerned.insert(&kind);
    }
    if (flagged && concerned.empty()) concerned.insert(&outside);
    for (WidenedRows* kind : concerned) ++kind->rows;
  }
  std::vector<std::string> sentences;
  const auto say = [&](const WidenedRows& kind, const std::string& of_one, const std::string& of_many) {
    if (kind.rows > 0)
      sentences.push_back(fmt::format("{} of the {} measurements {}: {}.", kind.rows, rows.size(),
                                      kind.rows == 1 ? of_one : of_many, listed(kind.all)));
  };
  const std::string where = "outside of what the model was measured at";
  say(outside, "lies " + where + ", and its radius is widened by judgement",
      "lie " + where + ", and their radii are widened by judgement");
  const std::string what = "not state what the model's errors depend on";
  say(unstated, "does " + what + ", and its radius holds whatever was measured",
      "do " + what + ", and their radii hold whatever was measured");
  const std::string close = "so close to a jump that it may be on either side";
  say(unsure, "is " + close + ", and its radius holds both", "are " + close + ", and their radii hold both");
  return sentences;
}

}  // namespace demecal::inline report
