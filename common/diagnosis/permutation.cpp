#include "diagnosis/permutation.hpp"

#include <map>

namespace demecal {

Eigen::VectorXd permuted(const ResidualField& field, const Eigen::VectorXd& rows, RandomStream& random) {
  std::map<Eigen::Index, std::vector<std::size_t>> alike;  // poses by their number of rows
  for (std::size_t pose = 0; pose < field.poses.size(); ++pose) alike[field.rows_of_pose(pose)].push_back(pose);
  Eigen::VectorXd result(rows.size());
  for (const auto& [count, poses] : alike) {
    std::vector<std::size_t> from = poses;
    for (std::size_t i = from.size(); i > 1; --i) std::swap(from[i - 1], from[random.index(i)]);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      result.segment(field.first_row[poses[i]], count) = rows.segment(field.first_row[from[i]], count);
    }
  }
  return result;
}

}  // namespace demecal
