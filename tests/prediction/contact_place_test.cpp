// A contact's residual is how far off it the tool point is, its derivatives are difference quotients, and places are
// found again from points that lie on them.
#include "prediction/contact_place.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "kinematics/angles.hpp"
#include "prediction/measurement.hpp"
#include "prediction/only_places.hpp"
#include "prediction/place_uncertainty.hpp"
#include "prediction/random_robot.hpp"

namespace demecal {
namespace {

constexpr ContactKind kKinds[] = {ContactKind::point, ContactKind::plane, ContactKind::sphere, ContactKind::line};

ContactPlace random_place(RandomStream& stream, ContactKind kind) {
  return {kind, random_pose(stream), stream.real(0.01, 0.1), false};
}

Eigen::Vector3d random_point(RandomStream& stream, double spread) {
  return {spread * stream.normal(), spread * stream.normal(), spread * stream.normal()};
}

/// A point on the place.
Eigen::Vector3d touching(RandomStream& stream, const ContactPlace& place) {
  const Eigen::Vector3d any = random_point(stream, 0.1);
  switch (place.kind) {
    case ContactKind::point:
      return place.frame.translation();
    case ContactKind::plane:
      return place.frame * Eigen::Vector3d(any.x(), any.y(), 0.0);
    case ContactKind::sphere:
      return place.frame * (place.radius_m * any.normalized());
    case ContactKind::line:
      return place.frame * Eigen::Vector3d(0.0, 0.0, any.z());
  }
  return any;
}

/// The place after a step of one motion from where it has been turned by `turn` already.
ContactPlace stepped(const ContactPlace& reference, const Eigen::Vector3d& turn, int motion, double step) {
  ContactPlace place = reference;
  Eigen::Vector3d whole = turn;
  if (motion == kRadiusMotion) place.radius_m += step;
  if (motion < 3) place.frame.translation() += step * reference.frame.linear().col(motion);
  if (motion >= 3 && motion != kRadiusMotion) whole[motion - 3] += step;
  place.frame.linear() = reference.frame.linear() * rotation_of(whole);
  return place;
}

TEST(ContactPlace, LeavesNothingOfPointsThatTouchIt) {
  RandomStream stream{9101};
  for (const ContactKind kind : kKinds) {
    for (int trial = 0; trial < 20; ++trial) {
      const ContactPlace place = random_place(stream, kind);
      const Eigen::VectorXd left = contact_residual(place, {touching(stream, place)});
      ASSERT_EQ(left.size(), rows_of(kind));
      EXPECT_LT(left.norm(), 1e-12);
    }
  }
}

TEST(ContactPlace, ChangesWithTheToolAndItselfAsItsDerivativesSay) {
  constexpr double kStep = 1e-6;
  RandomStream stream{9102};
  for (const ContactKind kind : kKinds) {
    const ContactPlace reference = random_place(stream, kind);
    const Eigen::Vector3d turn = random_point(stream, 0.3);
    const ContactPlace place = stepped(reference, turn, 0, 0.0);
    const Eigen::Vector3d point = place.frame * random_point(stream, 0.2);
    const auto jacobian = contact_jacobian(place, point);
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
      const Eigen::VectorXd change =
          (contact_residual(place, {point - step}) - contact_residual(place, {point + step})) / (2 * kStep);
      EXPECT_LT((jacobian.col(axis) - change).norm(), 1e-8) << to_string(kind) << axis;
    }
    for (const int motion : motions_of(place)) {
      const Eigen::VectorXd change = (contact_residual(stepped(reference, turn, motion, kStep), {point}) -
                                      contact_residual(stepped(reference, turn, motion, -kStep), {point})) /
                                     (2 * kStep);
      EXPECT_LT((-jacobian * equivalent_motion(place, motion, turn, point) - change).norm(), 1e-7)
          << to_string(kind) << motion;
    }
  }
}

TEST(ContactPlace, IsMovedAlongAndAboutItsOwnAxes) {
  constexpr double kBy = 1e-6;
  RandomStream stream{9109};
  for (const ContactKind kind : kKinds) {
    const ContactPlace place = random_place(stream, kind);
    for (const int motion : motions_of(place)) {
      const ContactPlace moved = moved_place(place, motion, kBy);
      const ContactPlace expected = stepped(place, Eigen::Vector3d::Zero(), motion, kBy);
      EXPECT_LT((moved.frame.matrix() - expected.frame.matrix()).norm(), 1e-14) << to_string(kind) << motion;
      EXPECT_DOUBLE_EQ(moved.radius_m, expected.radius_m);
    }
  }
}

TEST(PlacedM2, IsTheVarianceOfAMeanAndInfiniteWhereNothingTells) {
  const std::vector<Touch> touches(8, Touch{Eigen::Vector3d::Zero()});
  const ContactPlace point{}, other{.frame = Eigen::Isometry3d(Eigen::Translation3d(0.3, 0.4, 0.0))};
  EXPECT_NEAR(placed_m2(point, touches, other, 1e-4), 1e-8 / 8.0, 1e-12);
  const ContactPlace plane{.kind = ContactKind::plane};
  const ContactPlace aside{.frame = Eigen::Isometry3d(Eigen::Translation3d(0.3, 0.0, 0.1))};
  EXPECT_TRUE(std::isinf(placed_m2(plane, touches, aside, 1e-4))) << "one point of a plane leaves its tilt open";
}

TEST(ContactPlace, IsFoundFromPointsThatTouchIt) {
  RandomStream stream{9103};
  for (const ContactKind kind : kKinds) {
    const ContactPlace place = random_place(stream, kind);
    std::vector<Touch> touches;
    for (int i = 0; i < 12; ++i) touches.push_back({touching(stream, place)});
    const ContactPlace found = contact_place({kind, {}}, touches);
    for (const Touch& touch : touches) EXPECT_LT(contact_residual(found, touch).norm(), 1e-9);
    if (kind == ContactKind::sphere) {
      EXPECT_NEAR(found.radius_m, place.radius_m, 1e-9);
    }
  }
}

TEST(ContactPlace, OfAWireIsFoundFromItsLengths) {
  RandomStream stream{9105};
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector3d anchor = random_point(stream, 1.0);
    std::vector<Touch> touches;
    for (int i = 0; i < 12; ++i) {
      const Eigen::Vector3d point = random_point(stream, 0.4);
      touches.push_back({point, (point - anchor).norm()});
    }
    const ContactPlace found = contact_place({ContactKind::sphere, 0.0}, touches);
    EXPECT_LT((found.frame.translation() - anchor).norm(), 1e-9);
    EXPECT_NEAR(contact_residual(found, {touches[0].point_m, touches[0].length_m + 1e-3})[0], 1e-3, 1e-9);
  }
}

