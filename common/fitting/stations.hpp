// One robot measured from several places: its data sets as one, and how a model sees what another station measured.
#pragma once

#include <string>
#include <vector>

#include "data/data_set.hpp"
#include "parameters/posterior.hpp"
#include "prediction/corrected_robot.hpp"

namespace demecal::inline fitting {

/// Whether every station has tool points of its own, as where the reflector was taken off in between, or all of them
/// measured the same.
enum class StationTools { own, shared };

/// What a station's tool point is called in a model of several stations: "ball of 3 March", "3 March" of the robot's
/// own tool.
std::string target_at_station(const std::string& station, const std::string& target);

/// The poses of several data sets of one arm, in the first one's frame: the others' points are moved by what base and
/// tool alone of both fits tell. Ids of their poses begin with their station's name, which is the data set's, numbered
/// where another has it already. Times count only where the stations' do not overlap, since clocks differ. A single set
/// is returned as it is. Throws InputError where arms or shared tools differ, where anything but points and
/// orientations was measured, and where base and tool cannot be found.
DataSet joined_stations(std::vector<DataSet> sets, StationTools tools);

/// Every station of a model: what takes its own points to the first station's frame, the alignment of the data
/// included. Empty where the data are of one station.
std::vector<Station> stations_as_found(const CorrectedRobot& robot, const DataSet& data);

/// The robot with a nominal tool for every target of a further station that it has none for.
CorrectedRobot with_tools_of_stations(CorrectedRobot robot, const DataSet& data);

/// The robot as the stations of `data` see it: those that are among `known` (by the data's hash) stand where they were
/// found, with the tools they had. Of a set that is no known station's, and of no further ones, it is `robot`. Throws
/// InputError where `data` has a further station that is none of them.
CorrectedRobot seen_from_stations(CorrectedRobot robot, const std::vector<Station>& known, const DataSet& data);

/// What is known of the numbers of `robot`, whose posterior that is, as numbers of `seen`: of it where the base stands
/// in the data's frame, with the tools that it has at the data's first station (see seen_from_stations).
Posterior posterior_seen(const Posterior& posterior, const CorrectedRobot& robot, const CorrectedRobot& seen,
                         const std::vector<Station>& known, const DataSet& data);

}  // namespace demecal::inline fitting
