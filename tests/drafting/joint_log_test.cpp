// Recordings of joints are read as loggers write them: the same numbers whatever they call and count them by, and a
// sentence for everything that cannot be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>

#include "../config/sample_files.hpp"
#include "../config/temporary_folder.hpp"
#include "data/text.hpp"
#include "drafting/preparation_file.hpp"
#include "kinematics/units.hpp"

namespace demecal {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kRows = 40;

double angle_rad(int row) {
  return 0.4 * std::sin(0.1 * row);
}
double length_m(int row) {
  return 0.1 + 0.05 * std::cos(0.1 * row);
}
double time_s(int row) {
  return 0.05 * row;
}

/// The two joints and the times of every row, as `fields` writes them.
std::string table(const std::string& headings, const std::function<std::string(int)>& fields) {
  std::string text = headings + "\n";
  for (int row = 0; row < kRows; ++row) text += fields(row) + "\n";
  return text;
}

/// The arm of two joints, the second of which slides.
class JointLogs : public ::testing::Test {
 protected:
  JointLogs() { folder_.write("robot.yaml", kRobotText); }

  Recordings load(const std::string& log, const std::string& table_text) const {
    folder_.write("log.csv", table_text);
    return load_recordings(
        read_preparation(folder_.write("p.yaml", "demecal_preparation: 1\nrobot: robot.yaml\nlog: " + log + "\n")));
  }

  void expect_read(const Recordings& recordings) const {
    ASSERT_EQ(recordings.logs.size(), 1u);
    const JointLog& log = recordings.logs.front();
    ASSERT_EQ(log.times_s.size(), static_cast<std::size_t>(kRows));
    for (int row = 0; row < kRows; ++row) {
      const auto at = static_cast<std::size_t>(row);
      EXPECT_NEAR(log.times_s[at], time_s(row), 2e-6) << row;
      EXPECT_NEAR(log.joints[at][0], angle_rad(row), 1e-9) << row;
      EXPECT_NEAR(log.joints[at][1], length_m(row), 1e-9) << row;
      EXPECT_EQ(log.lines[at], at + 2);
    }
  }

