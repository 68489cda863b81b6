// One arm, measured or simulated, diagnosed with the search for explanations and without it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "explanations/error_budget.hpp"
#include "parameters/declared_model.hpp"

namespace demecal::bench {

/// What one diagnosis left.
struct EvolutionFigures {
  std::vector<FrontPoint> front;
  std::size_t causes = 0, effects = 0;          ///< of the chosen model
  double validation_mm = 0.0, accept_mm = 0.0;  ///< rms; validation while it was unseen
  std::size_t true_causes_named = 0;            ///< of a simulated arm
  std::vector<std::string> missed;              ///< true causes that are not named
  std::vector<std::string> false_effects;
  bool is_exact_but_for_class = false;  ///< nothing is missed or false but where these poses tell no difference
  double seconds = 0.0;

  /// The least error on the validation poses with at most so many causes.
  double validation_with(std::size_t causes) const;
};

struct EvolutionCase {
  std::string name;
  std::size_t true_causes = 0;  ///< undeclared ones of a simulated arm, one outside the catalogue among them or not
  bool outside = false;
  EvolutionFigures without, with;
};

EvolutionCase run_measured(const std::string& name, const DataSet& data, const DeclaredModel& declared,
                           std::uint64_t seed);

/// Simulated arm `number` (from 0) with three to six undeclared causes at once at two to four times the size that its
/// poses could show, the last of every other arm outside the catalogue. `robot` is the nominal one. Nothing where the
/// poses could show too few.
std::optional<EvolutionCase> run_simulated(int number, const Robot& robot);

}  // namespace demecal::bench
