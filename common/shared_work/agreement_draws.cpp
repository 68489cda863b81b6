#include "shared_work/agreement_draws.hpp"

#include <algorithm>
#include <utility>

#include "random/random_stream.hpp"

namespace demecal::inline shared_work {
AgreementDraws::AgreementDraws(NullResiduals residuals, RowMatrix joint_columns, RowMatrix lengths,
                               std::vector<Pairs> circumstances, const DrawCount& count)
    : RandomDraws(count),
      residuals_(std::move(residuals)),
      joint_columns_(std::move(joint_columns)),
      lengths_(std::move(lengths)),
      circumstances_(std::move(circumstances)) {}

/// Poses x (joints of the first residual, joints of the second, and so on).
RowMatrix AgreementDraws::errors(const Eigen::MatrixXd& residuals) const {
  constexpr double kNothing = 1e-12;
  const Eigen::Index joints = lengths_.cols();
  RowMatrix errors(lengths_.rows(), residuals.cols() * joints);
  for (Eigen::Index i = 0; i < residuals.cols(); ++i) {
    RowMatrix own = RowMatrix::Zero(lengths_.rows(), joints);
    Eigen::Index row = 0;
    for (Eigen::Index pose = 0; pose < own.rows(); ++pose) {
      const std::size_t number = residuals_.poses[static_cast<std::size_t>(pose)];
      for (const Eigen::Index end = row + residuals_.noise.rows_of_pose(number); row < end; ++row)
        own.row(pose) += residuals(row, i) * joint_columns_.row(row);
    }
    own = (lengths_.array() > kNothing).select(own.cwiseQuotient(lengths_), 0.0);
    for (Eigen::Index joint = 0; joint < joints; ++joint) {
      const double norm = own.col(joint).norm();
      if (norm > 0) own.col(joint) /= norm;
    }
    errors.middleCols(i * joints, joints) = own;
  }
  return errors;
}

Eigen::MatrixXd AgreementDraws::agreements(const Eigen::MatrixXd& residuals) const {
  const RowMatrix all = errors(residuals);
  const Eigen::Index joints = lengths_.cols(), draws = residuals.cols();
  Eigen::MatrixXd agreements(joints * static_cast<Eigen::Index>(circumstances_.size()), draws);
  Eigen::RowVectorXd sum(all.cols());
  for (std::size_t i = 0; i < circumstances_.size(); ++i) {
    sum.setZero();
    for (const auto& [a, b] : circumstances_[i])
      sum += all.row(static_cast<Eigen::Index>(a)).cwiseProduct(all.row(static_cast<Eigen::Index>(b)));
    agreements.middleRows(static_cast<Eigen::Index>(i) * joints, joints) =
        Eigen::Map<const Eigen::MatrixXd>(sum.data(), joints, draws);
  }
  return agreements;
}

std::vector<double> AgreementDraws::piece(std::size_t number) const {
  RandomStream random = random_of_piece(number);
  const Eigen::MatrixXd drawn = agreements(residuals_.draw(static_cast<Eigen::Index>(draws_of_piece(number)), random));
  return {drawn.data(), drawn.data() + drawn.size()};
}

std::uint32_t AgreementDraws::numbers_of_draw() const {
  return static_cast<std::uint32_t>(static_cast<std::size_t>(lengths_.cols()) * circumstances_.size());
}

WorkInputs AgreementDraws::inputs() const {
  WorkInputs inputs = counted_inputs(WorkKind::agreements);
  append(residuals_.noise, inputs);
  inputs.lists.push_back(list_of(residuals_.poses));
  for (const Pairs& pairs : circumstances_) {
    std::vector<std::uint32_t>& list = inputs.lists.emplace_back();
    for (const auto& pair : pairs)
      for (const std::size_t place : pair) list.push_back(static_cast<std::uint32_t>(place));
  }
  inputs.tables.push_back(table_of(residuals_.basis));
  inputs.tables.push_back(table_of(residuals_.prior_basis));
  inputs.tables.push_back(table_of(residuals_.others_root));
  inputs.tables.push_back({1, {residuals_.model_squares}});
  inputs.tables.push_back(table_of(joint_columns_));
  inputs.tables.push_back(table_of(lengths_));
  return inputs;
}

std::unique_ptr<SharedWork> AgreementDraws::read(WorkReader& reader) {
  const DrawCount count = read_draw_count(reader);
  NullResiduals residuals{read_noise(reader), {}, {}, {}, {}, 0.0};
  const auto& poses = reader.ascending(residuals.noise.poses());
  residuals.poses.assign(poses.begin(), poses.end());
  std::vector<Pairs> circumstances;
  while (reader.lists_left() > 0) {
    const auto& places = reader.list(poses.size());
    WorkReader::require(places.size() % 2 == 0, "an odd number of pose indices");
    Pairs& pairs = circumstances.emplace_back();
    for (std::size_t i = 0; i < places.size(); i += 2) pairs.push_back({places[i], places[i + 1]});
  }
  const auto rows = static_cast<Eigen::Index>(residuals.rows().size());
  const Eigen::Index basis_rows = reader.rows_of_next_table();
  WorkReader::require(basis_rows == rows || basis_rows == residuals.noise.rows(), "a basis of the wrong height");
  residuals.basis = reader.table(basis_rows);
  const Eigen::Index rank = residuals.basis.cols();
  residuals.prior_basis = reader.table(residuals.noise.belief_deviations.size(), rank);
  const bool of_all = reader.rows_of_next_table() == 0;
  residuals.others_root = of_all ? reader.table(0, 0) : reader.table(rank);
  const Eigen::Index others = residuals.others_root.cols();
  WorkReader::require(of_all || (others > 0 && others <= rank), "a root of the wrong width");
  WorkReader::require(basis_rows == (of_all ? residuals.noise.rows() : rows), "a basis of the wrong height");
  residuals.model_squares = reader.table(1, 1)(0, 0);
  RowMatrix joint_columns = reader.table(rows);
  RowMatrix lengths = reader.table(static_cast<Eigen::Index>(poses.size()), joint_columns.cols());
  constexpr std::size_t kMostNumbersOfDraw = 100'000;
  WorkReader::require(static_cast<std::size_t>(lengths.cols()) * circumstances.size() <= kMostNumbersOfDraw,
                      "too many numbers of a draw");
  return std::make_unique<AgreementDraws>(std::move(residuals), std::move(joint_columns), std::move(lengths),
                                          std::move(circumstances), count);
}

}  // namespace demecal::inline shared_work
