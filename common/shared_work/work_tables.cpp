#include "shared_work/work_tables.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace demecal::inline shared_work {
namespace {

constexpr std::size_t kMostRowsOfWork = 1'000'000;  ///< measured numbers: memory is claimed by them

}  // namespace

const std::vector<std::uint32_t>& WorkReader::list(std::size_t limit) {
  require(next_list_ < inputs_.lists.size(), "a list is missing");
  const std::vector<std::uint32_t>& list = inputs_.lists[next_list_++];
  require(std::ranges::all_of(list, [&](std::uint32_t place) { return place < limit; }), "an index out of range");
  return list;
}

const std::vector<std::uint32_t>& WorkReader::list(std::size_t limit, std::size_t count) {
  const std::vector<std::uint32_t>& own = list(limit);
  require(own.size() == count, "a list of another length");
  return own;
}

const std::vector<std::uint32_t>& WorkReader::ascending(std::size_t limit) {
  const std::vector<std::uint32_t>& own = list(limit);
  require(std::ranges::adjacent_find(own, std::greater_equal{}) == own.end(), "a list that is not ascending");
  return own;
}

Eigen::Index WorkReader::rows_of_next_table() const {
  require(next_table_ < inputs_.tables.size(), "a table is missing");
  return static_cast<Eigen::Index>(inputs_.tables[next_table_].rows);
}

Eigen::MatrixXd WorkReader::table(Eigen::Index rows) {
  require(rows_of_next_table() == rows, "a table of another height");
  const std::vector<double>& numbers = inputs_.tables[next_table_++].numbers;
  require(std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); }), "a number is not finite");
  const auto size = static_cast<Eigen::Index>(numbers.size());
  require(rows == 0 ? size == 0 : size % rows == 0, "a table that is no rectangle");
  return Eigen::Map<const Eigen::MatrixXd>(numbers.data(), rows, rows == 0 ? 0 : size / rows);
}

Eigen::MatrixXd WorkReader::table(Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd own = table(rows);
  if (rows == 0) return Eigen::MatrixXd(0, columns);
  require(own.cols() == columns, "a table of another width");
  return own;
}

void WorkReader::require_pieces_of(const SharedWork& work) const {
  require(work.pieces() == inputs_.numbers_of_pieces.size(), "pieces too many or too few");
  for (std::size_t i = 0; i < work.pieces(); ++i)
    require(work.numbers_of_piece(i) == inputs_.numbers_of_pieces[i], "a piece gives another count of numbers");
}

std::vector<Eigen::Index> read_first_row(WorkReader& reader) {
  const auto& first_row = reader.ascending(kMostRowsOfWork);
  WorkReader::require(first_row.size() > 1 && first_row.front() == 0, "no poses");
  return {first_row.begin(), first_row.end()};
}

void append(const NullNoise& noise, WorkInputs& inputs) {
  std::vector<double> lengths;
  for (const auto& [count, own] : noise.lengths) lengths.insert(lengths.end(), own.begin(), own.end());
  inputs.lists.push_back(list_of(noise.first_row));
  inputs.lists.push_back(list_of(noise.silent));
  inputs.lists.push_back(list_of(noise.believed));
  inputs.tables.push_back({static_cast<std::uint32_t>(lengths.size()), lengths});
  inputs.tables.push_back(table_of(noise.belief_deviations));
}

NullNoise read_noise(WorkReader& reader) {
  NullNoise noise;
  noise.first_row = read_first_row(reader);
  const auto& silent = reader.list(2, noise.first_row.size() - 1);
  noise.silent.assign(silent.begin(), silent.end());
  const auto& believed = reader.list(2);
  noise.believed.assign(believed.begin(), believed.end());
  std::map<Eigen::Index, std::size_t> weighted;  // poses that have weight, by their number of rows
  for (std::size_t pose = 0; pose < noise.poses(); ++pose) {
    if (!noise.silent[pose]) ++weighted[noise.rows_of_pose(pose)];
  }
  std::size_t all = 0;
  for (const auto& [count, poses] : weighted) all += poses;
  const Eigen::MatrixXd lengths = reader.table(static_cast<Eigen::Index>(all), 1);
  const double* next = lengths.data();
  for (const auto& [count, poses] : weighted) {
    noise.lengths[count].assign(next, next + poses);
    next += poses;
  }
  noise.belief_deviations = reader.table(static_cast<Eigen::Index>(believed.size()), 1);
  return noise;
}

}  // namespace demecal::inline shared_work
