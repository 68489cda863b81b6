#include "calibration/chosen_together.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "calibration/admissible.hpp"
#include "calibration/training.hpp"
#include "evolution/model_archive.hpp"
#include "expression/bound.hpp"
#include "expression/tree.hpp"
#include "kinematics/chain.hpp"
#include "prediction/corrected_robot.hpp"
#include "primitives/primitive.hpp"
#include "residuals/diagnosed_model.hpp"
#include "residuals/projection.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline calibration {
namespace {

constexpr double kLargestFactor = 10.0;
constexpr double kHold = 1e-3;         ///< of what the poses weigh: factors that they do not tell stay near 1
constexpr double kMostProducts = 1e9;  ///< of candidates, each with each, over all rows
constexpr double kSureErrors = 2.0;    ///< standard errors of the gain
constexpr double kFactorDigits = 3.0;  ///< that formulas show
constexpr double kLeastGainNats = 1e-6;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A candidate of one joint.
struct Offer {
  std::size_t list = 0;  ///< of candidates
  JointCorrection correction;
  double price_nats = 0.0;
  double bound_rad = 0.0;
};

using Places = std::vector<std::size_t>;  ///< of offers, at most one a joint

struct ChosenSet {
  Places places{};
  Eigen::VectorXd factors{};
  double nats = kInfinite;
};

/// What the declared numbers leave of the residual and of the offers' columns, over a list of poses (and beyond).
struct RowsLeft {
  RowMatrix columns;
  Eigen::VectorXd residual;
  Eigen::MatrixXd products{};  ///< of the columns, each with each
  Eigen::VectorXd moments{};   ///< of the columns with the residual

  void multiply() {
    products = columns.transpose() * columns;
    moments = columns.transpose() * residual;
  }
  double square(const ChosenSet& set) const {
    if (set.places.empty()) return residual.squaredNorm();
    const Eigen::VectorXd along = products(set.places, set.places) * set.factors - 2.0 * moments(set.places);
    return residual.squaredNorm() + set.factors.dot(along);
  }
  /// Pose by pose.
  SquaredErrors errors(const ResidualField& field, const ChosenSet& set) const {
    Eigen::VectorXd left = residual;
    for (std::size_t i = 0; i < set.places.size(); ++i)
      left -= set.factors[static_cast<Eigen::Index>(i)] * columns.col(static_cast<Eigen::Index>(set.places[i]));
    SquaredErrors squares;
    for (std::size_t pose = 0; pose < field.poses.size(); ++pose)
      squares.push_back(left.segment(field.first_row[pose], field.rows_of_pose(pose)).squaredNorm());
    return squares;
  }
};

/// A power of ten divides exactly, so that the number prints with as few digits.
double rounded(double factor) {
  const double power = std::pow(10.0, kFactorDigits - 1.0 - std::floor(std::log10(std::abs(factor))));
  return std::round(factor * power) / power;
}

/// So many that their products over `rows` rows cost little: evenly out of each joint's, the last among them.
std::vector<Offer> offers_of(std::span<const JointCandidates> candidates, double rows) {
  const double share = std::sqrt(kMostProducts / rows) / static_cast<double>(candidates.size());
  const auto most = static_cast<std::size_t>(std::max(1.0, share));
  std::vector<Offer> offers;
  for (std::size_t list = 0; list < candidates.size(); ++list) {
    const std::vector<JointCorrection> all = admissible_corrections(candidates[list]);
    const std::size_t count = std::min(all.size(), most);
    for (std::size_t i = 1; i <= count; ++i) {
      const JointCorrection& one = all[i * all.size() / count - 1];
      offers.push_back({list, one, description_length_nats(one.formula(), 1.0, rows),
                        magnitude_bound(one.formula(), one.range_rad())});
    }
  }
  return offers;
}

/// What a correction of the joint does to the rows of a field.
RowMatrix column_of(const JointCorrection& correction, int joint, const ResidualField& field) {
  const Eigen::Index motion = motion_column(joint, kTurnAboutZ);
  RowMatrix column(field.rows(), 1);
  for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
    const Eigen::Index first = field.first_row[pose], count = field.rows_of_pose(pose);
    column.middleRows(first, count) =
        correction(field.states[pose].joints()[joint]) * field.motions.block(first, motion, count, 1);
  }
  return column;
}

