// What a plan rests on and what its poses will tell, in numbers and in sentences.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "data/data_set.hpp"
#include "planning/cell.hpp"
#include "planning/information.hpp"
#include "planning/plan.hpp"

namespace demecal::inline planning {

/// What is declared, the effects that are to be told apart and that a measurement in `space` could show, and the noise.
PlannedModel model_of(const PlanRequest& request, const FeasibleSpace& space);

/// The fewest poses that measure more numbers than the model has.
int fewest_poses(const InformationModel& model);

/// Fills in what each number of the model will be known to, what stays unknown, and which effects would show.
void describe_numbers(const InformationModel& model, const std::vector<PlannedPose>& poses,
                      const Eigen::MatrixXd& covariance, Plan& plan);

/// Fills in the sentences on what nobody stated, and on what may be wrong with the plan.
void describe_assumptions(const PlanRequest& request, const FeasibleSpace& space, const InformationModel& model,
                          Plan& plan);

}  // namespace demecal::inline planning
