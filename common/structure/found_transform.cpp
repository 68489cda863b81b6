#include "structure/found_transform.hpp"

#include <cmath>

#include "kinematics/units.hpp"

namespace demecal {
namespace {

constexpr const char kAxes[] = {'x', 'y', 'z'};

char axis_of(const Gene& gene) {
  return kAxes[static_cast<std::size_t>(gene.axis)];
}

}  // namespace

std::string FoundTransform::name() const {
  return "after link " + std::to_string(link + 1) + (gene.rotates ? " R" : " T") + axis_of(gene) +
         (gene.rotates ? "_deg" : "_mm");
}

double FoundTransform::at_border(double amount) const {
  return gene.rotates ? degrees(amount) : millimetres(amount);
}

std::vector<FoundTransform> found_transforms(const StructureProblem& problem, const StructureFit& fit) {
  const Eigen::MatrixXd of_all = covariance(problem, fit);
  std::vector<FoundTransform> found;
  Eigen::Index column = problem.freedom.before_genes();
  for (std::size_t section = 0; section < fit.arm.genome.size(); ++section) {
    for (const Gene& gene : fit.arm.genome[section]) {
      const double variance = of_all(column, column);
      ++column;
      found.push_back({static_cast<int>(section), gene, fit.arm.values[found.size()], std::sqrt(variance)});
    }
  }
  return found;
}

}  // namespace demecal