/// Poses that touch `contact`, their joints anything.
void add_touches(DataSet& data, RandomStream& stream, const std::string& contact, PoseSet set, int count) {
  for (int i = 0; i < count; ++i) {
    MeasuredPose pose;
    pose.joints = random_joints(stream, data.robot.chain);
    pose.contact = contact;
    pose.set = set;
    data.poses.push_back(pose);
  }
}

TEST(ToolError, OfATouchIsTheDistanceFromTheMeanOfItsContactAndSet) {
  RandomStream stream{9104};
  DataSet data;
  data.robot.chain = random_arm(stream, 6, Convention::standard_dh);
  add_touches(data, stream, "A", PoseSet::calibration, 5);
  add_touches(data, stream, "B", PoseSet::calibration, 4);
  add_touches(data, stream, "A", PoseSet::accept, 3);
  const CorrectedRobot robot = random_robot(stream, data.robot.chain, 0.01, 0.05);
  const std::vector<std::size_t> some{1, 6, 9, 11};
  const std::vector<double> errors_m = tool_errors_m(robot, data, some);
  for (std::size_t k = 0; k < some.size(); ++k) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    double count = 0.0;
    for (const MeasuredPose& other : data.poses) {
      if (other.contact != data.poses[some[k]].contact || other.set != data.poses[some[k]].set) continue;
      mean += robot.predict(Stop(other), "").translation();
      count += 1.0;
    }
    const Eigen::Vector3d own = robot.predict(Stop(data.poses[some[k]]), "").translation();
    EXPECT_NEAR(errors_m[k], (own - mean / count).norm(), 1e-12);
  }
}

