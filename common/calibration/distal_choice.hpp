// Which candidates of all joints the model takes together, and how large it makes them.
#pragma once

#include <cstdint>
#include <span>

#include "calibration/distal_steps.hpp"
#include "calibration/job.hpp"

namespace demecal {

/// Has the model take those candidates of all joints together that lower the index most: of whichever joint, one after
/// another, as long as the linearised index falls. Joints that evolved side by side have all learnt to make up for the
/// same errors, and what is taken for one joint makes another's too large or too small: with Amplitudes::fitted,
/// every correction is multiplied by the factor that suits it to the others (see AmplitudeFit), for each choice anew,
/// and so are those that stay. Nothing is taken whose factor is beyond 0.1 to 10, or that is not bounded, and all of it
/// only if the exact index falls. Adds a step for every joint whose correction changed, each with the index of all
/// together. Without any candidates the model's own corrections are fitted to one another. Whether the index fell.
bool take_candidates(const DistalIndex& index, std::span<const JointCandidates> candidates, Amplitudes amplitudes,
                     std::uint32_t generation, DistalOutcome& outcome);

}  // namespace demecal
