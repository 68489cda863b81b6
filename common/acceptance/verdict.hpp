// Whether a tolerance is kept, by a rule that counts every uncertainty against whoever wants to prove something.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace demecal::inline acceptance {

enum class Conformity { conformity, non_conformity, undecided };

/// "conformity proved", "non-conformity proved", "undecided".
const char* to_string(Conformity verdict);

/// Share of poses whose error the tolerance is to hold.
inline constexpr double kAcceptedShare = 0.95;
/// Confidence of each of the two limits: a false verdict at the tolerance itself is at most as likely as the rest.
inline constexpr double kConfidence = 0.975;
/// With fewer poses nothing is proved of others: a share of them that is far off is too easily missed by all.
inline constexpr std::size_t kFewestJudged = 20;

/// What is said of the error that `kAcceptedShare` of poses like these keep within.
struct Judgement {
  Conformity verdict = Conformity::undecided;
  double tolerance_m = 0.0;
  double error_m = 0.0;                             ///< that share's among these poses
  std::optional<double> lower_m, upper_m;           ///< limits for all poses like these; none: no limit can be given
  double guard_below_m = 0.0, guard_above_m = 0.0;  ///< guard bands below and above the tolerance
  std::size_t poses = 0, beyond = 0;                ///< judged; beyond the tolerance
  bool assumes_normal = false;  ///< the upper limit rests on normal errors: there are too few poses for none
  std::string withheld{};       ///< why conformity is not proved although the limits are within the tolerance
};

/// The fewest poses with which conformity can be proved without assuming a distribution: 72.
std::size_t fewest_without_assumption();

/// ISO 14253-1's rule: conformity is proved where the upper limit and the guard band stay within the tolerance,
/// non-conformity where the lower limit less its guard band exceeds it. Limits are order statistics whose ranks are
/// binomial whatever the distribution; with fewer poses than that takes, the upper limit is that of errors normal along
/// one line (in three directions they would spread less about their mean square), and never less than the largest
/// error. `instrument_m`: standard uncertainty of the instrument that all poses share, by which errors may look smaller
/// or larger; `noise_m`: that of a pose's mean measurement, which makes errors look larger.
/// `errors_m` are those of the poses' single measurements, of which conformity is proved; `means_m`, by which it is
/// disproved, of the means of their repeats, since the largest of many repeats exceeds what a share of them does.
Judgement judge(std::span<const double> errors_m, std::span<const double> means_m, double tolerance_m,
                double instrument_m, double noise_m);
/// Of poses measured once.
Judgement judge(std::span<const double> errors_m, double tolerance_m, double instrument_m, double noise_m);

/// Undecided where it would prove conformity, for that reason.
void withhold(Judgement& judged, std::string why);

/// How many poses in all would decide an undecided judgement of these errors, where the share of them beyond the limit
/// stays as it is; nothing where it is decided, or no practical number would.
std::optional<std::size_t> poses_to_decide(std::span<const double> errors_m, std::span<const double> means_m,
                                           const Judgement& judged);

}  // namespace demecal::inline acceptance
