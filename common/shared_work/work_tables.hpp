// How the parts of work become the lists and tables of WorkInputs, and what is asked of those that are received.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shared_work/null_noise.hpp"
#include "shared_work/shared_work.hpp"

namespace demecal::inline shared_work {

template <class Matrix>
WorkTable table_of(const Matrix& matrix) {
  const Eigen::MatrixXd plain = matrix.template cast<double>();
  return {static_cast<std::uint32_t>(plain.rows()), {plain.data(), plain.data() + plain.size()}};
}

template <class Places>
std::vector<std::uint32_t> list_of(const Places& places) {
  std::vector<std::uint32_t> list;
  for (const auto place : places) list.push_back(static_cast<std::uint32_t>(place));
  return list;
}

/// Thrown by WorkReader: the inputs are of no work.
struct WorkFault {
  std::string text;
};

/// Takes lists and tables in the order in which they were written. Throws WorkFault where one is missing or is not as
/// asked.
class WorkReader {
 public:
  explicit WorkReader(const WorkInputs& inputs) : inputs_(inputs) {}

  /// Numbers below `limit`; `count` of them, or however many.
  const std::vector<std::uint32_t>& list(std::size_t limit);
  const std::vector<std::uint32_t>& list(std::size_t limit, std::size_t count);
  /// The same, ascending, none twice.
  const std::vector<std::uint32_t>& ascending(std::size_t limit);
  /// Finite numbers; of `columns` columns, or however many.
  Eigen::MatrixXd table(Eigen::Index rows);
  Eigen::MatrixXd table(Eigen::Index rows, Eigen::Index columns);
  /// How many rows the next table claims to have.
  Eigen::Index rows_of_next_table() const;
  std::uint64_t stream() const { return inputs_.stream; }
  std::size_t lists_left() const { return inputs_.lists.size() - next_list_; }
  std::size_t tables_left() const { return inputs_.tables.size() - next_table_; }

  /// That the work gives as many numbers as the inputs say.
  void require_pieces_of(const SharedWork& work) const;
  static void require(bool holds, const char* otherwise) {
    if (!holds) throw WorkFault{otherwise};
  }

 private:
  const WorkInputs& inputs_;
  std::size_t next_list_ = 0, next_table_ = 0;
};

inline constexpr std::size_t kMostColumnsOfWork = 100'000;

/// One list: the first row of each pose, and one past the last.
std::vector<Eigen::Index> read_first_row(WorkReader& reader);

/// Three lists and two tables.
void append(const NullNoise& noise, WorkInputs& inputs);
NullNoise read_noise(WorkReader& reader);

}  // namespace demecal::inline shared_work
