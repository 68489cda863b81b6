#include "shared_work/resamplings.hpp"

#include <cstddef>
#include <utility>

namespace demecal::inline shared_work {
std::vector<double> Resamplings::piece(std::size_t number) const {
  RandomStream random = random_of_piece(number);
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(columns_.rows(), draws_of_piece(number));
  std::vector<std::size_t> chosen(static_cast<std::size_t>(columns_.cols()));
  for (Eigen::Index draw = 0; draw < sums.cols(); ++draw) {
    random.indices(chosen.size(), chosen);
    for (const std::size_t i : chosen) sums.col(draw) += columns_.col(static_cast<Eigen::Index>(i));
  }
  return {sums.data(), sums.data() + sums.size()};
}

WorkInputs Resamplings::inputs() const {
  WorkInputs inputs = counted_inputs(WorkKind::resamplings);
  inputs.tables.push_back(table_of(columns_));
  return inputs;
}

std::unique_ptr<SharedWork> Resamplings::read(WorkReader& reader) {
  constexpr Eigen::Index kMostColumns = Eigen::Index{1} << 24U;  // RandomStream::indices()
  const DrawCount count = read_draw_count(reader);
  const Eigen::Index rows = reader.rows_of_next_table();
  WorkReader::require(rows > 0, "columns of nothing");
  Eigen::MatrixXd columns = reader.table(rows);
  WorkReader::require(columns.cols() > 0 && columns.cols() < kMostColumns, "no columns, or too many");
  return std::make_unique<Resamplings>(std::move(columns), count);
}

}  // namespace demecal::inline shared_work
