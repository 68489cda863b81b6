#include "structure/structural_calibration.hpp"

#include <algorithm>
#include <cmath>

#include "errors/input_error.hpp"
#include "fitting/parameter_space.hpp"
#include "structure/equivalent_links.hpp"

namespace demecal {
namespace {

std::vector<ParameterId> ids_of(const DataSet& data, const DeclaredModel& declared) {
  return free_parameters(data, {.registration = declared.registration, .tool = declared.tool}, {});
}

StructureFreedom freedom_of(const std::vector<ParameterId>& ids) {
  StructureFreedom freedom;
  for (const ParameterId& id : ids) {
    if (id.kind == ParameterId::Kind::base_translation) freedom.base = true;
    if (id.kind == ParameterId::Kind::tool_rotation) freedom.tool_turns = true;
    if (id.kind != ParameterId::Kind::tool_translation) continue;
    if (std::ranges::find(freedom.tools, id.target) == freedom.tools.end()) freedom.tools.push_back(id.target);
  }
  return freedom;
}

/// The place of a parameter among the free numbers.
Eigen::Index column_of(const ParameterId& id, const StructureFreedom& freedom) {
  using Kind = ParameterId::Kind;
  if (id.kind == Kind::base_translation) return id.index;
  if (id.kind == Kind::base_rotation) return 3 + id.index;
  const auto tool = std::ranges::find(freedom.tools, id.target) - freedom.tools.begin();
  return (freedom.base ? 6 : 0) + freedom.tool_size() * tool + (id.kind == Kind::tool_rotation ? 3 : 0) + id.index;
}

std::vector<ParameterEstimate> estimates_of(const std::vector<ParameterId>& ids, const StructureProblem& problem,
                                            const StructureFit& fit, const CorrectedRobot& robot) {
  const Eigen::MatrixXd of_all = covariance(problem, fit);
  const auto n = static_cast<Eigen::Index>(ids.size());
  Eigen::MatrixXd of_changes(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      of_changes(i, j) = of_all(column_of(ids[static_cast<std::size_t>(i)], problem.freedom),
                                column_of(ids[static_cast<std::size_t>(j)], problem.freedom));
    }
  }
  const ParameterSpace space(robot, ids);
  const Eigen::MatrixXd to_values = value_jacobian(space, space.at(Eigen::VectorXd::Zero(n)));
  const Eigen::MatrixXd of_values = to_values * of_changes * to_values.transpose();
  const CorrectedRobot nominal = nominal_robot(problem.data);
  std::vector<ParameterEstimate> estimates;
  for (Eigen::Index i = 0; i < n; ++i) {
    const ParameterId& id = ids[static_cast<std::size_t>(i)];
    estimates.push_back(
        {id, parameter_value(nominal, id), parameter_value(robot, id), std::sqrt(std::max(0.0, of_values(i, i)))});
  }
  return estimates;
}

}  // namespace

StructuralCalibration calibrate_structure(const DataSet& data, const DeclaredModel& declared,
                                          const CorrectedRobot& registered, const StructureOptions& options,
                                          RandomStream& random, const StructureWatch& watch) {
  const std::vector<std::size_t> judged = poses_of(data, PoseSet::validation);
  if (judged.empty()) {
    throw InputError({data.file, 0}, "0",
                     "validation poses are too few: structures are judged on poses that had no part in their fit");
  }
  const std::vector<ParameterId> ids = ids_of(data, declared);
  const StructureProblem problem =
      structure_problem(data, freedom_of(ids), registered, poses_of(data, PoseSet::calibration), judged);
  const StructureFound found = search_structure(problem, options, random, watch);
  StructuralCalibration result;
  result.robot = equivalent_robot(found.fit.arm);
  result.transforms = found_transforms(problem, found.fit);
  result.estimates = estimates_of(ids, problem, found.fit, result.robot);
  result.generations = found.generations;
  result.evaluations = found.evaluations;
  return result;
}

}  // namespace demecal
