#include "structure/structural_calibration.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <ranges>
#include <string>
#include <utility>

#include "data/spread_poses.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"
#include "parameters/parameter_space.hpp"
#include "structure/structured_arm.hpp"

namespace demecal::inline structure {
namespace {

constexpr int kTriesAtNew = 5;

struct Structure {
  Genome genome;  ///< with its redundancies: they are the next generations' material
  double selection_cost;
  std::size_t genes;  ///< expressed
};

bool is_fitter(const Structure& a, const Structure& b) {
  if (a.selection_cost != b.selection_cost) return a.selection_cost < b.selection_cost;
  return a.genes < b.genes;
}

/// Structures that were fitted before are not fitted again.
class StructureEvaluator {
 public:
  explicit StructureEvaluator(const StructureProblem& problem) : problem_(problem) {}

  double operator()(const Genome& structure) {
    const auto [found, anew] = known_.try_emplace(structure, 0.0);
    if (anew) found->second = fit_structure(problem_, structure).selection_cost;
    return found->second;
  }
  std::size_t evaluations() const { return known_.size(); }

 private:
  const StructureProblem& problem_;
  std::map<Genome, double> known_;
};

class StructurePopulation {
 public:
  StructurePopulation(int links, const StructureOptions& options, StructureEvaluator& evaluate, RandomStream& random)
      : options_(options), evaluate_(evaluate), random_(random) {
    for (int i = 0; i < options.population; ++i) structures_.push_back(evaluated(random_genome(links, random)));
  }

  void breed() {
    const Structure& mother = winner();
    const Structure& father = winner();
    Genome child =
        random_.chance(options_.crossover_rate) ? crossed(mother.genome, father.genome, random_) : mother.genome;
    if (random_.chance(options_.mutation_rate)) child = mutated(std::move(child), random_);
    for (int i = 0; i < kTriesAtNew && holds(expressed(child)); ++i) child = mutated(std::move(child), random_);
    Structure offspring = evaluated(std::move(child));
    const auto worst = std::ranges::max_element(structures_, is_fitter);
    if (!is_fitter(*worst, offspring)) *worst = std::move(offspring);
  }
  const Structure& best() const { return *std::ranges::min_element(structures_, is_fitter); }

 private:
  Structure evaluated(Genome genome) {
    const Genome structure = expressed(genome);
    return {std::move(genome), evaluate_(structure), gene_count(structure)};
  }
  const Structure& winner() {
    const Structure* best = &structures_[random_.index(structures_.size())];
    for (int i = 1; i < options_.tournament; ++i) {
      const Structure& rival = structures_[random_.index(structures_.size())];
      if (is_fitter(rival, *best)) best = &rival;
    }
    return *best;
  }
  bool holds(const Genome& structure) const {
    return std::ranges::any_of(structures_,
                               [&](const Structure& member) { return expressed(member.genome) == structure; });
  }

