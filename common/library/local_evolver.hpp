// Evolution of formulas on islands in this process, epoch by epoch, with the bits that workers would reach.
#pragma once

#include <functional>
#include <string>

#include "calibration/evolver.hpp"
#include "calibration/job.hpp"

namespace demecal {

class LocalEvolver final : public Evolver {
 public:
  /// `progress`, where there is one, is told what begins, and says whether to go on.
  LocalEvolver(const Job& job, unsigned threads, std::function<bool(const std::string&)> progress);

  EvolvedJoints evolve(const std::vector<JointTraining>& trainings, const EvolutionTerms& terms) override;
  void announce(Purpose purpose) override;
  bool is_interrupted() const override { return interrupted_; }
  void say(const std::string& sentence);

 private:
  const Job& job_;
  unsigned threads_;
  std::function<bool(const std::string&)> progress_;
  bool interrupted_ = false;
};

}  // namespace demecal
