// From a registered robot to the robot with the structure that its measurements ask for.
#pragma once

#include "fitting/fit.hpp"
#include "structure/found_transform.hpp"
#include "structure/structure_search.hpp"

namespace demecal {

struct StructuralCalibration {
  CorrectedRobot robot;                      ///< with what was found written into links and tools
  std::vector<FoundTransform> transforms;    ///< the same as they were found
  std::vector<ParameterEstimate> estimates;  ///< of base and tools, where declared
  int generations = 0;
  std::size_t evaluations = 0;
};

/// Searches a structure for `registered`, whose base and tools, where declared, are fitted anew with every structure:
/// amounts come from the calibration poses, validation poses choose. Throws InputError where there are none of these.
StructuralCalibration calibrate_structure(const DataSet& data, const DeclaredModel& declared,
                                          const CorrectedRobot& registered, const StructureOptions& options,
                                          RandomStream& random, const StructureWatch& watch = {});

}  // namespace demecal
