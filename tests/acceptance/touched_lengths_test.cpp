// What is judged where poses only touch something: lengths, each by two touches of its own.
#include "acceptance/touched_lengths.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "errors/input_error.hpp"
#include "kinematics/random_arm.hpp"

namespace demecal {
namespace {

/// An arm that touches three sockets anywhere, `counts` times each, the lengths between them known to be whatever the
/// first touches say plus `error_m`.
DataSet touching(std::uint64_t seed, const std::array<int, 3>& counts, double error_m) {
  RandomStream random{seed};
  DataSet data;
  data.robot.chain = random_arm(random, 6, Convention::standard_dh);
  const std::array<std::string, 3> names{"A", "B", "C"};
  std::array<Eigen::Vector3d, 3> first_m;
  for (std::size_t socket = 0; socket < names.size(); ++socket) {
    const JointVector joints = random_joints(random, data.robot.chain);
    first_m[socket] = nominal_robot(data).predict(joints, "").translation();
    for (int i = 0; i < counts[socket]; ++i) {
      MeasuredPose pose;
      pose.joints = joints;
      pose.contact = names[socket];
      pose.pose_id = names[socket] + std::to_string(i);
      pose.set = PoseSet::accept;
      data.poses.push_back(pose);
    }
  }
  for (const auto& [a, b] : {std::pair{0, 1}, std::pair{1, 2}})
    data.contacts.distances.push_back({names[a], names[b], (first_m[a] - first_m[b]).norm() + error_m, 1e-5});
  return data;
}

std::vector<TouchedLength> lengths_of(const DataSet& data) {
  std::vector<std::size_t> rows(data.poses.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return touched_lengths(data, rows, nominal_robot(data));
}

TEST(TouchedLengths, ErrWhereTheKnownLengthDiffersFromTheArms) {
  const DataSet data = touching(71, {4, 9, 5}, -3e-4);
  const std::vector<TouchedLength> lengths = lengths_of(data);
  ASSERT_EQ(lengths.size(), 9U);
  for (const TouchedLength& one : lengths) EXPECT_NEAR(one.error_m, 3e-4, 1e-12);
}

TEST(TouchedLengths, EveryPoseIsAnEndOfOneAtMost) {
  for (const std::array<int, 3> counts : {std::array{3, 4, 5}, std::array{6, 2, 6}, std::array{1, 1, 1}}) {
    const DataSet data = touching(72, counts, 0.0);
    std::multiset<std::size_t> used;
    for (const TouchedLength& one : lengths_of(data)) {
      for (std::size_t end = 0; end < 2; ++end) {
        used.insert(one.rows[end]);
        EXPECT_EQ(data.poses[one.rows[end]].contact, end == 0 ? one.known->first : one.known->second);
      }
    }
    for (const std::size_t row : used) EXPECT_EQ(used.count(row), 1U);
    EXPECT_GE(used.size(), 2 * static_cast<std::size_t>(std::min(counts[1], std::max(counts[0], counts[2]))));
  }
}

/// Of the model's own data, lengths between contacts that calibration poses touch are no evidence of themselves.
TEST(TouchedLengths, ThatTheModelWasFittedToAreNotJudged) {
  DataSet data = touching(74, {4, 4, 4}, 3e-4);
  data.sha256 = "of these";
  CalibratedModel model;
  model.nominal = data.robot;
  model.robot = nominal_robot(data);
  std::vector<std::size_t> rows(data.poses.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  const std::size_t own = data.poses.size();
  const auto judged = [&] {
    Certificate certificate;
    CertifiedRun run;
    run.tolerance_m = 1e-3;
    judge_lengths(model, data, rows, run, certificate);
    return certificate.poses.size();
  };
  const std::size_t all = judged();
  for (const char* contact : {"A", "B"}) {
    data.poses.push_back(data.poses[contact[0] == 'A' ? 0 : 4]);
    data.poses.back().set = PoseSet::calibration;
  }
  ASSERT_EQ(data.poses[own + 1].contact, "B");
  EXPECT_EQ(judged(), all) << "poses of another model touched A and B";
  model.data_sha256 = "of these";
  EXPECT_LT(judged(), all);
  EXPECT_GT(judged(), 0U);
  data.poses.push_back(data.poses[8]);
  data.poses.back().set = PoseSet::calibration;
  EXPECT_THROW(judged(), InputError);
}

TEST(TouchedLengths, ThatNoSetTouchesAtBothEndsAreNamedWhereNoneIsJudged) {
  DataSet data = touching(75, {2, 2, 0}, 0.0);
  for (const std::size_t pose : {2U, 3U}) data.poses[pose].set = PoseSet::calibration;
  CalibratedModel model;
  model.nominal = data.robot;
  model.robot = nominal_robot(data);
  const std::vector<std::size_t> accept{0, 1};
  Certificate certificate;
  try {
    judge_lengths(model, data, accept, {}, certificate);
    FAIL() << "no length is touched at both ends";
  } catch (const InputError& error) {
    const std::string says = error.what();
    EXPECT_NE(says.find("'A' to 'B' (accept poses touch 'A', calibration poses touch 'B')"), std::string::npos) << says;
  }
}

TEST(TouchedLengths, AreJudgedWhereNothingWasMeasuredAtAnyPose) {
  DataSet data = touching(73, {2, 2, 2}, 0.0);
  std::vector<std::size_t> rows{0, 1, 2};
  EXPECT_TRUE(touch_alone(data, rows));
  data.poses[1].position_m = Eigen::Vector3d::Zero();
  EXPECT_FALSE(touch_alone(data, rows));
  EXPECT_FALSE(touch_alone(data, {}));
}

}  // namespace
}  // namespace demecal