  TemporaryFolder folder_;
};

TEST_F(JointLogs, AreReadWhateverTheirHeadings) {
  const std::string endings[][3] = {
      {"time_s", "q1_rad", "q2_m"},
      {"__time", "/joint_states/arm_joint1/position", "/joint_states/arm_joint2/position"},
      {"timestamp", "field.position0", "field.position1"},
      {"stamp", "arm_joint_1", "arm_joint_2"},
      {"Time [s]", "J1 [rad]", "J2 [m]"}};
  for (const auto& [time, first, second] : endings) {
    SCOPED_TRACE(first);
    expect_read(
        load("log.csv", table(time + "," + first + "," + second + ",/joint_states/arm_joint1/velocity", [](int i) {
               return number_text(time_s(i)) + "," + number_text(angle_rad(i)) + "," + number_text(length_m(i)) + ",7";
             })));
  }
}

TEST_F(JointLogs, AreReadInDegreesMillimetresAndTimesOfDay) {
  const std::string text = table("Zeit;A1;A2", [](int i) {
    const int milliseconds = (50 * i) % 1000;
    const std::string row = "24.11.2026 19:39:" + std::to_string(50 + i / 20) + "." +
                            std::string(milliseconds < 100 ? "0" : "") + (milliseconds < 10 ? "0" : "") +
                            std::to_string(milliseconds);
    return row + ";" + number_text(degrees(angle_rad(i))) + ";" + number_text(1e3 * length_m(i));
  });
  const Recordings recordings = load("log.csv", text);
  expect_read(recordings);
  EXPECT_THAT(recordings.assumed, Contains(HasSubstr("joints are taken to be in deg")));
  EXPECT_THAT(recordings.assumed, Contains(HasSubstr("joints are taken to be in mm")));
}

TEST_F(JointLogs, AreReadWithStampsOfRos) {
  const auto joints = [](int i) { return number_text(angle_rad(i)) + "," + number_text(length_m(i)); };
  const auto nanoseconds = [](int i) { return std::to_string(1'764'000'000'000'000'000LL + 50'000'000LL * i); };
  const Recordings whole = load("log.csv", table("%time,field.position0,field.position1",
                                                 [&](int i) { return nanoseconds(i) + "," + joints(i); }));
  expect_read(whole);
  EXPECT_THAT(whole.assumed, Contains(HasSubstr("times are taken to be nanoseconds since 1970")));
  const Recordings parts = load(
      "{files: {file: log.csv, units: {angle: rad, length: m}, columns: {joints: [3, 4], time: 1, nanoseconds: 2}}}",
      table("a,b,c,d", [&](int i) {
        return "17640000" + std::to_string(10 + i / 20) + "," + std::to_string(50'000'000 * (i % 20)) + "," + joints(i);
      }));
  expect_read(parts);
  EXPECT_THAT(parts.assumed, IsEmpty());
}

TEST_F(JointLogs, FollowOneAnother) {
  const std::string text = table("time_s,q1_rad,q2_m", [](int i) {
    return number_text(time_s(i)) + "," + number_text(angle_rad(i)) + "," + number_text(length_m(i));
  });
  folder_.write("other.csv", text);
  const Recordings recordings = load("{files: [log.csv, {file: other.csv, set: accept}]}", text);
  ASSERT_EQ(recordings.logs.size(), 2u);
  EXPECT_EQ(recordings.logs[0].set, std::nullopt);
  EXPECT_EQ(recordings.logs[1].set, PoseSet::accept);
  EXPECT_EQ(recordings.logs[1].times_s.front(), recordings.logs[0].times_s.back());
  EXPECT_THAT(recordings.assumed, Contains(HasSubstr("taken to follow it at once")));
}

struct BadLog {
  const char* name;
  const char* log;
  const char* headings;
  const char* row;  ///< the twentieth; empty: like the others
  const char* said;
};
std::ostream& operator<<(std::ostream& stream, const BadLog& bad) {
  return stream << bad.name;
}
class BadLogs : public JointLogs, public ::testing::WithParamInterface<BadLog> {};

TEST_P(BadLogs, AreNamedWithFileLineValueAndRule) {
  const BadLog& bad = GetParam();
  const std::string text = table(bad.headings, [&](int i) {
    const bool spoilt = i == 19 && *bad.row != '\0';
    if (spoilt) return std::string(bad.row);
    const std::string further = std::string(bad.headings).ends_with("q3") ? ",0" : "";
    return number_text(time_s(i)) + "," + number_text(angle_rad(i)) + "," + number_text(length_m(i)) + further;
  });
  EXPECT_THAT(complaint([&] { load(bad.log, text); }), HasSubstr(bad.said));
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadLogs,
    ::testing::Values(
        BadLog{"NoJoints", "log.csv", "time_s,one,two", "", "log.csv:1: needs a column for each of the 2 joints"},
        BadLog{"MoreJoints", "log.csv", "time_s,q1,q2,q3", "",
               "log.csv:1: has columns of 3 joints, and the robot has 2"},
        BadLog{"NoTimes", "log.csv", "when,q1_rad,q2_m", "", "log.csv:1: needs a column of times"},
        BadLog{"Backwards", "log.csv", "time_s,q1_rad,q2_m", "0.3,0,0.1",
               "log.csv:21: '0.3': is earlier than the row before"},
        BadLog{"NoNumber", "log.csv", "time_s,q1_rad,q2_m", "0.95,nan,0.1", "log.csv:21"},
        BadLog{"NoFile", "{files: [logg.csv]}", "time_s,q1_rad,q2_m", "", "names a file that does not exist"},
        BadLog{"NoSuchKey", "{files: log.csv, gap: 3}", "time_s,q1_rad,q2_m", "", "p.yaml:3: 'gap': is no key"},
        BadLog{"TwoOfOneName", "{files: log.csv, names: [a, a]}", "time_s,q1_rad,q2_m", "",
               "'a': log.names[2] is named twice"},
        BadLog{"NanosecondsAlone", "{files: {file: log.csv, columns: {joints: [2, 3], nanoseconds: 1}}}",
               "time_s,q1_rad,q2_m", "", "counts from whole seconds"},
        BadLog{"SetsToo", "log.csv\nsets: []", "time_s,q1_rad,q2_m", "", "p.yaml:4: sets says nothing beside `log`"}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace demecal
