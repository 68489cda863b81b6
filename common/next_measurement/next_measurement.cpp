#include "next_measurement/next_measurement.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <numeric>
#include <ranges>
#include <utility>

#include "data/data_set.hpp"
#include "decompositions/decompositions.hpp"
#include "effects/law_terms.hpp"
#include "next_measurement/experiments.hpp"
#include "next_measurement/posterior_model.hpp"
#include "parameters/declared_model.hpp"
#include "pieces/pieces.hpp"
#include "prediction/corrected_robot.hpp"
#include "products/tall_products.hpp"
#include "residuals/residual_field.hpp"
#include "residuals/smooth_corrections.hpp"

namespace demecal::inline next_measurement {
namespace {

constexpr int kMostProposedPoses = 300;  // more nobody measures for one question
constexpr double kAboutEqual = 1.25;     ///< times the fewest stops
constexpr double kContained = 1e-6;      ///< of the signal's square may be left of a signal that a rival contains
constexpr double kPart = 1e-3;           ///< of the signal's square: coefficients that do less have no part in it
constexpr double kOwnBelief_rad = 1e-3;  ///< how large a correction's terms are, beyond the range it was identified in

using Columns = std::vector<Eigen::Index>;

/// Named and rivals over the poses at hand and over those of one experiment after another. Columns: the rivals', the
/// signal of the named effect, and, where a joint goes beyond its range, what its correction may be there.
class RivalComparison {
 public:
  RivalComparison(const DiagnosisProblem& problem, const DiagnosedModel& model, const Effect& named,
                  const std::vector<Rival>& rivals, RandomStream random)
      : declared_corrections_(problem.declared.joint_corrections),
        values_(Eigen::VectorXd::Map(named.values.data(), static_cast<Eigen::Index>(named.values.size()))),
        posterior_(problem, with(model, named), {named}, std::move(random)) {
    Eigen::Index column = 0;
    for (const Rival& rival : rivals) {
      effects_.push_back(rival.effect);
      Columns& columns = columns_.emplace_back();
      const auto count = law_of(rival.effect).coefficients(rival.effect, problem.data.robot).size();
      for (std::size_t i = 0; i < count; ++i) columns.push_back(column++);
    }
    effects_.push_back(named);
    signal_ = column;
    model_at_hand_ = posterior_.model_columns(posterior_.present());
    asked_at_hand_ = asked(posterior_.present());
    sums_ = Eigen::MatrixXd::Zero(signal_ + 1, signal_ + 1);
  }

  /// The named effect's separation by each of the experiments from each rival; see poses_needed().
  std::vector<Separation> separations(const std::vector<Experiment>& experiments) {
    std::vector<std::optional<Separation>> separated(experiments.size());
    std::vector<Eigen::MatrixXd> sums(experiments.size());
    in_pieces(experiments.size(), [&](std::size_t i) { separated[i] = separation(experiments[i], sums[i]); });
    std::vector<Separation> all;
    for (std::size_t i = 0; i < experiments.size(); ++i) {
      all.push_back(std::move(*separated[i]));
      sums_ += sums[i];
    }
    return all;
  }

  /// The rival's columns that stand against the signal, given all experiments so far: all of them, or those that have
  /// no part in the signal where the rival contains it; none where both are the same.
  Columns opposing_columns(std::size_t rival) const {
    const Columns& all = columns_[rival];
    const Eigen::MatrixXd gram = sums_(all, all);
    Eigen::VectorXd scale = gram.diagonal().cwiseSqrt();
    for (double& value : scale) value = value > 0 ? 1 / value : 0.0;
    const Eigen::VectorXd moment = scale.cwiseProduct(sums_(all, signal_));
    const Eigen::MatrixXd scaled = scale.asDiagonal() * gram * scale.asDiagonal();
    const Eigen::VectorXd imitation = least_norm_solution(scaled, moment);
    const double whole = sums_(signal_, signal_);
    if (whole - imitation.dot(moment) > kContained * whole) return all;
    Columns rest;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double part = imitation[static_cast<Eigen::Index>(i)];
      if (part * part < kPart * whole) rest.push_back(all[i]);
    }
    return rest;
  }

