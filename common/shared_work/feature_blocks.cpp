#include "shared_work/feature_blocks.hpp"

#include "pieces/pieces.hpp"

namespace demecal::inline shared_work {

void append(const std::vector<FeatureBlock>& blocks, const RowMatrix& motions, WorkInputs& inputs) {
  for (const FeatureBlock& block : blocks) {
    inputs.lists.push_back(list_of(block.columns));
    inputs.tables.push_back(table_of(motions.col(block.motion)));
    inputs.tables.push_back(table_of(block.features));
  }
}

ReceivedBlocks read_blocks(WorkReader& reader, std::size_t columns, const std::vector<Eigen::Index>& first_row) {
  const Eigen::Index rows = first_row.back(), poses = static_cast<Eigen::Index>(first_row.size()) - 1;
  // Before memory is claimed for motions: each block has a list and two tables, of which one is as long as the rows.
  constexpr std::size_t kMostMotions = 8'000'000;
  WorkReader::require(reader.tables_left() == 2 * reader.lists_left() &&
                          reader.lists_left() <= kMostMotions / static_cast<std::size_t>(rows),
                      "blocks without their tables, or too many");
  ReceivedBlocks received{{}, RowMatrix(rows, static_cast<Eigen::Index>(reader.lists_left()))};
  while (reader.lists_left() > 0) {
    const auto& own = reader.ascending(columns);
    const auto number = static_cast<Eigen::Index>(received.blocks.size());
    received.motions.col(number) = reader.table(rows, 1);
    received.blocks.push_back(
        {number, {own.begin(), own.end()}, reader.table(poses, static_cast<Eigen::Index>(own.size()))});
  }
  return received;
}

Eigen::MatrixXf transposed_times(const std::vector<FeatureBlock>& blocks, const std::vector<Eigen::Index>& first_row,
                                 const RowMatrix& motions, Eigen::Index columns, const RowMatrixF& rows) {
  std::vector<Eigen::MatrixXf> products(blocks.size());
  in_pieces(products.size(), [&](std::size_t i) {
    products[i] =
        blocks[i].features.cast<float>().transpose() * along_motion(first_row, motions, blocks[i].motion, rows);
  });
  return summed<Eigen::MatrixXf>(blocks, products, columns, rows.cols());
}

}  // namespace demecal::inline shared_work
