// The check of a data set against its robot, and once there is one against its model: whether what was measured can be
// what this arm did, and if not, what fits.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "data/data_set.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/posterior.hpp"
#include "prediction/corrected_robot.hpp"
#include "trials/finding.hpp"

namespace demecal::inline data_check {

/// Checks the data before anything is fitted, with the arm of `data.robot` and nothing else known: the measured points
/// against a quick fit that a few wrong rows do not move (trial_fit.hpp). First what contradicts the whole set
/// (contradictions.hpp), then moves of the instrument, sets in another frame or with another tool, tools far from their
/// description, single poses, joints and points that lack spread. A function of the data. Data sets without positions
/// are checked for spread alone.
DataCheck check_data(const DataSet& data);

/// Where the one tool point that was measured stands on the flange, m, by the same quick fit to the calibration poses:
/// where that is surely farther from `tool_mm` than the tool's error may be. Nothing otherwise.
std::optional<Eigen::Vector3d> tool_elsewhere(const DataSet& data);

/// Adds the single poses (of all sets) that do not fit `robot`, a model of the data, to those that are named already.
/// Where all poses fit `robot` in another frame only, as those of a later measurement do, it says that and no more.
void check_fitted(const DataSet& data, const CorrectedRobot& robot, DataCheck& check);

/// The same, and known lengths between contacts that a model that sure of itself has otherwise. Models of old versions
/// do not say how sure they are.
void check_fitted(const DataSet& data, const CorrectedRobot& robot, const std::optional<Posterior>& posterior,
                  const std::optional<PredictionInterval>& interval, DataCheck& check);

/// Adds a contradiction where `declared` holds no registration, and the measured points stand where the arm does in
/// another frame only, further from its base than any arm errs.
void check_declared(const DataSet& data, const DeclaredModel& declared, DataCheck& check);

/// Throws InputError where a joint stands far outside its limits in a pose that no finding names.
void require_joint_limits(const DataSet& data, const DataCheck& check);

/// Whether the stations of a joined set (joined_stations) can have measured one arm: a joint's zero that is another at
/// some of them, or else that an arm of its own fits one three times as well as one arm fits all.
std::vector<Finding> check_stations(const DataSet& joined);

/// As every command takes data up: takes copies of rows out, checks the rest, and returns what was found of both.
/// Throws InputError as require_joint_limits(), unless the data contradict the arm.
DataCheck check_without_copies(DataSet& data);

}  // namespace demecal::inline data_check