  /// None where `columns` is empty: nothing tells what is the same.
  std::optional<int> poses_needed(const Separation& separation, Columns columns) const {
    if (columns.empty()) return std::nullopt;
    for (Eigen::Index i = signal_ + 1; i < separation.columns(); ++i) columns.push_back(i);
    return separation.poses_needed(columns, signal_, kMostProposedPoses);
  }

 private:
  /// `sums`: what the experiment adds to sums_.
  Separation separation(const Experiment& experiment, Eigen::MatrixXd& sums) const {
    const DataSet data = posterior_.predicted(experiment.stops);
    const ResidualField next = posterior_.field(data);
    const SmoothCorrections beyond = terms_beyond(data, experiment.widened);
    const RowMatrix all_at_hand = beside(asked_at_hand_, beyond.columns(posterior_.present()));
    const AskedProducts at_hand = asked_products(model_at_hand_, all_at_hand, posterior_.weight());
    const double share = static_cast<double>(experiment.stops_per_pose) / static_cast<double>(data.poses.size());
    const RowMatrix model = posterior_.model_columns(next);
    const AskedProducts per_pose = asked_products(model, beside(asked(next), beyond.columns(next)), share);
    sums = (at_hand.asked + per_pose.asked).topLeftCorner(signal_ + 1, signal_ + 1);
    Eigen::VectorXd precision = Eigen::VectorXd::Zero(at_hand.asked.cols());
    precision.tail(precision.size() - signal_ - 1).setConstant(1.0 / (kOwnBelief_rad * kOwnBelief_rad));
    return {at_hand, per_pose, share * square_product(model), precision};
  }

  static DiagnosedModel with(DiagnosedModel model, const Effect& named) {
    const auto is_it = [&](const Effect& effect) { return effect.same_law_as(named); };
    if (std::ranges::none_of(model.robot.effects, is_it)) model.robot.effects.push_back(named);
    return model;
  }

  /// Terms of the joint's correction over the range it is widened to; none where it is not corrected.
  SmoothCorrections terms_beyond(const DataSet& data, int joint) const {
    std::vector<std::size_t> poses(data.poses.size());
    std::iota(poses.begin(), poses.end(), 0);
    SmoothCorrections terms =
        smooth_corrections(data, poses, posterior_.model().robot, declared_corrections_ && joint >= 0);
    std::erase_if(terms.terms, [&](const SmoothTerm& term) { return term.joint != joint; });
    return terms;
  }

  RowMatrix asked(const ResidualField& field) const {
    const RowMatrix effects = posterior_.effect_columns(effects_, field);
    return beside(effects.leftCols(signal_), effects.rightCols(values_.size()) * values_);
  }

  bool declared_corrections_;
  Eigen::VectorXd values_;
  PosteriorModel posterior_;
  std::vector<Effect> effects_;   ///< the rivals, then the named one
  std::vector<Columns> columns_;  ///< of each rival
  Eigen::Index signal_ = 0;
  RowMatrix model_at_hand_, asked_at_hand_;
  Eigen::MatrixXd sums_;  ///< products of rivals' and signal's columns over all that was looked at
};

/// What splits one rival off: an experiment, and how many poses of it.
struct ExperimentChoice {
  std::size_t experiment = 0;
  int poses = 0;
  int stops = 0;
};

/// One rival against every experiment.
struct RivalSeparation {
  std::vector<std::optional<int>> poses;  ///< by experiment
  std::optional<ExperimentChoice> best;
  bool same = false;  ///< as the named effect, whatever is measured
};

/// The simplest of those experiments that need about the fewest stops.
std::optional<ExperimentChoice> simplest_sufficient(const std::vector<Experiment>& all,
                                                    const std::vector<std::optional<int>>& poses) {
  std::vector<ExperimentChoice> choices;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (poses[i]) choices.push_back({i, *poses[i], all[i].stops_per_pose * *poses[i]});
  }
  if (choices.empty()) return std::nullopt;
  const double few = kAboutEqual * std::ranges::min(choices, {}, &ExperimentChoice::stops).stops;
  return *std::ranges::find_if(choices, [&](const ExperimentChoice& choice) { return choice.stops <= few; });
}

