#include "noise_case.hpp"

#include <algorithm>

#include "errors/check.hpp"

namespace demecal::bench {
namespace {

/// More cases than any condition is run with.
constexpr std::uint64_t kSeedsOfCondition = 10'000;

}  // namespace

// Effects of warmth and of time are asked for where power is, so that both columns are there.
const std::vector<NoiseCondition>& noise_conditions() {
  static const std::vector<NoiseCondition> conditions{
      {.name = "ideal"},
      {.name = "joint_noise", .noise = Noise::joints},
      {.name = "repeats", .noise = Noise::repeats},
      {.name = "path", .noise = Noise::correlated, .course = Course::path},
      {.name = "path_time", .noise = Noise::correlated, .course = Course::path, .time = true},
      {.name = "grid", .noise = Noise::correlated, .course = Course::grid},
      {.name = "warm_drift", .noise = Noise::warming, .temperature = true},
      {.name = "path_drift", .noise = Noise::drift, .course = Course::path},
      {.name = "student", .noise = Noise::student},
      {.name = "tracker", .noise = Noise::tracker},
      {.name = "rounding", .noise = Noise::rounding},
      {.name = "outliers", .noise = Noise::outliers},
      {.name = "exchanged", .question = Question::bad_poses, .fault = Fault::exchanged},
      {.name = "typing", .question = Question::bad_poses, .fault = Fault::typing},
      {.name = "gross", .question = Question::bad_poses, .fault = Fault::gross},
      {.name = "power", .question = Question::power, .temperature = true, .time = true},
      {.name = "interval_ideal", .question = Question::intervals, .temperature = true, .time = true},
      {.name = "interval_joint_noise",
       .question = Question::intervals,
       .noise = Noise::joints,
       .temperature = true,
       .time = true},
      {.name = "interval_repeats",
       .question = Question::intervals,
       .noise = Noise::repeats,
       .temperature = true,
       .time = true},
  };
  return conditions;
}

DeclaredModel NoiseCase::declared(std::size_t arms) const {
  return {.registration = true,
          .tool = true,
          .joint_offset = true,
          .geometry = static_cast<std::size_t>(number) / arms % 2 == 1,
          .joint_corrections = true};
}

std::vector<NoiseCase> noise_cases(const std::string& condition, int cases) {
  const std::vector<NoiseCondition>& all = noise_conditions();
  const auto at = std::ranges::find(all, condition, &NoiseCondition::name);
  DEMECAL_CHECK(at != all.end(), condition);
  const std::uint64_t first = kNoiseSeed + kSeedsOfCondition * static_cast<std::uint64_t>(at - all.begin());
  std::vector<NoiseCase> planned;
  for (int number = 0; number < cases; ++number)
    planned.push_back({*at, number, first + static_cast<std::uint64_t>(number)});
  return planned;
}

}  // namespace demecal::bench
