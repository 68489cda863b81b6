#include "draws/feature_blocks.hpp"

#include "pieces/pieces.hpp"

namespace demecal::inline draws {

Eigen::MatrixXf transposed_times(const std::vector<FeatureBlock>& blocks, const std::vector<Eigen::Index>& first_row,
                                 const RowMatrix& motions, Eigen::Index columns, const RowMatrixF& rows) {
  std::vector<Eigen::MatrixXf> products(blocks.size());
  in_pieces(products.size(), [&](std::size_t i) {
    products[i] =
        blocks[i].features.cast<float>().transpose() * along_motion(first_row, motions, blocks[i].motion, rows);
  });
  return summed(blocks, products, columns, rows.cols());
}

}  // namespace demecal::inline draws
