// What every case of the benchmark of noise is: which condition, on which arm, and what the model is told beforehand.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "parameters/declared_model.hpp"

namespace demecal::bench {

/// The seed of the first condition's case 0; others follow by their numbers. Never changed: figures of two builds are
/// compared case by case.
inline constexpr std::uint64_t kNoiseSeed = 20'261'122'000;
inline constexpr int kNoiseCases = 60;  ///< of each condition

/// What a condition asks: that nothing is found, that bad poses do no harm, that effects are found, that their
/// intervals hold.
enum class Question { false_effects, bad_poses, power, intervals };

/// In what order of places the arm is measured.
enum class Course { random, path, grid };

/// How measurements err.
enum class Noise { white, joints, repeats, correlated, warming, drift, student, tracker, rounding, outliers };

/// What is wrong with a few poses.
enum class Fault { none, exchanged, typing, gross };

struct NoiseCondition {
  std::string name;
  Question question = Question::false_effects;
  Noise noise = Noise::white;
  Course course = Course::random;
  bool temperature = false, time = false;  ///< columns
  Fault fault = Fault::none;
};

/// All conditions, in the order of reports. Their order is part of the seeds: new ones are added at the end.
const std::vector<NoiseCondition>& noise_conditions();

struct NoiseCase {
  NoiseCondition condition;
  int number = 0;  ///< within its condition
  std::uint64_t seed = 0;

  /// Which of `arms` it is of: they follow each other in turn.
  std::size_t arm(std::size_t arms) const { return static_cast<std::size_t>(number) % arms; }
  /// Registration, tool, joint offset and corrections; of every other turn of the arms geometry too.
  DeclaredModel declared(std::size_t arms) const;
};

/// The cases 0 .. cases - 1 of the condition of that name, which must be one of the table.
std::vector<NoiseCase> noise_cases(const std::string& condition, int cases);

}  // namespace demecal::bench
