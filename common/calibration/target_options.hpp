// How a job wants the joints' errors told from what was measured.
#pragma once

namespace demecal {

/// posterior: the most probable errors, given how far joints err and how far measurements scatter; exact: the joints
/// that reach the measured point with the orientation the model predicts (thesis 4.5).
enum class TargetKind { posterior, exact };

struct TargetOptions {
  TargetKind kind = TargetKind::posterior;
  double joint_error_rad = 1e-3;  ///< standard deviation of a joint's error before a pose is looked at; posterior only

  bool operator==(const TargetOptions&) const = default;
};

}  // namespace demecal
