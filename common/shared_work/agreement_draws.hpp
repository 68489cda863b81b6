// How far the errors of poses that are neighbours in some circumstance agree, in the measured residual and in draws of
// noise: the omnibus test's part that is drawn.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "products/tall_products.hpp"
#include "shared_work/null_noise.hpp"
#include "shared_work/random_draws.hpp"
#include "shared_work/work_tables.hpp"

namespace demecal::inline shared_work {

/// Pairs of poses that are neighbours in some circumstance.
using Pairs = std::vector<std::array<std::size_t, 2>>;

class AgreementDraws final : public RandomDraws {
 public:
  /// `joint_columns`: what a radian (or metre) of each joint does to the rows of the residuals' poses, one pose after
  /// another; `lengths`: of these columns, pose by pose (poses x joints). `circumstances`: pairs of places among the
  /// residuals' poses.
  AgreementDraws(NullResiduals residuals, RowMatrix joint_columns, RowMatrix lengths, std::vector<Pairs> circumstances,
                 const DrawCount& count);
  static std::unique_ptr<SharedWork> read(WorkReader& reader);

  /// Every pose's residual is taken as an error of each joint; a joint's errors as a column of unit length. For each
  /// joint in each circumstance, the sum over its pairs of the products of their errors. `residuals`: a column each,
  /// over the poses' rows; as many columns are returned.
  Eigen::MatrixXd agreements(const Eigen::MatrixXd& residuals) const;

  std::vector<double> piece(std::size_t number) const override;
  std::uint32_t numbers_of_draw() const override;
  WorkInputs inputs() const override;

 private:
  RowMatrix errors(const Eigen::MatrixXd& residuals) const;

  NullResiduals residuals_;
  RowMatrix joint_columns_, lengths_;
  std::vector<Pairs> circumstances_;
};

}  // namespace demecal::inline shared_work
