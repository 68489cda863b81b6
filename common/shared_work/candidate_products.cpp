#include "shared_work/candidate_products.hpp"

#include <utility>

#include "products/tall_products.hpp"

namespace demecal::inline shared_work {
namespace {

/// Of numbers that came from elsewhere: the same with what it refers to.
class ReceivedProducts final : public SharedWork {
 public:
  ReceivedProducts(std::vector<Eigen::Index> first_row, ReceivedBlocks received, RowMatrix rows)
      : first_row_(std::move(first_row)),
        received_(std::move(received)),
        rows_(std::move(rows)),
        work_(received_.blocks, first_row_, received_.motions, rows_) {}

  std::size_t pieces() const override { return work_.pieces(); }
  std::uint32_t numbers_of_piece(std::size_t number) const override { return work_.numbers_of_piece(number); }
  std::vector<double> piece(std::size_t number) const override { return work_.piece(number); }
  WorkInputs inputs() const override { return work_.inputs(); }

 private:
  std::vector<Eigen::Index> first_row_;
  ReceivedBlocks received_;
  RowMatrix rows_;
  CandidateProducts work_;
};

}  // namespace

std::uint32_t CandidateProducts::numbers_of_piece(std::size_t number) const {
  return static_cast<std::uint32_t>(blocks_[number].features.cols() * rows_.cols());
}

std::vector<double> CandidateProducts::piece(std::size_t number) const {
  const FeatureBlock& block = blocks_[number];
  const Eigen::MatrixXd product =
      transposed_product_of_columns(block.features, along_motion(first_row_, motions_, block.motion, rows_));
  return {product.data(), product.data() + product.size()};
}

WorkInputs CandidateProducts::inputs() const {
  WorkInputs inputs = empty_inputs(WorkKind::products, 0);
  inputs.lists.push_back(list_of(first_row_));
  inputs.tables.push_back(table_of(rows_));
  append(blocks_, motions_, inputs);
  return inputs;
}

std::unique_ptr<SharedWork> CandidateProducts::read(WorkReader& reader) {
  constexpr Eigen::Index kMostRight = 10'000;  // columns
  WorkReader::require(reader.stream() == 0, "random numbers where none are drawn");
  std::vector<Eigen::Index> first_row = read_first_row(reader);
  RowMatrix rows = reader.table(first_row.back());
  WorkReader::require(rows.cols() > 0 && rows.cols() <= kMostRight, "products with nothing, or with too much");
  ReceivedBlocks received = read_blocks(reader, kMostColumnsOfWork, first_row);
  return std::make_unique<ReceivedProducts>(std::move(first_row), std::move(received), std::move(rows));
}

Eigen::MatrixXd transposed_times(const std::vector<FeatureBlock>& blocks, const std::vector<Eigen::Index>& first_row,
                                 const RowMatrix& motions, Eigen::Index columns, const RowMatrix& rows,
                                 const DoWork& do_work) {
  const std::vector<std::vector<double>> done = do_work(CandidateProducts(blocks, first_row, motions, rows));
  std::vector<Eigen::Map<const Eigen::MatrixXd>> parts;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    parts.emplace_back(done[i].data(), blocks[i].features.cols(), rows.cols());
  return summed<Eigen::MatrixXd>(blocks, parts, columns, rows.cols());
}

}  // namespace demecal::inline shared_work
