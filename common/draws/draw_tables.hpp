// How the parts of draws become the lists and tables of DrawInputs, and what is asked of those that are received.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "draws/draw_work.hpp"
#include "draws/null_noise.hpp"

namespace demecal::inline draws {

template <class Matrix>
DrawTable table_of(const Matrix& matrix) {
  const Eigen::MatrixXd plain = matrix.template cast<double>();
  return {static_cast<std::uint32_t>(plain.rows()), {plain.data(), plain.data() + plain.size()}};
}

template <class Places>
std::vector<std::uint32_t> list_of(const Places& places) {
  std::vector<std::uint32_t> list;
  for (const auto place : places) list.push_back(static_cast<std::uint32_t>(place));
  return list;
}

/// Thrown by DrawReader: no draws can be made from the inputs.
struct DrawFault {
  std::string text;
};

/// Takes lists and tables in the order in which they were written. Throws DrawFault where one is missing or is not as
/// asked.
class DrawReader {
 public:
  explicit DrawReader(const DrawInputs& inputs) : inputs_(inputs) {}

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
  std::size_t lists_left() const { return inputs_.lists.size() - next_list_; }
  std::size_t tables_left() const { return inputs_.tables.size() - next_table_; }

  static void require(bool holds, const char* otherwise) {
    if (!holds) throw DrawFault{otherwise};
  }

 private:
  const DrawInputs& inputs_;
  std::size_t next_list_ = 0, next_table_ = 0;
};

/// Three lists and two tables.
void append(const NullNoise& noise, DrawInputs& inputs);
NullNoise read_noise(DrawReader& reader);

}  // namespace demecal::inline draws
