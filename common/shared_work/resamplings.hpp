// What columns add up to when they are drawn anew with replacement, again and again: the bootstrap's part that is
// drawn.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "shared_work/random_draws.hpp"
#include "shared_work/work_tables.hpp"

namespace demecal::inline shared_work {

class Resamplings final : public RandomDraws {
 public:
  /// As many columns are drawn as there are.
  Resamplings(Eigen::MatrixXd columns, const DrawCount& count) : RandomDraws(count), columns_(std::move(columns)) {}
  static std::unique_ptr<SharedWork> read(WorkReader& reader);

  /// Their sum.
  std::vector<double> piece(std::size_t number) const override;
  std::uint32_t numbers_of_draw() const override { return static_cast<std::uint32_t>(columns_.rows()); }
  WorkInputs inputs() const override;

 private:
  Eigen::MatrixXd columns_;
};

}  // namespace demecal::inline shared_work
