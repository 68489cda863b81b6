// A case of the benchmark of contacts: an arm that touches sockets in place of being measured, and what comes of it
// over its workspace beside a tracker.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planning/plan.hpp"

namespace demecal::bench {

/// Never changed: figures of two builds are compared case by case.
inline constexpr std::uint64_t kContactSeed = 20'261'126'000;

/// An arm and the sockets that a plan puts about it: two blocks of two sockets, `length_m` apart, that are fitted, and
/// one for accept poses. `on_plate`: where all four are on one plate is known as well as the length of a block is.
struct SocketArm {
  Robot robot;
  std::vector<PlannedSocket> sockets;
  std::vector<KnownDistance> lengths;
  bool on_plate = false;
};
SocketArm socket_arm(const Robot& robot, double length_m, bool on_plate);

struct ContactFigures {
  std::string arm{};
  bool failed = false;    ///< no model came of it
  int false_effects = 0;  ///< added to an arm that lacks nothing
  bool wrong_socket_named = false;
  double touched_mm = 0.0, tracked_mm = 0.0;  ///< rms of the tool over the workspace, either aligned as a whole
  double predicted_mm = 0.0;                  ///< what the model by touch says of the same
  int places = 0, within = 0;                 ///< of the workspace; those within the model's radius
  std::string injected{};                ///< the undeclared cause of twice what is detectable; empty: none is testable
  bool named = false, in_class = false;  ///< it is the first that is found; or among that one's rivals
};

/// 60 contacts that calibrate, 20 and 20 that judge, of an arm whose links are 1 mrad and 0.3 mm off and whose ball has
/// 0.05 mm of play; and as many poses of a tracker of that noise. A function of the number.
ContactFigures run_contact_case(int number, const std::vector<SocketArm>& arms);

}  // namespace demecal::bench
