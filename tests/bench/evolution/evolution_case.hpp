// One arm, measured or simulated, diagnosed with the search for explanations and without it.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "explanations/error_budget.hpp"
#include "parameters/declared_model.hpp"

namespace demecal::bench {

/// What the joint corrections of a model are made of.
struct CorrectionFigures {
  std::size_t joints = 0;      ///< that are corrected
  std::size_t most_nodes = 0;  ///< of one joint, at full precision
  std::size_t shortened = 0;   ///< joints of which the report has a short form
  /// rms error of the accept poses with short forms in their corrections' place, over that with the corrections.
  double accept_with_short_forms = 1.0;
  double least_term_rad = HUGE_VAL;  ///< of all terms' largest values over their joints' ranges
  /// 1: three times what a joint does, as most poses tell of it beside the model without corrections.
  double most_bound_over_limit = 0.0;
};

/// What one diagnosis left.
struct EvolutionFigures {
  std::vector<FrontPoint> front;
  /// Of the first causes that the loop added, fitted anew: rms error of the same validation poses by their number, from
  /// none; without evolution only.
  std::vector<double> validation_of_first_mm;
  std::size_t causes = 0, effects = 0;          ///< of the chosen model
  double validation_mm = 0.0, accept_mm = 0.0;  ///< rms; validation while it was unseen
  double fitted_mm = 0.0;                       ///< rms, of the poses of the last fit
  std::size_t true_causes_named = 0;            ///< of a simulated arm
  bool outside_named = false;                   ///< the one outside the catalogue
  std::vector<std::string> missed;              ///< true causes that are not named
  std::vector<std::string> false_effects;
  bool is_exact_but_for_class = false;  ///< nothing is missed or false but where these poses tell no difference
  double seconds = 0.0;
  CorrectionFigures corrections;

  /// The least error on the validation poses with at most so many causes.
  double validation_with(std::size_t causes) const;
  /// The same of the causes that the loop added first.
  double validation_with_first(std::size_t causes) const;
};

struct EvolutionCase {
  std::string name;
  std::uint64_t seed = 0;
  std::size_t true_causes = 0;  ///< undeclared ones of a simulated arm, one outside the catalogue among them or not
  bool outside = false;
  EvolutionFigures without, with;
  /// Of the model of all that was hidden in a simulated arm and nothing else, after the last fit.
  double fitted_of_truth_mm = 0.0, accept_of_truth_mm = 0.0;
};

/// How many undeclared causes a simulated arm has, and whether the first of them is outside the catalogue.
struct Mixture {
  std::size_t causes = 0;
  bool outside = false;
};
/// Three to six causes in turn, every other arm with one outside the catalogue.
Mixture varied_mixture(int number);

EvolutionCase run_measured(const std::string& name, const DataSet& data, const DeclaredModel& declared,
                           std::uint64_t seed);

/// Simulated arm `number` (from 0) with undeclared causes at once at two to four times the size that its poses could
/// show. `robot` is the nominal one. Nothing where the poses could show too few.
std::optional<EvolutionCase> run_simulated(int number, const Mixture& mixture, const Robot& robot);

}  // namespace demecal::bench