class ChoiceTogether {
 public:
  ChoiceTogether(const DiagnosisProblem& problem, const Fit& start, std::span<const JointCandidates> candidates)
      : candidates_(candidates), linearization_(linearize(problem, diagnosed_model(problem, start))) {
    rows_ = static_cast<double>(linearization_.fitted.rows() + linearization_.validation.rows());
    offers_ = offers_of(candidates, rows_);
    work_out_rows();
  }

  /// `robot` with what is chosen.
  Selection chosen(CorrectedRobot robot) const;

 private:
  void work_out_rows();
  ChosenSet fitted(Places places) const;
  bool is_sound(const ChosenSet& set) const;
  ChosenSet exchanged(ChosenSet present) const;
  ChosenSet shortest_description() const;
  double sureness(const ChosenSet& set, const ChosenSet& without) const;
  ChosenSet significant(ChosenSet set) const;
  JointCorrection scaled(const Offer& offer, double factor) const;

  std::span<const JointCandidates> candidates_;
  Linearization linearization_;
  double rows_ = 0.0;
  std::vector<Offer> offers_;
  RowsLeft fitted_, selecting_;
};

/// What is believed of the declared numbers beforehand are further rows, after those of the fitted poses.
void ChoiceTogether::work_out_rows() {
  const Projection& projection = linearization_.projection;
  const auto count = static_cast<Eigen::Index>(offers_.size());
  const Eigen::Index measured = linearization_.fitted.rows(), believed = projection.prior_residual().size();
  fitted_ = {RowMatrix(measured + believed, count), Eigen::VectorXd(measured + believed)};
  fitted_.residual << projection.residual(), projection.prior_residual();
  selecting_ = {RowMatrix(linearization_.validation.rows(), count), projection.validation_residual()};
  for (Eigen::Index i = 0; i < count; ++i) {
    const Offer& offer = offers_[static_cast<std::size_t>(i)];
    const auto joint = static_cast<int>(candidates_[offer.list].training.joint);
    const Projection::Trial trial = projection.trial(column_of(offer.correction, joint, linearization_.fitted),
                                                     column_of(offer.correction, joint, linearization_.validation));
    fitted_.columns.col(i) << trial.fitted, trial.prior;
    selecting_.columns.col(i) = trial.validation;
  }
  fitted_.multiply();
  selecting_.multiply();
}

/// With the factors that suit the set to the fitted poses; infinite where it is not to be had.
ChosenSet ChoiceTogether::fitted(Places places) const {
  ChosenSet set{std::move(places), {}, 0.0};
  if (!set.places.empty()) {
    Eigen::MatrixXd products = fitted_.products(set.places, set.places);
    const Eigen::VectorXd hold = kHold * products.diagonal();
    products.diagonal() += hold;
    set.factors = products.ldlt().solve(fitted_.moments(set.places) + hold);
  }
  const double left = fitted_.square(set) + selecting_.square(set);
  set.nats = is_sound(set) ? 0.5 * rows_ * std::log(std::max(left, 1e-300)) : kInfinite;
  for (const std::size_t place : set.places) set.nats += offers_[place].price_nats;
  return set;
}

bool ChoiceTogether::is_sound(const ChosenSet& set) const {
  for (std::size_t i = 0; i < set.places.size(); ++i) {
    const double factor = set.factors[static_cast<Eigen::Index>(i)];
    const Offer& offer = offers_[set.places[i]];
    if (!(factor >= 1.0 / kLargestFactor && factor <= kLargestFactor)) return false;
    if (factor > 1.0 && factor * offer.bound_rad > correction_limit_rad(candidates_[offer.list].training)) return false;
  }
  return true;
}

