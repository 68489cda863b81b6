#include "diagnosis/further.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <numeric>

#include "diagnosis/experiments.hpp"
#include "diagnosis/knowledge.hpp"
#include "diagnosis/separation.hpp"
#include "effects/law_terms.hpp"

namespace demecal {
namespace {

constexpr int kMostProposedPoses = 9999;
constexpr double kAboutEqual = 1.25;     ///< times the fewest stops
constexpr double kContained = 1e-6;      ///< of the signal's square may be left of a signal that a rival contains
constexpr double kPart = 1e-3;           ///< of the signal's square: coefficients that do less have no part in it
constexpr double kOwnBelief_rad = 1e-3;  ///< how large a correction's terms are, beyond the range it was identified in

using Columns = std::vector<Eigen::Index>;

/// Named and rivals over the poses at hand and over those of one experiment after another. Columns: the rivals', the
/// signal of the named effect, and, where a joint goes beyond its range, what its correction may be there.
class Question {
 public:
  Question(const DiagnosisData& of, const DiagnosedModel& model, const Effect& named, const std::vector<Rival>& rivals,
           RandomStream random)
      : declared_corrections_(of.declared.joint_corrections),
        values_(Eigen::VectorXd::Map(named.values.data(), static_cast<Eigen::Index>(named.values.size()))),
        knowledge_(of, with(model, named), {named}, std::move(random)) {
    Eigen::Index column = 0;
    for (const Rival& rival : rivals) {
      effects_.push_back(rival.effect);
      Columns& columns = columns_.emplace_back();
      const auto count = law_of(rival.effect).coefficients(rival.effect, of.data.robot).size();
      for (std::size_t i = 0; i < count; ++i) columns.push_back(column++);
    }
    effects_.push_back(named);
    signal_ = column;
    model_at_hand_ = knowledge_.model_columns(knowledge_.present());
    asked_at_hand_ = asked(knowledge_.present());
    seen_ = Eigen::MatrixXd::Zero(signal_ + 1, signal_ + 1);
  }

  /// The named effect's separation by an experiment from each rival; see poses_needed().
  Separation separation(const Experiment& experiment) {
    const DataSet data = knowledge_.predicted(experiment.stops);
    const ResidualField further = knowledge_.field(data);
    const SmoothCorrections beyond = terms_beyond(data, experiment.widened);
    const RowMatrix all_at_hand = beside(asked_at_hand_, beyond.columns(knowledge_.present()));
    const Products at_hand = products(model_at_hand_, all_at_hand, knowledge_.weight());
    const double share = static_cast<double>(experiment.stops_per_pose) / static_cast<double>(data.poses.size());
    const Products per_pose =
        products(knowledge_.model_columns(further), beside(asked(further), beyond.columns(further)), share);
    seen_ += (at_hand.asked + per_pose.asked).topLeftCorner(signal_ + 1, signal_ + 1);
    Eigen::VectorXd precision = Eigen::VectorXd::Zero(at_hand.asked.cols());
    precision.tail(precision.size() - signal_ - 1).setConstant(1.0 / (kOwnBelief_rad * kOwnBelief_rad));
    return {at_hand, per_pose, precision};
  }

  /// The rival's columns that stand against the signal, given all experiments so far: all of them, or those that have
  /// no part in the signal where the rival contains it; none where both are the same.
  Columns against(std::size_t rival) const {
    const Columns& all = columns_[rival];
    const Eigen::MatrixXd gram = seen_(all, all);
    Eigen::VectorXd scale = gram.diagonal().cwiseSqrt();
    for (double& value : scale) value = value > 0 ? 1 / value : 0.0;
    const Eigen::VectorXd moment = scale.cwiseProduct(seen_(all, signal_));
    const Eigen::MatrixXd scaled = scale.asDiagonal() * gram * scale.asDiagonal();
    const Eigen::VectorXd imitation = scaled.completeOrthogonalDecomposition().solve(moment);
    const double whole = seen_(signal_, signal_);
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
        smooth_corrections(data, poses, knowledge_.model().robot, declared_corrections_ && joint >= 0);
    std::erase_if(terms.terms, [&](const SmoothTerm& term) { return term.joint != joint; });
    return terms;
  }

  RowMatrix asked(const ResidualField& field) const {
    const RowMatrix effects = knowledge_.effect_columns(effects_, field);
    return beside(effects.leftCols(signal_), effects.rightCols(values_.size()) * values_);
  }

