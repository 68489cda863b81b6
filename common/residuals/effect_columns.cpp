#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "effect_sets/fitted_set.hpp"
#include "effects/arm_state.hpp"
#include "effects/effect.hpp"
#include "errors/check.hpp"
#include "pieces/pieces.hpp"
#include "products/tall_products.hpp"
#include "residuals/residual_field.hpp"
#include "shared_work/candidate_products.hpp"
#include "shared_work/feature_blocks.hpp"

namespace demecal::inline residuals {
namespace {

/// How far one coefficient moves one place along or about one axis, pose by pose.
struct Feature {
  Eigen::Index motion, coefficient;
  Eigen::VectorXd sizes;
};

std::vector<Feature> features_of(const SampledEffect& sampled, const Robot& robot) {
  const auto poses = static_cast<Eigen::Index>(sampled.states.size());
  std::vector<Feature> features;
  std::vector<UnitMotion> motions;
  for (Eigen::Index pose = 0; pose < poses; ++pose) {
    motions.clear();
    append_unit_motions(sampled.effect, robot, sampled.states[static_cast<std::size_t>(pose)], motions);
    for (const UnitMotion& motion : motions) {
      const Eigen::Index column = motion_column(motion.place, motion.axis);
      auto own = std::ranges::find_if(
          features, [&](const Feature& one) { return one.motion == column && one.coefficient == motion.coefficient; });
      if (own == features.end()) own = features.insert(own, {column, motion.coefficient, Eigen::VectorXd::Zero(poses)});
      own->sizes[pose] += motion.size;
    }
  }
  return features;
}

}  // namespace

void EffectColumns::append(const std::vector<SampledEffect>& effects, const Robot& robot) {
  std::vector<std::vector<Feature>> features(effects.size());
  in_pieces(effects.size(), [&](std::size_t i) { features[i] = features_of(effects[i], robot); });
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const Effect& effect = effects[i].effect;
    const auto count = static_cast<Eigen::Index>(law_of(effect).coefficients(effect, robot).size());
    for (Feature& feature : features[i])
      loose_[feature.motion].emplace(columns_ + feature.coefficient, std::move(feature.sizes));
    spans_.push_back({columns_, count});
    columns_ += count;
  }
}

void EffectColumns::append(const std::vector<Effect>& effects, const Robot& robot,
                           const std::vector<ArmState>& states) {
  std::vector<SampledEffect> sampled;
  for (const Effect& effect : effects) sampled.push_back({effect, states});
  append(sampled, robot);
}

void EffectColumns::pack() {
  DEMECAL_CHECK(blocks_.empty(), "columns are packed once");
  for (auto& [motion, features] : loose_) {
    FeatureBlock block{motion, {}, {}};
    block.features.resize(features.begin()->second.size(), static_cast<Eigen::Index>(features.size()));
    for (auto& [column, values] : features) {
      block.features.col(static_cast<Eigen::Index>(block.columns.size())) = values;
      block.columns.push_back(column);
      values.resize(0);
    }
    blocks_.push_back(std::move(block));
  }
  loose_.clear();
}

Eigen::MatrixXd EffectColumns::transposed_times(const ResidualField& field, const RowMatrix& rows,
                                                const DoWork& do_work) const {
  DEMECAL_CHECK(rows.rows() == field.rows(), rows.rows() << " rows for " << field.rows());
  return demecal::transposed_times(blocks_, field.first_row, field.motions, columns_, rows, do_work);
}

const FeatureBlock* EffectColumns::only_block(ColumnSpan span) const {
  const FeatureBlock* only = nullptr;
  for (const FeatureBlock& block : blocks_) {
    const auto begin = std::lower_bound(block.columns.begin(), block.columns.end(), span.first);
    const auto end = std::lower_bound(begin, block.columns.end(), span.first + span.count);
    if (begin == end) continue;
    if (only != nullptr || end - begin != span.count) return nullptr;
    only = &block;
  }
  return only;
}

std::vector<Eigen::MatrixXd> EffectColumns::squares(const ResidualField& field) const {
  std::vector<Eigen::VectorXd> lengths(
      static_cast<std::size_t>(field.motions.cols()));  // of motions, squared, per pose
  for (const FeatureBlock& block : blocks_) {
    Eigen::VectorXd& own = lengths[static_cast<std::size_t>(block.motion)];
    own.resize(static_cast<Eigen::Index>(field.poses.size()));
    for (std::size_t pose = 0; pose < field.poses.size(); ++pose)
      own[static_cast<Eigen::Index>(pose)] =
          field.motions.block(field.first_row[pose], block.motion, field.rows_of_pose(pose), 1).squaredNorm();
  }
  std::vector<Eigen::MatrixXd> squares(spans_.size());
  in_pieces(spans_.size(), [&](std::size_t i) {
    const FeatureBlock* const only = field.places.cols() > 0 ? nullptr : only_block(spans_[i]);
    if (only == nullptr) {
      const RowMatrix columns = dense(field, i);
      squares[i] = columns.transpose() * columns;
      return;
    }
    const auto first = std::lower_bound(only->columns.begin(), only->columns.end(), spans_[i].first);
    const auto features = only->features.middleCols(first - only->columns.begin(), spans_[i].count);
    squares[i] = features.transpose() * lengths[static_cast<std::size_t>(only->motion)].asDiagonal() * features;
  });
  return squares;
}

RowMatrix EffectColumns::dense(const ResidualField& field, std::size_t effect) const {
  const ColumnSpan span = spans_[effect];
  RowMatrix matrix = RowMatrix::Zero(field.rows(), span.count);
  for (const FeatureBlock& block : blocks_) {
    auto at = std::lower_bound(block.columns.begin(), block.columns.end(), span.first);
    for (; at != block.columns.end() && *at < span.first + span.count; ++at) {
      const auto feature = block.features.col(at - block.columns.begin());
      for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
        const Eigen::Index first = field.first_row[pose], count = field.rows_of_pose(pose);
        matrix.block(first, *at - span.first, count, 1) +=
            feature[static_cast<Eigen::Index>(pose)] * field.motions.block(first, block.motion, count, 1);
      }
    }
  }
  leave_out_places(field, matrix);
  return matrix;
}

RowMatrix EffectColumns::dense(const ResidualField& field) const {
  RowMatrix all(field.rows(), columns_);
  in_pieces(spans_.size(), [&](std::size_t i) { all.middleCols(spans_[i].first, spans_[i].count) = dense(field, i); });
  return all;
}

}  // namespace demecal::inline residuals
