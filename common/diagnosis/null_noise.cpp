#include "diagnosis/null_noise.hpp"

#include <algorithm>
#include <cmath>

namespace demecal {

NullNoise::NullNoise(const ResidualField& field, const Projection& model) : field_(field), model_(model) {
  constexpr double kLeastFree = 0.2;  ///< share of a pose's rows: poses that the model follows tell little of the noise
  for (std::size_t pose = 0; pose < field.poses.size(); ++pose) {
    const Eigen::Index first = field.first_row[pose], count = field.rows_of_pose(pose);
    const double followed = model.basis().middleRows(first, count).squaredNorm() / static_cast<double>(count);
    const double free = std::max(kLeastFree, 1.0 - followed);
    lengths_[count].push_back(model.left().segment(first, count).norm() / std::sqrt(free));
  }
}

NullNoise::Rows NullNoise::draw(RandomStream& random) const {
  Rows drawn{Eigen::VectorXd(field_.rows()), Eigen::VectorXd::Zero(model_.beliefs_left().size())};
  std::map<Eigen::Index, std::vector<double>> dealt = lengths_;
  for (auto& [count, lengths] : dealt)
    for (std::size_t i = lengths.size(); i > 1; --i) std::swap(lengths[i - 1], lengths[random.index(i)]);
  for (std::size_t pose = 0; pose < field_.poses.size(); ++pose) {
    auto rows = drawn.fitted.segment(field_.first_row[pose], field_.rows_of_pose(pose));
    for (double& value : rows) value = random.normal();
    std::vector<double>& lengths = dealt[rows.size()];
    rows *= lengths.back() / std::max(rows.norm(), 1e-300);
    lengths.pop_back();
  }
  for (Eigen::Index i = 0; i < drawn.beliefs.size(); ++i)
    if (model_.believed()[static_cast<std::size_t>(i)]) drawn.beliefs[i] = random.normal();
  return drawn;
}

Eigen::VectorXd NullNoise::left(RandomStream& random) const {
  Rows drawn = draw(random);
  const Eigen::VectorXd along =
      model_.basis().transpose() * drawn.fitted + model_.beliefs_basis().transpose() * drawn.beliefs;
  drawn.fitted -= model_.basis() * along;
  drawn.beliefs -= model_.beliefs_basis() * along;
  const double whole = drawn.fitted.squaredNorm() + drawn.beliefs.squaredNorm();
  return whole > 0 ? Eigen::VectorXd(std::sqrt(model_.squares() / whole) * drawn.fitted) : drawn.fitted;
}

}  // namespace demecal
