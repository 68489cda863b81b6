// One group of rounds: effects added one after another to one linearized model, until noise alone could do as much.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/candidates.hpp"
#include "diagnosis/judgement.hpp"
#include "diagnosis/outcome.hpp"
#include "diagnosis/scan.hpp"
#include "effects/effect.hpp"
#include "next_measurement/next_measurement.hpp"
#include "random/random_purpose.hpp"
#include "random/random_stream.hpp"
#include "residuals/diagnosed_model.hpp"
#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal::inline diagnosis {

/// What the evaluation of a candidate takes.
struct GroupRules {
  double family_error = 0.05;
  int null_draws = 999;
  int resamples = 400;
  int most = 12;  ///< effects in one group
  std::uint64_t seed = 1;
  int group = 1;
  int first_round = 1;  ///< number of the group's first round
  double p_structure = 1.0;
  std::vector<double> evolved_null_gains{};  ///< of LoopOptions
  DoWork do_work = demecal::do_work;
};

/// The share of a null distribution (ascending), the found value counted among it, that explains as much.
double family_p_value(const std::vector<double>& null_maxima, double gain_nats);

struct GroupOutcome {
  std::vector<Round> rounds;
  std::vector<Effect> added;                 ///< as the rounds' verdicts say
  std::optional<std::string> winning_decoy;  ///< its name, where one explained more than any real effect
  bool stopped = false;                      ///< by the watcher
  bool not_significant = false;              ///< noise alone explains as much as the best candidate left
};

/// The share by which the effects that were added lower the mean error on the validation poses; NaN: there are none.
double validation_gain(const GroupOutcome& outcome);

class Group {
 public:
  /// `columns` are the candidates'; `excluded` marks those not to be tried; `null_maxima` is the latest null
  /// distribution, renewed where the best candidate is not far beyond it.
  Group(const DiagnosisProblem& problem, const DiagnosedModel& model, const Linearization& linearization,
        const std::vector<Candidate>& candidates, const EffectColumns& columns, std::vector<bool> excluded,
        std::vector<double>& null_maxima, const GroupRules& rules);

  /// Tries candidates, the best first. One is added that noise alone explains too rarely, that shortens the
  /// description, whose sign is stable and whose size is physical, and that lowers the validation error; added ones
  /// stay up to the last that the validation poses confirm.
  GroupOutcome run(const std::function<bool(const Round&)>& watch);
  /// Brings what is known of the decoys, in candidates' order, up to date with what run() gave: the description length
  /// that the best form of each gained at most, and how often noise alone explains as much as it does beside what was
  /// added.
  void record_decoys(const GroupOutcome& outcome, std::vector<Decoy>& decoys) const;

 private:
  /// A candidate beside the model, and all candidates' columns^T the ones that it would add.
  struct Tried {
    std::size_t candidate;
    Projection::Trial trial;
    Eigen::MatrixXd products;
  };
  const Tried& tried(std::size_t index);
  std::optional<std::size_t> best_candidate();
  std::vector<Rival> rivals(std::size_t index);
  std::size_t named_equivalent(std::size_t formula);
  std::size_t simplest_equivalent(std::size_t index);
  bool found_by_search(std::size_t index) const;
  void update_null_maxima(std::size_t index);
  Round evaluate(std::size_t index);
  Confirmation confirmation_of(const Eigen::VectorXd& before, const Eigen::VectorXd& after,
                               RandomPurpose purpose) const;
  std::string rejection_reason(const Round& round, const Projection::Trial& trial) const;
  void add(Round round, const Tried& chosen);
  void exclude_equivalents(const Round& round);
  void drop_unconfirmed();
  RandomStream random(RandomPurpose purpose) const;
  std::vector<double> decoy_p_values() const;

  const DiagnosisProblem& problem_;
  const DiagnosedModel& model_;
  const Linearization& linearization_;
  const std::vector<Candidate>& candidates_;
  const EffectColumns& columns_;
  std::vector<bool> excluded_;
  std::vector<double>& null_maxima_;
  GroupRules rules_;
  Projection projection_;
  Scan scan_;
  std::vector<Score> scores_;
  std::optional<Tried> tried_;          ///< the latest, beside the present model
  Eigen::VectorXd confirmed_residual_;  ///< of the validation rows with what they confirmed so far
  std::size_t confirmed_rounds_ = 0;    ///< rounds up to which they did
  std::vector<double> decoy_gains_;
  GroupOutcome outcome_;
};

}  // namespace demecal::inline diagnosis
