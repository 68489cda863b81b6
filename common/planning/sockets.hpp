// Where to put sockets that a ball on the tool is to sit in, and the postures in which the arm reaches them: a
// measurement without an instrument.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "kinematics/chain.hpp"
#include "planning/cell.hpp"
#include "planning/information.hpp"
#include "random/random_stream.hpp"

namespace demecal::inline planning {

/// What the cell is taken to be where nobody describes it: as assumed_cell(), and the flange's z within 60 deg of
/// straight down, since sockets stand on something and are touched from above.
WorkCell assumed_cell_of_sockets(const Robot& robot);

/// The joints nearest to `start` by which the tool point comes to `point_m`, to what controllers take; nothing where
/// Newton's steps do not get there.
std::optional<JointVector> joints_touching(const Chain& chain, const JointVector& start,
                                           const Eigen::Vector3d& point_m);

/// What as many poses at so many places are predicted to leave, postures taken at random.
struct ErrorByPlaces {
  int places = 0;
  double rms_m = 0.0;
};

/// Sockets in a cell. A place is that of one socket, or of a block with two of them a known length apart, level and
/// across the direction from the arm's base.
struct PlacedSockets {
  PlannedModel model;                    ///< with the sockets that are fitted, and the lengths between them
  std::vector<PlannedSocket> sockets;    ///< those, and then those of the one place that accept poses judge by
  std::vector<KnownDistance> lengths;    ///< between these
  std::vector<PlannedPose> candidates;   ///< postures at fitted sockets to choose from, these in turn
  std::vector<PlannedPose> validation;   ///< others there, the sockets in turn
  std::vector<PlannedPose> accept;       ///< at the place that is not fitted, its sockets in turn
  std::vector<ErrorByPlaces> by_places;  ///< up to two places more than asked for
};

struct SocketRequest {
  int places = 2;            ///< that are fitted
  int poses = 40;            ///< that calibrate
  std::size_t postures = 0;  ///< candidates wanted
};

/// Puts sockets where they tell most of the arm, when the poses are shared out evenly and the sockets' own places are
/// found beside: of blocks drawn at random wherever the cell lets the tool get, chosen one after another and then
/// exchanged, by the expected squared error over the workspace. `arm`: a model by touch without sockets. Throws
/// InputError where too few places are reached.
PlacedSockets place_sockets(const InformationModel& arm, const FeasibleSpace& space, const Workspace& workspace,
                            const SocketRequest& request, RandomStream random);

}  // namespace demecal::inline planning