std::vector<RivalSeparation> separate(RivalComparison& comparison, const std::vector<Experiment>& all,
                                      std::size_t rivals) {
  const std::vector<Separation> separations = comparison.separations(all);
  std::vector<RivalSeparation> separated(rivals);
  for (std::size_t i = 0; i < rivals; ++i) {
    const Columns opposing_columns = comparison.opposing_columns(i);
    for (const Separation& separation : separations) {
      separated[i].poses.push_back(comparison.poses_needed(separation, opposing_columns));
    }
    separated[i].best = simplest_sufficient(all, separated[i].poses);
    separated[i].same = opposing_columns.empty();
  }
  return separated;
}

std::string enumerated(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 < names.size() ? ", " : " and ";
    text += names[i];
  }
  return text;
}

bool belongs_to_instrument(const Effect& effect) {
  return law_of(effect).subject() == Subject::instrument;
}

/// What is said of rivals that nothing splits off.
std::string inseparable(const Effect& effect, const std::vector<Rival>& rivals,
                        const std::vector<RivalSeparation>& separated) {
  const std::string named = to_string(effect);
  std::vector<std::string> same, near;
  bool is_seen_without_arm = false;
  for (std::size_t i = 0; i < rivals.size(); ++i) {
    if (separated[i].best) continue;
    (separated[i].same ? same : near).push_back(to_string(rivals[i].effect));
    is_seen_without_arm |= belongs_to_instrument(effect) != belongs_to_instrument(rivals[i].effect);
  }
  const std::string without_arm =
      is_seen_without_arm
          ? "; what is the instrument's shows without the arm, at a length that is known or a point that "
            "stands still"
          : "";
  std::string text;
  if (!same.empty()) text = named + " and " + enumerated(same) + " are the same thing for any measurement of this kind";
  if (near.empty()) return text + without_arm;
  if (!text.empty()) text += "; ";
  return text + "no practical measurement " + (is_seen_without_arm ? "of poses " : "") + "separates " + named +
         " of this size from " + enumerated(near) + without_arm;
}

std::string sentence(const Experiment& experiment, int poses, const std::string& named, const std::string& rivals) {
  return std::to_string(poses) + ' ' + experiment.before + (poses == 1 ? "pose" : "poses") + experiment.after +
         " would tell " + named + " from " + rivals + " (power 0.9)";
}

/// The rival that is hardest to tell; past the end where none can be told.
std::size_t hardest_rival(const std::vector<RivalSeparation>& separated) {
  std::size_t hardest = separated.size();
  for (std::size_t i = 0; i < separated.size(); ++i) {
    if (!separated[i].best) continue;
    if (hardest == separated.size() || separated[i].best->stops > separated[hardest].best->stops) hardest = i;
  }
  return hardest;
}

NextMeasurement describe(const std::vector<Experiment>& all, const Effect& named, const std::vector<Rival>& rivals,
                         const std::vector<RivalSeparation>& separated) {
  const std::string left = inseparable(named, rivals, separated);
  const std::size_t hardest = hardest_rival(separated);
  if (hardest == separated.size()) return {left, 0};
  const ExperimentChoice choice = *separated[hardest].best;
  std::vector<std::string> split{to_string(rivals[hardest].effect)};
  for (std::size_t i = 0; i < rivals.size(); ++i) {
    const std::optional<int> poses = separated[i].poses[choice.experiment];
    if (i != hardest && poses && *poses <= choice.poses) split.push_back(to_string(rivals[i].effect));
  }
  const std::string sentence_of_choice =
      sentence(all[choice.experiment], choice.poses, to_string(named), enumerated(split));
  return {left.empty() ? sentence_of_choice : sentence_of_choice + "; " + left, choice.poses};
}

}  // namespace

std::optional<NextMeasurement> find_next_measurement(const DiagnosisProblem& problem, const DiagnosedModel& model,
                                                     const Effect& named, const std::vector<Rival>& rivals,
                                                     RandomStream random) {
  const bool does_something = std::ranges::any_of(named.values, [](double value) { return value != 0.0; });
  if (rivals.empty() || problem.fitted.empty() || !does_something) return std::nullopt;
  std::vector<Effect> asked{named};
  for (const Rival& rival : rivals) asked.push_back(rival.effect);
  const std::vector<Experiment> all = experiments(problem, asked, random);
  RivalComparison comparison(problem, model, named, rivals, random);
  return describe(all, named, rivals, separate(comparison, all, rivals.size()));
}

}  // namespace demecal::inline next_measurement
