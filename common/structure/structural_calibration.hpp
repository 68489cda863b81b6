// Looks for the structure of an arm, elementary transforms after its links, and calibrates a robot with what it finds.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "data/data_set.hpp"
#include "fitting/fit.hpp"
#include "parameters/declared_model.hpp"
#include "prediction/corrected_robot.hpp"
#include "random/random_stream.hpp"
#include "structure/structure_fit.hpp"

namespace demecal::inline structure {

/// After thesis appendix B 3, whose populations of 15 settle early.
struct StructureOptions {
  int population = 40;
  int generations = 50;  ///< of as many offspring as the population is large
  int tournament = 3;
  double crossover_rate = 0.8;
  double mutation_rate = 0.3;
  /// Poses of each set that take part in the search, spread over it; the structure found is fitted to all.
  std::size_t most_poses = 150;
};

/// Asked after every generation with its number and what the best structure leaves of the squares of the selection
/// poses, as a share of what an arm without transforms leaves; the search ends where it says false.
using StructureWatch = std::function<bool(int generation, double remaining_share)>;

struct StructureFound {
  StructureFit fit;  ///< of what is left of the best genome, to all fitted poses
  int generations = 0;
  std::size_t evaluations = 0;  ///< structures fitted
};

/// The structure that, fitted to one set of poses, does best on the other. Amounts are learnt anew by every structure
/// and never inherited: they act on its fitness alone (Baldwin). Offspring of two tournaments' winners takes the
/// place of the worst unless it is worse still; a structure that the population holds already is mutated again. In the
/// end genes go whose loss costs the selection poses less than a number that means nothing would gain there: a factor
/// of 1 + 2 / rows.
StructureFound search_structure(const StructureProblem& problem, const StructureOptions& options, RandomStream& random,
                                const StructureWatch& watch = {});

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

}  // namespace demecal::inline structure
