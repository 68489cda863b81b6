#include "library/local_evolver.hpp"

#include <algorithm>
#include <exception>
#include <functional>
#include <map>
#include <thread>
#include <utility>

#include "evolution/island.hpp"

namespace demecal {
namespace {

Archipelago archipelago_of(const IslandOptions& options, const std::vector<JointTraining>& trainings) {
  Archipelago archipelago{.joints = {},
                          .demes_per_joint = options.per_joint,
                          .topology = options.topology,
                          .migration_interval = options.migration_interval,
                          .migrants = options.migrants,
                          .between_joints = options.between_joints,
                          .asynchronous = false,
                          .replacement = options.replacement,
                          .spread = options.spread};
  for (const JointTraining& training : trainings) archipelago.joints.push_back(training.joint);
  return archipelago;
}

/// Calls `work` with every number below `count`, on as many threads; what one throws goes on from here.
void for_each_index(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& work) {
  const std::size_t strands = std::min<std::size_t>(count, threads);
  std::vector<std::exception_ptr> failures(strands);
  {
    std::vector<std::jthread> running;
    for (std::size_t strand = 0; strand < strands; ++strand) {
      running.emplace_back([&, strand] {
        try {
          for (std::size_t i = strand; i < count; i += strands) work(i);
        } catch (...) {
          failures[strand] = std::current_exception();
        }
      });
    }
  }
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

class LocalIslands {
 public:
  LocalIslands(const Job& job, const std::vector<JointTraining>& trainings, const EvolutionTerms& terms)
      : archipelago_(archipelago_of(job.islands, trainings)) {
    GpParameters parameters = job.gp;
    parameters.number_generations = terms.generations;
    parameters.shared_functions = terms.functions;
    for (const IslandKey& key : demecal::islands(archipelago_)) {
      const auto training = std::ranges::find(trainings, key.joint, &JointTraining::joint);
      places_[key] = islands_.size();
      islands_.emplace_back(parameters, archipelago_, training->table, key, terms.seed);
    }
  }

  void run(unsigned threads) {
    while (!islands_.empty() && !islands_.front().finished()) run_epoch(threads);
  }

  /// Best of each length over the islands of a joint.
  Population front(std::uint32_t joint) const {
    ParetoFront front;
    for (const Island& island : islands_) {
      if (island.key().joint != joint) continue;
      for (const Individual& member : island.state().front) front.offer(member);
    }
    return front.members();
  }

 private:
  void run_epoch(unsigned threads) {
    std::vector<Population> leaving;
    for (const Island& island : islands_)
      leaving.push_back(island.state().epoch > 0 ? island.emigrants() : Population{});
    for_each_index(islands_.size(), threads, [&](std::size_t i) {
      Population immigrants;
      for (const IslandKey& source : sources(archipelago_, islands_[i].key())) {
        const Population& arriving = leaving[places_.at(source)];
        immigrants.insert(immigrants.end(), arriving.begin(), arriving.end());
      }
      islands_[i].run_epoch(immigrants);
    });
  }

  Archipelago archipelago_;
  std::vector<Island> islands_;
  std::map<IslandKey, std::size_t> places_;
};

}  // namespace

LocalEvolver::LocalEvolver(const Job& job, unsigned threads, std::function<bool(const std::string&)> progress)
    : job_(job), threads_(std::max(threads, 1U)), progress_(std::move(progress)) {}

EvolvedJoints LocalEvolver::evolve(const std::vector<JointTraining>& trainings, const EvolutionTerms& terms) {
  LocalIslands islands(job_, trainings, terms);
  if (!interrupted_) islands.run(threads_);
  EvolvedJoints evolved{.joints = {}, .is_complete = !interrupted_};
  for (const JointTraining& training : trainings) evolved.joints.push_back({training, islands.front(training.joint)});
  return evolved;
}

void LocalEvolver::announce(Purpose purpose) {
  if (purpose == Purpose::corrections) say("evolving the joint corrections anew beside the effects");
  if (purpose == Purpose::formulas) say("evolving formulas over all circumstances on what is left");
  if (purpose == Purpose::null_distribution) say("the same search on permuted poses, to know what chance finds");
}

void LocalEvolver::say(const std::string& sentence) {
  if (progress_ && !progress_(sentence)) interrupted_ = true;
}

}  // namespace demecal
