// How small an effect the poses of a case could show: the loop's own word for it, applied to the effect's own
// direction.
#pragma once

#include "diagnosis/outcome.hpp"
#include "residuals/diagnosed_model.hpp"

namespace demecal::bench {

class Sight {
 public:
  /// Of the model that the loop ended with on the poses of `of`; both must outlive it.
  Sight(const DiagnosisProblem& of, const DiagnosedModel& model);

  /// By how much `effect` (with coefficients) must be multiplied to be just detectable. `measure` says how long the
  /// coefficients of its kind must be, and so how much of the residual must be explained; the effect explains it where
  /// it explains as much. Infinite where the model explains the effect wholly.
  double detectable(const NotFound& measure, const Effect& effect) const;

 private:
  const DiagnosisProblem& of_;
  Linearization at_;
};

}  // namespace demecal::bench
