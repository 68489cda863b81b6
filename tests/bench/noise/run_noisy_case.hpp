// One case from its plan to its figures, by the way that `demecal diagnose` takes.
#pragma once

#include <optional>

#include "closed_loop/run_case.hpp"
#include "noise_case.hpp"
#include "trials/finding.hpp"

namespace demecal::bench {

/// What one diagnosis said, and how its model does where nothing but the arm errs.
struct DiagnosisFigures {
  bool refused = false;  ///< the check of the data calls them a contradiction; figures are those of --force
  bool failed = false;   ///< no model at all
  double first_p = 1.0;  ///< family-wise, of the first round; 1 where there was none
  double clean_before_mm = 0.0, clean_after_mm = 0.0;  ///< without and with the effects found, after the same last fit
  std::vector<Round> rounds{};
  NoiseModel noise{};             ///< as the loop tells it
  double independent_m = 0.0;     ///< standard deviation of positions beside it
  std::vector<Effect> effects{};  ///< of the model
  std::vector<NotFound> not_found{};
  int accept = 0, within = 0;  ///< accept poses, and those whose error is within the radius that is to hold 95 %
  double seconds = 0.0;        ///< of processor time
};

/// An effect that was put in, and what became of it.
struct InjectedEffect {
  double share_of_limit = 1.0;  ///< its size over the limit of detection that the arm without it was told
  Effect truth;
  bool named = false;             ///< the model has it
  std::optional<bool> covered{};  ///< whether the interval of its first coefficient holds the truth; none: not found
  DiagnosisFigures run;
};

struct NoisyCaseFigures {
  NoiseCase plan;
  std::string arm;
  DiagnosisFigures clean;  ///< of bad poses: with the good values in their place
  int false_effects = 0;   ///< of `clean`; a drift is none where the instrument drifts, nor the backlash of bad poses
  std::optional<DiagnosisFigures> bad{};
  std::optional<bool> bad_poses_named{};   ///< all, with the fault in any set
  std::vector<InjectedEffect> injected{};  ///< none: nothing of the case's kind is testable
};

/// A function of the case and the arms, but for the seconds.
NoisyCaseFigures run_noisy_case(const NoiseCase& one, const std::vector<Robot>& arms);

}  // namespace demecal::bench