  const StructureOptions& options_;
  StructureEvaluator& evaluate_;
  RandomStream& random_;
  std::vector<Structure> structures_;
};

struct Shorter {
  Genome structure;
  double selection_cost;
};

/// Without the gene that is missed least.
std::optional<Shorter> without_one(const Genome& structure, StructureEvaluator& evaluate) {
  std::optional<Shorter> best;
  for (std::size_t section = 0; section < structure.size(); ++section) {
    for (std::size_t gene = 0; gene < structure[section].size(); ++gene) {
      Genome shorter = structure;
      shorter[section].erase(shorter[section].begin() + static_cast<std::ptrdiff_t>(gene));
      shorter = expressed(shorter);
      const double selection_cost = evaluate(shorter);
      if (!best || selection_cost < best->selection_cost) best = Shorter{std::move(shorter), selection_cost};
    }
  }
  return best;
}

Genome shortened_structure(Genome structure, StructureEvaluator& evaluate, int rows) {
  const double price = 1.0 + 2.0 / std::max(1, rows);
  while (const std::optional<Shorter> shorter = without_one(structure, evaluate)) {
    if (shorter->selection_cost > price * evaluate(structure)) break;
    structure = shorter->structure;
  }
  return structure;
}

std::vector<ParameterId> registration_ids(const DataSet& data, const DeclaredModel& declared) {
  return free_parameters(data, {.registration = declared.registration, .tool = declared.tool});
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

std::vector<ParameterEstimate> structure_estimates(const std::vector<ParameterId>& ids, const StructureProblem& problem,
                                                   const StructureFit& fit, const CorrectedRobot& robot) {
  const Eigen::MatrixXd covariance_of_all = covariance(problem, fit);
  const auto n = static_cast<Eigen::Index>(ids.size());
  Eigen::MatrixXd covariance_of_changes(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      covariance_of_changes(i, j) = covariance_of_all(column_of(ids[static_cast<std::size_t>(i)], problem.freedom),
                                                      column_of(ids[static_cast<std::size_t>(j)], problem.freedom));
    }
  }
  const ParameterSpace space(robot, ids);
  const Eigen::MatrixXd to_values = value_jacobian(space, space.at(Eigen::VectorXd::Zero(n)));
  const Eigen::MatrixXd covariance_of_values = to_values * covariance_of_changes * to_values.transpose();
  const CorrectedRobot nominal = nominal_robot(problem.data);
  std::vector<ParameterEstimate> estimates;
  for (Eigen::Index i = 0; i < n; ++i) {
    const ParameterId& id = ids[static_cast<std::size_t>(i)];
    estimates.push_back({id, parameter_value(nominal, id), parameter_value(robot, id),
                         std::sqrt(std::max(0.0, covariance_of_values(i, i)))});
  }
  return estimates;
}

}  // namespace

StructureFound search_structure(const StructureProblem& problem, const StructureOptions& options, RandomStream& random,
                                const StructureWatch& watch) {
  StructureProblem searched = problem;
  searched.fitted = spread_poses(problem.fitted, options.most_poses);
  searched.selection_poses = spread_poses(problem.selection_poses, options.most_poses);
  StructureEvaluator evaluate(searched);
  const double without_genes = evaluate(Genome(problem.start.chain.joints.size()));
  StructurePopulation population(problem.start.chain.size(), options, evaluate, random);
  StructureFound found;
  while (found.generations < options.generations) {
    for (int i = 0; i < options.population; ++i) population.breed();
    ++found.generations;
    if (watch && !watch(found.generations, population.best().selection_cost / without_genes)) break;
  }
  const Genome best = expressed(population.best().genome);
  found.fit =
      fit_structure(problem, shortened_structure(best, evaluate, rows_in_use(searched, searched.selection_poses)));
  found.evaluations = evaluate.evaluations();
  return found;
}

StructuralCalibration calibrate_structure(const DataSet& data, const DeclaredModel& declared,
                                          const CorrectedRobot& registered, const StructureOptions& options,
                                          RandomStream& random, const StructureWatch& watch) {
  const std::vector<std::size_t> selection_poses = poses_of(data, PoseSet::validation);
  if (selection_poses.empty()) {
    throw InputError({data.file, 0}, "0",
                     "validation poses are too few: structures are judged on poses that had no part in their fit");
  }
  const std::vector<ParameterId> ids = registration_ids(data, declared);
  const StructureProblem problem =
      structure_problem(data, freedom_of(ids), registered, poses_of(data, PoseSet::calibration), selection_poses);
  const StructureFound found = search_structure(problem, options, random, watch);
  StructuralCalibration result;
  result.robot = equivalent_robot(found.fit.arm);
  result.transforms = found_transforms(problem, found.fit);
  result.estimates = structure_estimates(ids, problem, found.fit, result.robot);
  result.generations = found.generations;
  result.evaluations = found.evaluations;
  return result;
}

}  // namespace demecal::inline structure
