// A run as a watcher hears of it, with figures made up from a literal seed.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "monitor/watched.hpp"
#include "random/random_stream.hpp"

namespace demecal {

inline constexpr RunId kRun = 70;
inline constexpr std::uint64_t kCalibration = 700;

inline CalibrationData made_up_data(std::uint32_t joints = 6, std::uint32_t demes = 2) {
  CalibrationData data;
  data.run = kRun;
  data.job = "puma761-demo";
  data.seed = 3;
  data.parameters.number_generations = 200;
  data.parameters.population_size = 300;
  for (std::uint32_t joint = 0; joint < joints; ++joint) data.archipelago.joints.push_back(joint);
  data.archipelago.demes_per_joint = demes;
  return data;
}

inline WorkerStatus made_up_worker(int number, std::uint32_t slots = 1) {
  WorkerStatus status;
  status.worker = "robotics-lab-" + std::to_string(number) + "-48213-123456789";
  status.host = "robotics-lab-" + std::to_string(number);
  status.process = 48213;
  status.slots = slots;
  status.version = "0.1.0";
  status.waited_share = 0.04;
  return status;
}

inline LoopNews made_up_stage(LoopNews::Stage stage, const std::string& text) {
  LoopNews news;
  news.calibration = kCalibration;
  news.run = kRun;
  news.stage = stage;
  news.job = "puma761-demo";
  news.text = text;
  return news;
}

inline LoopNews made_up_round(std::uint32_t number, LoopNews::Verdict verdict = LoopNews::Verdict::added) {
  LoopNews news = made_up_stage(LoopNews::Stage::closing, "Joint 2 stops 0.242 mrad short on either side.");
  news.round = number;
  news.verdict = verdict;
  news.kind = "backlash";
  news.joint = 2;
  news.label = "backlash, joint 2";
  news.validation_before_m = 0.354e-3;
  news.validation_after_m = 0.233e-3;
  return news;
}

inline CauseFound made_up_cause(std::uint32_t number, std::uint32_t joint) {
  CauseFound cause;
  cause.calibration = kCalibration;
  cause.number = number;
  cause.cause = "lost_motion";
  cause.joint = joint;
  cause.label = "lost motion of joint " + std::to_string(joint);
  cause.without_m = 0.417e-3;
  cause.with_m = 0.262e-3;
  cause.share_of_error = 0.4;
  cause.advice = "Ask for the play to be taken up.";
  return cause;
}

inline FinalFigures made_up_figures() {
  FinalFigures figures;
  figures.calibration = kCalibration;
  figures.job = "puma761-demo";
  figures.causes = 2;
  figures.effects = 3;
  figures.validation_before_m = 0.417e-3;
  figures.validation_after_m = 0.262e-3;
  figures.accept_before_m = figures.accept_after_m = std::numeric_limits<double>::quiet_NaN();
  return figures;
}

/// What is told at a calibration's end. Of one cause little is known, of the final figures those of accept poses.
inline std::vector<Message> made_up_findings() {
  CauseFound of_the_arm = made_up_cause(2, 0);
  of_the_arm.without_m = of_the_arm.with_m = of_the_arm.share_of_error = std::numeric_limits<double>::quiet_NaN();
  return {made_up_cause(1, 2), of_the_arm, made_up_figures()};
}

inline Progress made_up_progress(RandomStream& random, IslandKey island, std::uint32_t generation) {
  const auto number = [&random](std::size_t below) { return static_cast<std::uint32_t>(random.index(below)); };
  Progress progress;
  progress.run = kRun;
  progress.island = island;
  progress.worker = made_up_worker(1 + static_cast<int>(number(3))).worker;
  progress.epoch = 1 + generation / 10;
  progress.generation = generation;
  progress.figures = {random.real(0.0, 3.0), random.real(3.0, 900.0), 1 + number(80), random.real()};
  progress.evaluations = 300 + std::uint64_t{280} * generation;
  progress.evaluations_per_s = random.real(5e3, 90e3);
  progress.migrants_taken = number(4000);
  progress.migrants_sent = number(4000);
  progress.waited_share = random.real();
  return progress;
}

/// All that a watcher has heard amid a run: every island at some generation, three workers, one lost.
inline std::vector<Message> made_up_messages(const CalibrationData& data, std::uint64_t seed = 9) {
  std::vector<Message> messages{made_up_stage(LoopNews::Stage::evolving, "evolving the joint corrections"), data};
  for (const int number : {1, 2, 3}) messages.emplace_back(made_up_worker(number, 2));
  RandomStream random{seed};
  for (const IslandKey island : islands(data.archipelago)) {
    messages.emplace_back(made_up_progress(random, island, static_cast<std::uint32_t>(10 * random.index(21))));
  }
  messages.emplace_back(made_up_round(1));
  messages.emplace_back(made_up_round(2, LoopNews::Verdict::rejected));
  messages.emplace_back(WorkerLost{made_up_worker(2).worker});
  return messages;
}

inline Watched watched_after(const std::vector<Message>& messages, double now_s = 1.0) {
  Watched watched;
  for (const Message& message : messages) watched.take(message, now_s);
  return watched;
}

}  // namespace demecal
