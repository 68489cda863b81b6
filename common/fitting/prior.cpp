#include "fitting/prior.hpp"

namespace demecal {

Prior no_prior(int parameters) {
  return {Eigen::VectorXd::Zero(parameters), Eigen::VectorXd::Zero(parameters)};
}

Prior link_prior(const ParameterSpace& space, const CorrectedRobot& nominal, const FitOptions& options) {
  Prior prior = no_prior(space.size());
  for (int i = 0; i < space.size(); ++i) {
    const ParameterId& id = space.ids()[static_cast<std::size_t>(i)];
    const double deviation = id.is_angle() ? options.prior_rad : options.prior_m;
    if (id.kind != ParameterId::Kind::link || deviation <= 0) continue;
    prior.precision[i] = 1 / deviation;
    prior.offset[i] = parameter_value(space.reference(), id) - parameter_value(nominal, id);
  }
  return prior;
}

}  // namespace demecal
