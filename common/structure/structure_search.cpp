#include "structure/structure_search.hpp"

#include <algorithm>
#include <map>
#include <optional>

namespace demecal {
namespace {

constexpr int kTriesAtNew = 5;

struct Member {
  Genome genome;  ///< with its redundancies: they are the next generations' material
  double judgement;
  std::size_t genes;  ///< expressed
};

bool fitter(const Member& a, const Member& b) {
  if (a.judgement != b.judgement) return a.judgement < b.judgement;
  return a.genes < b.genes;
}

std::vector<std::size_t> spread(const std::vector<std::size_t>& poses, std::size_t most) {
  if (poses.size() <= most) return poses;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(poses[i * poses.size() / most]);
  return chosen;
}

/// Structures that were fitted before are not fitted again.
class Judge {
 public:
  explicit Judge(const StructureProblem& problem) : problem_(problem) {}

  double operator()(const Genome& structure) {
    const auto [found, anew] = known_.try_emplace(structure, 0.0);
    if (anew) found->second = fit_structure(problem_, structure).judgement;
    return found->second;
  }
  std::size_t evaluations() const { return known_.size(); }

 private:
  const StructureProblem& problem_;
  std::map<Genome, double> known_;
};

class Population {
 public:
  Population(int links, const StructureOptions& options, Judge& judge, RandomStream& random)
      : options_(options), judge_(judge), random_(random) {
    for (int i = 0; i < options.population; ++i) members_.push_back(judged(random_genome(links, random)));
  }

  void breed() {
    const Member& mother = winner();
    const Member& father = winner();
    Genome child =
        random_.chance(options_.crossover_rate) ? crossed(mother.genome, father.genome, random_) : mother.genome;
    if (random_.chance(options_.mutation_rate)) child = mutated(std::move(child), random_);
    for (int i = 0; i < kTriesAtNew && holds(expressed(child)); ++i) child = mutated(std::move(child), random_);
    Member offspring = judged(std::move(child));
    const auto worst = std::ranges::max_element(members_, fitter);
    if (!fitter(*worst, offspring)) *worst = std::move(offspring);
  }
  const Member& best() const { return *std::ranges::min_element(members_, fitter); }

 private:
  Member judged(Genome genome) {
    const Genome structure = expressed(genome);
    return {std::move(genome), judge_(structure), gene_count(structure)};
  }
  const Member& winner() {
    const Member* best = &members_[random_.index(members_.size())];
    for (int i = 1; i < options_.tournament; ++i) {
      const Member& rival = members_[random_.index(members_.size())];
      if (fitter(rival, *best)) best = &rival;
    }
    return *best;
  }
  bool holds(const Genome& structure) const {
    return std::ranges::any_of(members_, [&](const Member& member) { return expressed(member.genome) == structure; });
  }

  const StructureOptions& options_;
  Judge& judge_;
  RandomStream& random_;
  std::vector<Member> members_;
};

struct Shorter {
  Genome structure;
  double judgement;
};

/// Without the gene that is missed least.
std::optional<Shorter> without_one(const Genome& structure, Judge& judge) {
  std::optional<Shorter> best;
  for (std::size_t section = 0; section < structure.size(); ++section) {
    for (std::size_t gene = 0; gene < structure[section].size(); ++gene) {
      Genome shorter = structure;
      shorter[section].erase(shorter[section].begin() + static_cast<std::ptrdiff_t>(gene));
      shorter = expressed(shorter);
      const double judgement = judge(shorter);
      if (!best || judgement < best->judgement) best = Shorter{std::move(shorter), judgement};
    }
  }
  return best;
}

Genome shortened(Genome structure, Judge& judge, int rows) {
  const double price = 1.0 + 2.0 / std::max(1, rows);
  while (const std::optional<Shorter> shorter = without_one(structure, judge)) {
    if (shorter->judgement > price * judge(structure)) break;
    structure = shorter->structure;
  }
  return structure;
}

}  // namespace

StructureFound search_structure(const StructureProblem& problem, const StructureOptions& options, RandomStream& random,
                                const StructureWatch& watch) {
  StructureProblem searched = problem;
  searched.fitted = spread(problem.fitted, options.most_poses);
  searched.judged = spread(problem.judged, options.most_poses);
  Judge judge(searched);
  const double plain = judge(Genome(problem.start.chain.joints.size()));
  Population population(problem.start.chain.size(), options, judge, random);
  StructureFound found;
  while (found.generations < options.generations) {
    for (int i = 0; i < options.population; ++i) population.breed();
    ++found.generations;
    if (watch && !watch(found.generations, population.best().judgement / plain)) break;
  }
  const Genome best = expressed(population.best().genome);
  found.fit = fit_structure(problem, shortened(best, judge, rows_in_use(searched, searched.judged)));
  found.evaluations = judge.evaluations();
  return found;
}

}  // namespace demecal