/// One joint's candidate at a time is exchanged, added or left out, the best first, until nothing shortens.
ChosenSet ChoiceTogether::exchanged(ChosenSet present) const {
  while (true) {
    ChosenSet best = present;
    const auto compete = [&](Places places) {
      ChosenSet set = fitted(std::move(places));
      if (set.nats < best.nats - kLeastGainNats) best = std::move(set);
    };
    for (std::size_t list = 0; list < candidates_.size(); ++list) {
      Places others = present.places;
      std::erase_if(others, [&](std::size_t place) { return offers_[place].list == list; });
      compete(others);
      for (std::size_t place = 0; place < offers_.size(); ++place) {
        if (offers_[place].list != list) continue;
        Places with = others;
        with.push_back(place);
        compete(std::move(with));
      }
    }
    if (best.places == present.places) return present;
    present = std::move(best);
  }
}

ChosenSet ChoiceTogether::shortest_description() const {
  Places last;
  for (std::size_t place = 0; place < offers_.size(); ++place) {
    if (place + 1 == offers_.size() || offers_[place + 1].list != offers_[place].list) last.push_back(place);
  }
  ChosenSet from_none = exchanged(fitted({})), from_all = exchanged(fitted(std::move(last)));
  return from_all.nats < from_none.nats ? from_all : from_none;
}

/// Standard errors by which the set's error is below that of the other: the fewest over both lists of poses.
double ChoiceTogether::sureness(const ChosenSet& set, const ChosenSet& without) const {
  double fewest = kInfinite;
  const auto compare = [&](const RowsLeft& rows, const ResidualField& field) {
    const PairedDifference gain = paired(rows.errors(field, without), rows.errors(field, set));
    fewest = std::min(fewest, gain.mean / gain.standard_error);
  };
  compare(fitted_, linearization_.fitted);
  compare(selecting_, linearization_.validation);
  return fewest;
}

ChosenSet ChoiceTogether::significant(ChosenSet set) const {
  while (!set.places.empty()) {
    double least = kInfinite;
    ChosenSet shorter;
    for (std::size_t i = 0; i < set.places.size(); ++i) {
      Places others = set.places;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      ChosenSet without = fitted(std::move(others));
      const double sure = sureness(set, without);
      if (sure >= least) continue;
      least = sure;
      shorter = std::move(without);
    }
    if (least > kSureErrors) break;
    set = std::isfinite(shorter.nats) ? std::move(shorter) : fitted({});
  }
  return set;
}

JointCorrection ChoiceTogether::scaled(const Offer& offer, double factor) const {
  const JointCorrection& one = offer.correction;
  const Tree& formula = one.formula();
  const bool has_factor =
      formula.size() > 2 && formula[0].primitive == Primitive::multiply && formula[1].primitive == Primitive::constant;
  const double scale = rounded((has_factor ? formula[1].value : 1.0) * factor);
  const Tree rest = has_factor ? Tree(formula.begin() + 2, formula.end()) : formula;
  return {apply(Primitive::multiply, constant_tree(scale), rest), one.branch(), one.range_rad()};
}

Selection ChoiceTogether::chosen(CorrectedRobot robot) const {
  Selection selection{std::move(robot), {}};
  for (const JointCandidates& joint : candidates_)
    selection.choices.push_back({.joint = static_cast<int>(joint.training.joint),
                                 .candidates = joint.front.size() + joint.alternatives.size()});
  const ChosenSet set = significant(shortest_description());
  for (std::size_t i = 0; i < set.places.size(); ++i) {
    const Offer& offer = offers_[set.places[i]];
    selection.robot.corrections[candidates_[offer.list].training.joint] =
        scaled(offer, set.factors[static_cast<Eigen::Index>(i)]);
    selection.choices[offer.list].kept = true;
  }
  return selection;
}

}  // namespace

Selection choose_together(const DataSet& data, const DeclaredModel& declared, std::span<const std::size_t> fitted,
                          std::span<const std::size_t> selecting, const Fit& start,
                          std::span<const JointCandidates> candidates) {
  DeclaredModel numbers = declared;
  numbers.joint_corrections = false;
  const DiagnosisProblem problem{data, numbers, {fitted.begin(), fitted.end()}, {selecting.begin(), selecting.end()}};
  return ChoiceTogether(problem, start, candidates).chosen(start.robot);
}

}  // namespace demecal::inline calibration
