// How measured points may wander in the course of a measurement, as columns of coordinates.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "trials/trial_fit.hpp"

namespace demecal::inline trials {

/// A function of the share of rows that came before; 0 at the first row.
using DriftCourse = std::function<double(double)>;

/// Courses that are tried together, and how they read.
struct DriftShape {
  std::vector<DriftCourse> courses;
  bool returns = false;  ///< there and back
};

/// Linear, settling sooner or later, and there and back once, twice and three times beside linear.
std::vector<DriftShape> drift_shapes();

/// How far each row is on a course.
Eigen::VectorXd along(const Trial& trial, const DriftCourse& course);

/// How points move with an instrument that shifts along the axes and turns about them, by each of the courses: six
/// columns for each, of three coordinates a row.
Eigen::MatrixXd drift_columns(const Trial& trial, const DriftShape& shape);

}  // namespace demecal::inline trials