  bool declared_corrections_;
  Eigen::VectorXd values_;
  Knowledge knowledge_;
  std::vector<Effect> effects_;   ///< the rivals, then the named one
  std::vector<Columns> columns_;  ///< of each rival
  Eigen::Index signal_ = 0;
  RowMatrix model_at_hand_, asked_at_hand_;
  Eigen::MatrixXd seen_;  ///< products of rivals' and signal's columns over all that was looked at
};

/// What splits one rival off: an experiment, and how many poses of it.
struct Choice {
  std::size_t experiment = 0;
  int poses = 0;
  int stops = 0;
};

/// One rival against every experiment.
struct Told {
  std::vector<std::optional<int>> poses;  ///< by experiment
  std::optional<Choice> best;
  bool same = false;  ///< as the named effect, whatever is measured
};

/// The simplest of those experiments that need about the fewest stops.
std::optional<Choice> choose(const std::vector<Experiment>& all, const std::vector<std::optional<int>>& poses) {
  std::vector<Choice> choices;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (poses[i]) choices.push_back({i, *poses[i], all[i].stops_per_pose * *poses[i]});
  }
  if (choices.empty()) return std::nullopt;
  const double few = kAboutEqual * std::ranges::min(choices, {}, &Choice::stops).stops;
  return *std::ranges::find_if(choices, [&](const Choice& choice) { return choice.stops <= few; });
}

std::vector<Told> tell(Question& question, const std::vector<Experiment>& all, std::size_t rivals) {
  std::vector<Separation> separations;
  for (const Experiment& experiment : all) separations.push_back(question.separation(experiment));
  std::vector<Told> told(rivals);
  for (std::size_t i = 0; i < rivals; ++i) {
    const Columns against = question.against(i);
    for (const Separation& separation : separations) {
      told[i].poses.push_back(question.poses_needed(separation, against));
    }
    told[i].best = choose(all, told[i].poses);
    told[i].same = against.empty();
  }
  return told;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 < names.size() ? ", " : " and ";
    text += names[i];
  }
  return text;
}

/// What is said of rivals that nothing splits off.
std::string inseparable(const std::string& named, const std::vector<Rival>& rivals, const std::vector<Told>& told) {
  std::vector<std::string> same, near;
  for (std::size_t i = 0; i < rivals.size(); ++i) {
    if (!told[i].best) (told[i].same ? same : near).push_back(words_for(rivals[i].effect));
  }
  std::string text;
  if (!same.empty()) text = named + " and " + listed(same) + " are the same thing for any measurement of this kind";
  if (near.empty()) return text;
  if (!text.empty()) text += "; ";
  return text + "no practical measurement separates " + named + " of this size from " + listed(near);
}

std::string sentence(const Experiment& experiment, int poses, const std::string& named, const std::string& rivals) {
  return std::to_string(poses) + ' ' + experiment.before + (poses == 1 ? "pose" : "poses") + experiment.after +
         " would tell " + named + " from " + rivals + " (power 0.9)";
}

/// The rival that is hardest to tell; past the end where none can be told.
std::size_t hardest_of(const std::vector<Told>& told) {
  std::size_t hardest = told.size();
  for (std::size_t i = 0; i < told.size(); ++i) {
    if (!told[i].best) continue;
    if (hardest == told.size() || told[i].best->stops > told[hardest].best->stops) hardest = i;
  }
  return hardest;
}

FurtherMeasurement conclude(const std::vector<Experiment>& all, const std::string& named,
                            const std::vector<Rival>& rivals, const std::vector<Told>& told) {
  const std::string left = inseparable(named, rivals, told);
  const std::size_t hardest = hardest_of(told);
  if (hardest == told.size()) return {left, 0};
  const Choice choice = *told[hardest].best;
  std::vector<std::string> split{words_for(rivals[hardest].effect)};
  for (std::size_t i = 0; i < rivals.size(); ++i) {
    const std::optional<int> poses = told[i].poses[choice.experiment];
    if (i != hardest && poses && *poses <= choice.poses) split.push_back(words_for(rivals[i].effect));
  }
  const std::string said = sentence(all[choice.experiment], choice.poses, named, listed(split));
  return {left.empty() ? said : said + "; " + left, choice.poses};
}

}  // namespace

std::string words_for(const Effect& effect) {
  std::string text = effect.kind;
  std::ranges::replace(text, '_', ' ');
  if (effect.joint >= 0) text += " of joint " + std::to_string(effect.joint + 1);
  std::vector<std::string> details;
  const std::vector<std::string> forms = law_of(effect).forms();
  if (!effect.form.empty() && effect.form != forms.front()) details.push_back(effect.form);
  for (const auto& [name, value] : effect.settings) {
    if (name == "from") details.push_back("from joint " + rounded_text(value));
    if (name == "ratio" || name == "order") details.push_back(name + ' ' + rounded_text(value));
    if (name == "gravity_turn") details.push_back("gravity turned " + rounded_text(value));
    if (name.starts_with("keep_")) details.push_back(name.substr(5));
  }
  for (std::size_t i = 0; i < details.size(); ++i) text += (i == 0 ? " (" : ", ") + details[i];
  return details.empty() ? text : text + ')';
}

std::optional<FurtherMeasurement> further_measurement(const DiagnosisData& of, const DiagnosedModel& model,
                                                      const Effect& named, const std::vector<Rival>& rivals,
                                                      RandomStream random) {
  const bool does_something = std::ranges::any_of(named.values, [](double value) { return value != 0.0; });
  if (rivals.empty() || of.fitted.empty() || !does_something) return std::nullopt;
  std::vector<Effect> asked{named};
  for (const Rival& rival : rivals) asked.push_back(rival.effect);
  const std::vector<Experiment> all = experiments(of, asked, random);
  Question question(of, model, named, rivals, random);
  return conclude(all, words_for(named), rivals, tell(question, all, rivals.size()));
}

}  // namespace demecal