TEST(LengthErrors, AreBetweenTheMeansOfBothContactsInEverySetThatHasThem) {
  RandomStream stream{9105};
  DataSet data;
  data.robot.chain = random_arm(stream, 6, Convention::standard_dh);
  add_touches(data, stream, "A", PoseSet::calibration, 3);
  add_touches(data, stream, "B", PoseSet::calibration, 2);
  add_touches(data, stream, "A", PoseSet::accept, 2);
  data.contacts.distances = {{"A", "B", 0.05, 1e-5}};
  const CorrectedRobot robot = random_robot(stream, data.robot.chain, 0.01, 0.05);
  Eigen::Vector3d apart = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 5; ++i)
    apart += robot.predict(Stop(data.poses[i]), "").translation() / (i < 3 ? 3.0 : -2.0);
  const std::vector<LengthError> errors = length_errors(robot, data);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].set, PoseSet::calibration);
  EXPECT_NEAR(errors[0].error_m, apart.norm() - 0.05, 1e-12);
}

TEST(ShareBeyondPlace, IsWhatTouchesMeasureBeyondWhereTheContactIs) {
  const ContactForm point{ContactKind::point, {}}, plane{ContactKind::plane, {}}, ball{ContactKind::sphere, {}},
      known_ball{ContactKind::sphere, 0.02};
  EXPECT_EQ(share_beyond_place(point, 1), 0.0);
  EXPECT_DOUBLE_EQ(share_beyond_place(point, 4), 0.75);
  EXPECT_EQ(share_beyond_place(plane, 3), 0.0);
  EXPECT_DOUBLE_EQ(share_beyond_place(plane, 12), 0.75);
  EXPECT_EQ(share_beyond_place(ball, 4), 0.0);
  EXPECT_DOUBLE_EQ(share_beyond_place(known_ball, 4), 0.25);
}

TEST(OnlyPlaced, PosesCountInNoFigure) {
  RandomStream stream{9106};
  DataSet data;
  data.robot.chain = random_arm(stream, 6, Convention::standard_dh);
  add_touches(data, stream, "A", PoseSet::calibration, 3);
  add_touches(data, stream, "B", PoseSet::calibration, 1);
  add_touches(data, stream, "A", PoseSet::validation, 1);
  add_touches(data, stream, "plate", PoseSet::calibration, 3);
  data.contacts.forms = {{"plate", {ContactKind::plane, {}}}};
  EXPECT_EQ(only_placed(data),
            (std::set<ContactGroup>{
                {"B", PoseSet::calibration}, {"A", PoseSet::validation}, {"plate", PoseSet::calibration}}));
  const CorrectedRobot robot = random_robot(stream, data.robot.chain, 0.01, 0.05);
  const std::vector<std::size_t> several{0, 1, 2}, all{0, 1, 2, 3, 4, 5, 6, 7}, alone{3, 4};
  EXPECT_EQ(error_figures(robot, data, all).mean_mm, error_figures(robot, data, several).mean_mm);
  EXPECT_TRUE(std::isnan(error_figures(robot, data, alone).max_mm));
  add_touches(data, stream, "plate", PoseSet::calibration, 1);
  EXPECT_FALSE(only_placed(data).contains({"plate", PoseSet::calibration}));
}

TEST(ContactPlace, OfABallIsWhereMostTouchesHaveIt) {
  RandomStream stream{9109};
  for (int trial = 0; trial < 20; ++trial) {
    const ContactPlace place = random_place(stream, ContactKind::sphere);
    std::vector<Touch> touches;
    for (int i = 0; i < 20; ++i) touches.push_back({touching(stream, place) + random_point(stream, 3e-5)});
    const ContactPlace without = contact_place({ContactKind::sphere, {}}, touches);
    touches[7].point_m += Eigen::Vector3d(0.3, -0.2, 0.1);
    touches[11].point_m += Eigen::Vector3d(0.3, -0.2, 0.1);
    const ContactPlace found = contact_place({ContactKind::sphere, {}}, touches);
    EXPECT_LT((found.frame.translation() - without.frame.translation()).norm(), 5e-5);
    EXPECT_NEAR(found.radius_m, without.radius_m, 5e-5);
  }
}

}  // namespace
}  // namespace demecal
