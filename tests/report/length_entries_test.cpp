// What is said of known lengths: how sure their errors are, how few touches the accuracy rests on, and which of them
// count nowhere.
#include "report/length_entries.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fitting/touching_arm.hpp"
#include "report/evaluation.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double kTouchPlay_m = 1e-4;

/// A perfect arm at two sockets 50 mm apart that accept poses alone touch, so often each.
DataSet accepted_sockets(std::uint64_t seed, int touches) {
  RandomStream stream{seed};
  KnownArm arm = perfect_arm(seven_joint_arm(), Frame::base);
  const Eigen::Vector3d at_m(0.45, 0.25, 0.1);
  touch(arm, stream, "left", at_m, touches, kTouchPlay_m, PoseSet::accept);
  touch(arm, stream, "right", at_m + Eigen::Vector3d(0.0, 0.03, 0.04), touches, kTouchPlay_m, PoseSet::accept);
  touch(arm, stream, "far", {0.35, -0.35, 0.35}, touches, kTouchPlay_m);
  arm.data.contacts.distances = {{"left", "right", 0.05, 1e-5}};
  return arm.data;
}

TEST(LengthEntries, AreAsSureAsTheTouchesAtTheirEndsScatter) {
  double squares = 0.0;
  constexpr int kCases = 60, kTouches = 6;
  for (int i = 0; i < kCases; ++i) {
    const DataSet data = accepted_sockets(9700 + static_cast<std::uint64_t>(i), kTouches);
    const std::vector<LengthErrorEntry> entries = length_error_entries(data, nominal_robot(data), nullptr);
    ASSERT_EQ(entries.size(), 1u);
    ASSERT_TRUE(entries[0].uncertainty_mm);
    EXPECT_NEAR(*entries[0].uncertainty_mm, 1e3 * std::hypot(kTouchPlay_m * std::sqrt(2.0 / kTouches), 1e-5), 0.03);
    squares += std::pow(*entries[0].error_mm / *entries[0].uncertainty_mm, 2);
  }
  EXPECT_NEAR(squares / kCases, 1.0, 0.5);
  const DataSet once = accepted_sockets(9799, 1);
  EXPECT_FALSE(length_error_entries(once, nominal_robot(once), nullptr).front().uncertainty_mm);
}

TEST(UnfittedLengths, SayHowFewTouchesTheyRestOn) {
  const auto sentence = [](int touches) {
    const DataSet data = accepted_sockets(9761, touches);
    return unfitted_lengths_sentence(data, length_error_entries(data, nominal_robot(data), nullptr), {"calibration"});
  };
  EXPECT_THAT(sentence(7), AllOf(HasSubstr("(rms of 1, each known to 0.01 mm; 14 touches at 2 ends), with a standard "
                                           "uncertainty of 0.0"),
                                 HasSubstr("One length judges one place")));
  EXPECT_THAT(sentence(1),
              AllOf(HasSubstr("2 touches at 2 ends): too few touches to tell"), Not(HasSubstr("uncertainty"))));
}

TEST(UntoldLengths, AreNamedWithTheSetsThatTouchTheirEnds) {
  DataSet data = accepted_sockets(9762, 3);
  EXPECT_THAT(untold_lengths_sentence(data), IsEmpty());
  data.contacts.distances.push_back({"right", "far", 0.7, 1e-4});
  EXPECT_THAT(untold_lengths_sentence(data),
              AllOf(HasSubstr("'right' to 'far' (accept poses touch 'right', calibration poses touch 'far')"),
                    HasSubstr("contacts.distances"), Not(HasSubstr("'left'"))));
  std::string notes;
  for (const std::string& note : contact_notes(data, nominal_robot(data), {}, {})) notes += note;
  EXPECT_THAT(notes, HasSubstr("count nowhere"));
  std::erase_if(data.poses, [](const MeasuredPose& pose) { return pose.contact == "far"; });
  EXPECT_THAT(untold_lengths_sentence(data), HasSubstr("no pose that is not excluded touches 'far'"));
}

TEST(UntoldLengths, OfGridsAreNamedByPlacesThatAreInNoOther) {
  DataSet data = accepted_sockets(9763, 3);
  data.contacts.distances.clear();
  for (const char* other : {"right", "far"}) data.contacts.distances.push_back({"left", other, 0.05, 1e-4, true});
  data.contacts.distances.push_back({"right", "far", 0.05, 1e-4, true});
  EXPECT_THAT(untold_lengths_sentence(data),
              AllOf(HasSubstr("Places of contacts.grids that are in no length"),
                    HasSubstr("calibration poses touch 'far'."), Not(HasSubstr("'left'")), Not(HasSubstr("'right'"))));
}

}  // namespace
}  // namespace demecal
