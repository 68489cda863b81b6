// Which effect a case gets, and how large: by what these poses could show, never by what the loop finds.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "case_plan.hpp"
#include "diagnosis/outcome.hpp"
#include "random/random_stream.hpp"
#include "residuals/diagnosed_model.hpp"

namespace demecal::bench {

/// How small an effect the poses of a case could show: the loop's own word for it, applied to the effect's own
/// direction.
class DetectionLimit {
 public:
  /// Of the model that the loop ended with on the poses of `problem`; both must outlive it.
  DetectionLimit(const DiagnosisProblem& problem, const DiagnosedModel& model);

  /// By how much `effect` (with coefficients) must be multiplied to be just detectable. `measure` says how long the
  /// coefficients of its kind must be, and so how much of the residual must be explained; the effect explains it where
  /// it explains as much. Infinite where the model explains the effect wholly.
  double detectable(const NotFound& measure, const Effect& effect) const;

 private:
  const DiagnosisProblem& problem_;
  Linearization linearization_;
};

/// By how much an effect must be multiplied to be just detectable, where that kind and joint are detectable as named.
using JustDetectable = std::function<double(const NotFound&, const Effect&)>;

/// How large effects are drawn, in multiples of what is just detectable.
struct SizeRange {
  double least = 2.0;
  double most = 4.0;
};

/// An effect of `kind` at a random joint of those at which `detectable` names it: coefficients in a random direction,
/// of a random size in `sizes`. Ratios are whole numbers from 10 to 160; other
/// joints, orders and forms are drawn; formulas are measured by the couplings of their joint. Joints that would go more
/// than 10 mrad (10 mm) astray at any of `states` are passed over: no arm does. Nothing where no joint is left.
std::optional<Effect> draw_truth(const std::string& kind, const std::vector<NotFound>& detectable, const Robot& robot,
                                 const std::vector<ArmState>& states, const JustDetectable& just, RandomStream& random,
                                 const SizeRange& sizes = {});

/// The effects of a case: one, or two of different kinds for pairs; fewer where nothing could be drawn.
std::vector<Effect> draw_truths(const std::string& kind, const std::vector<NotFound>& detectable, const Robot& robot,
                                const std::vector<ArmState>& states, const JustDetectable& just, RandomStream& random);

}  // namespace demecal::bench
