// What is written of recordings, with everything in it.
#pragma once

#include <string>

#include "preparation/recorded_contacts.hpp"

namespace demecal {

struct WrittenRecording {
  std::string json, standstills;
};

/// Of an arm without joints that stood once.
inline WrittenRecording made_up_recording() {
  Recordings recordings;
  recordings.logs.push_back({.file = "log.csv", .times_s = {0.0}, .joints = {}, .lines = {}});
  RecordedContacts found;
  found.noise.emplace_back();
  found.tool_m = Eigen::Vector3d::Zero();
  found.contacts.push_back({.name = "A"});
  found.standstills.emplace_back().contact = 0;
  return {recorded_json(recordings, found, {"dataset.yaml"}), standstills_file(recordings, found).text};
}

}  // namespace demecal
