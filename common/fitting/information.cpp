#include "fitting/information.hpp"

namespace demecal {
namespace {

constexpr Eigen::Index kRowsAtOnce = 256;

}  // namespace

Information::Information(const Eigen::MatrixXd& basis)
    : basis_(basis),
      rows_(kRowsAtOnce, basis.rows()),
      residuals_(kRowsAtOnce),
      squares_(Eigen::MatrixXd::Zero(basis.cols(), basis.cols())),
      gradient_(Eigen::VectorXd::Zero(basis.cols())) {}

void Information::make_room(Eigen::Index rows) {
  reduce();
  if (rows <= rows_.rows()) return;
  rows_.resize(rows, basis_.rows());
  residuals_.resize(rows);
}

void Information::reduce() {
  if (filled_ == 0) return;
  if (basis_.cols() == 0) {  // products without numbers have no place in memory
    filled_ = 0;
    return;
  }
  seen_.noalias() = rows_.topRows(filled_) * basis_;
  squares_.selfadjointView<Eigen::Lower>().rankUpdate(seen_.transpose());
  gradient_.noalias() += seen_.transpose() * residuals_.head(filled_);
  filled_ = 0;
}

Eigen::MatrixXd Information::squares() {
  reduce();
  return squares_.selfadjointView<Eigen::Lower>();
}

Eigen::VectorXd Information::gradient() {
  reduce();
  return gradient_;
}

}  // namespace demecal
