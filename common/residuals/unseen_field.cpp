#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "data/data_set.hpp"
#include "decompositions/decompositions.hpp"
#include "fitting/fit.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/observation.hpp"
#include "parameters/parameter_space.hpp"
#include "prediction/corrected_robot.hpp"
#include "prediction/measurement.hpp"
#include "products/tall_products.hpp"
#include "residuals/residual_field.hpp"

namespace demecal::inline residuals {

void leave_out_places(const ResidualField& field, RowMatrix& rows) {
  if (field.places.cols() == 0) return;
  const Eigen::MatrixXd along = field.places.transpose() * rows;
  rows.noalias() -= field.places * along;
}

ResidualField unseen_field(const DataSet& data, std::span<const std::size_t> poses, const CorrectedRobot& robot,
                           const std::vector<ParameterId>& ids, const RowScales& scales, const NoiseModel& noise) {
  constexpr double kTold = 1e-9;
  std::vector<ParameterId> own = contact_parameters(data, poses);
  if (own.empty()) return residual_field(data, poses, ParameterSpace(robot, ids), scales, false, noise);
  std::vector<ParameterId> all;
  std::ranges::copy_if(ids, std::back_inserter(all),
                       [](const ParameterId& id) { return id.kind != ParameterId::Kind::contact; });
  const auto others = static_cast<Eigen::Index>(all.size()), places = static_cast<Eigen::Index>(own.size());
  std::ranges::move(own, std::back_inserter(all));
  const ParameterSpace space(with_own_contacts(robot, data, poses), all);
  ResidualField field = residual_field(data, poses, space, scales, false, noise);
  const Eigen::MatrixXd moved = field.declared.rightCols(places);
  field.places = PivotedQr(moved, kTold).basis();
  RowMatrix columns = RowMatrix::Zero(field.rows(), static_cast<Eigen::Index>(ids.size()));
  for (Eigen::Index from = 0, to = 0; from < others; ++from, ++to) {
    while (ids[static_cast<std::size_t>(to)].kind == ParameterId::Kind::contact) ++to;
    columns.col(to) = field.declared.col(from);
  }
  leave_out_places(field, columns);
  field.declared = std::move(columns);
  RowMatrix residual = field.residual;
  leave_out_places(field, residual);
  field.residual = residual.col(0);
  return field;
}

}  // namespace demecal::inline residuals
