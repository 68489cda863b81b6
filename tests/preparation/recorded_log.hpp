// Recordings of arms that touch points, as a logger would write them, and what is true of them.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "fitting/touching_arm.hpp"
#include "preparation/recorded_contacts.hpp"

namespace demecal {

/// How a logger sees the joints.
struct Logger {
  double step_s = 0.02;
  double noise_rad = 2e-5;  ///< of a row, or m
  double count_rad = 0.0;   ///< by which encoders round; 0: not at all
};

/// The sign of a motion so small that it may count as none.
inline constexpr double kEither = 2.0;

/// Where the arm really stood, and for what.
struct TrueStop {
  JointVector joints;
  ApproachSigns approach;
  std::string contact;  ///< empty: in the air
  double at_s = 0.0;
};

/// An arm that moves and stands while it is logged.
class RecordedArm {
 public:
  RecordedArm(RandomStream& stream, const Logger& logger, const JointVector& start)
      : stream_(stream), logger_(logger), at_(start), sign_(ApproachSigns::Zero(start.size())) {
    log_.file = "log.csv";
  }

  void stand(double duration_s, const std::string& contact = "") {
    stops_.push_back({at_, sign_, contact, time_s_});
    for (double passed_s = 0.0; passed_s < duration_s; passed_s += logger_.step_s) row(at_);
  }

  /// With the least jerk, every joint at once.
  void move(const JointVector& to, double duration_s) {
    const JointVector from = at_;
    for (double passed_s = logger_.step_s; passed_s < duration_s; passed_s += logger_.step_s) {
      const double share = passed_s / duration_s;
      row(from + (to - from) * (share * share * share * (10.0 - 15.0 * share + 6.0 * share * share)));
    }
    for (Eigen::Index joint = 0; joint < to.size(); ++joint) {
      const double moved = std::abs(to[joint] - from[joint]);
      if (moved < 2e-4) continue;
      sign_[joint] = moved < 5e-3 ? kEither : to[joint] > from[joint] ? 1.0 : -1.0;
    }
    at_ = to;
  }

  /// At one speed.
  void creep(const JointVector& to, double duration_s) {
    const JointVector from = at_;
    for (double passed_s = 0.0; passed_s < duration_s; passed_s += logger_.step_s)
      row(from + (to - from) * (passed_s / duration_s));
    at_ = to;
  }

  const JointLog& log() const { return log_; }
  const std::vector<TrueStop>& stops() const { return stops_; }
  const JointVector& at() const { return at_; }

 private:
  void row(JointVector joints) {
    for (double& joint : joints) {
      joint += logger_.noise_rad * stream_.normal();
      if (logger_.count_rad > 0.0) joint = logger_.count_rad * std::round(joint / logger_.count_rad);
    }
    log_.times_s.push_back(time_s_);
    log_.joints.push_back(joints);
    log_.lines.push_back(log_.lines.size() + 2);
    time_s_ += logger_.step_s;
  }

  RandomStream& stream_;
  Logger logger_;
  JointVector at_;
  ApproachSigns sign_;
  JointLog log_;
  std::vector<TrueStop> stops_;
  double time_s_ = 0.0;
};

/// The poses of the arm in their order, and before one in five another stop in the air, which is no repeat; home is
/// visited at the beginning, at the end, and now and then.
inline RecordedArm recorded(const KnownArm& arm, RandomStream& stream, const Logger& logger) {
  const Chain& chain = arm.data.robot.chain;
  JointVector home = JointVector::Zero(chain.size());
  for (int joint = 0; joint < chain.size(); ++joint) {
    const Joint& link = chain.joints[static_cast<std::size_t>(joint)];
    home[joint] = 0.5 * (link.lower + link.upper) + 0.1;
  }
  RecordedArm recording(stream, logger, home);
  recording.stand(1.5);
  for (std::size_t i = 0; i < arm.data.poses.size(); ++i) {
    const MeasuredPose& pose = arm.data.poses[i];
    if (stream.chance(0.2)) {
      recording.move(0.5 * (pose.joints + random_joints(stream, chain)), 1.2);
      recording.stand(1.0);
    }
    if (i % 10 == 9) {
      recording.move(home, 1.5);
      recording.stand(1.0);
    }
    recording.move(pose.joints, 1.5);
    recording.stand(1.0, pose.contact);
  }
  recording.move(home, 1.5);
  recording.stand(1.0);
  return recording;
}

inline Recordings recordings_of(const KnownArm& arm, const JointLog& log) {
  Recordings recordings;
  recordings.name = "recorded";
  recordings.file = "preparation.yaml";
  recordings.robot = arm.data.robot;
  recordings.logs.push_back(log);
  return recordings;
}

}  // namespace demecal
