// demecal check: an arm that changed is told from data that are not what they say.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using Cells = std::vector<std::string>;

/// A model found on simulated data, and checks of the same poses as somebody else hands them in.
class Checked {
 public:
  Checked() {
    const Ended ended = run("demecal", {"diagnose", job_.data(), "--declare", "registration,joint_corrections",
                                        "--candidates", "joint_offset,gear_harmonic", "--out", job_.path("out")});
    EXPECT_EQ(ended.code, 0) << ended.err;
    std::istringstream lines(job_.text("data/poses.csv"));
    for (std::string line; std::getline(lines, line);) {
      Cells& cells = rows_.emplace_back();
      std::istringstream in(line);
      for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    }
  }

  /// Of the first 20 poses; `change` is called with the row and the cell's column.
  Ended check(
      const std::function<std::string(std::size_t row, const std::string& column, const std::string& cell)>& change =
          [](std::size_t, const std::string&, const std::string& cell) { return cell; },
      std::vector<std::string> more = {}) {
    std::ofstream file(job_.path("data/poses.csv"));
    for (std::size_t row = 0; row <= 20; ++row) {
      for (std::size_t i = 0; i < rows_[row].size(); ++i)
        file << (i > 0 ? "," : "") << (row == 0 ? rows_[0][i] : change(row, rows_[0][i], rows_[row][i]));
      file << '\n';
    }
    file.close();
    std::vector<std::string> arguments{"check", job_.path("out/model.yaml"), job_.data()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run("demecal", arguments);
  }

  std::string path(const std::string& name) const { return job_.path(name); }

 private:
  SmallJob job_;
  std::vector<Cells> rows_;
};

bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

bool measures(const std::string& column) {
  return column == "x_mm" || column == "y_mm" || column == "z_mm";
}

std::string scaled(const std::string& cell, double factor) {
  return std::to_string(factor * std::stod(cell));
}

TEST(Check, DoesNotTakeMistakesOfTheDataForAChangedRobot) {
  Checked robot;
  const std::string history = robot.path("history");
  const Ended metres = robot.check([](std::size_t, const std::string& column,
                                      const std::string& cell) { return measures(column) ? scaled(cell, 1e-3) : cell; },
                                   {"--history", history});
  EXPECT_EQ(metres.code, 12) << metres.out;
  EXPECT_TRUE(says(metres.err, "positions are in metres where millimetres are stated")) << metres.err;
  EXPECT_FALSE(std::filesystem::exists(history)) << "what is no check has no place in the record of checks";
  const Ended radians = robot.check([](std::size_t, const std::string& column, const std::string& cell) {
    return column.ends_with("_deg") ? scaled(cell, std::numbers::pi / 180.0) : cell;
  });
  EXPECT_EQ(radians.code, 12) << radians.out;
  EXPECT_TRUE(says(radians.err, "joint angles are in radians")) << radians.err;
  const Ended sign = robot.check([](std::size_t, const std::string& column, const std::string& cell) {
    return column == "q2_deg" ? scaled(cell, -1.0) : cell;
  });
  EXPECT_EQ(sign.code, 12) << sign.out;
}

TEST(Check, NamesARowThatIsWrongAndJudgesTheOthers) {
  Checked robot;
  const Ended same = robot.check();
  EXPECT_EQ(same.code, 0) << same.out << same.err;
  EXPECT_FALSE(says(same.err, "fit")) << same.err;
  const Ended typed = robot.check([](std::size_t row, const std::string& column, const std::string& cell) {
    return row == 6 && column == "q3_deg" ? std::to_string(std::stod(cell) + 10.0) : cell;
  });
  EXPECT_EQ(typed.code, 0) << typed.out;
  EXPECT_TRUE(says(typed.err, "if joint 3 is")) << typed.err;
  EXPECT_TRUE(says(typed.out, "(line 7)")) << typed.out;
}

TEST(Check, TellsARobotThatChangedHoweverMuch) {
  Checked robot;
  for (const double mrad : {1.0, 5.0, 20.0}) {
    const Ended zero = robot.check([&](std::size_t, const std::string& column, const std::string& cell) {
      return column == "q3_deg" ? std::to_string(std::stod(cell) + mrad * 0.18 / std::numbers::pi) : cell;
    });
    EXPECT_EQ(zero.code, 13) << mrad << zero.err;
    EXPECT_TRUE(says(zero.out, "The zero of joint 3 is off")) << mrad << zero.out;
  }
}

TEST(Check, NamesAZeroThatIsSoFarOffThatTheDataLookLikeThoseOfAnotherRobot) {
  Checked robot;
  const auto moved = [](double by_deg) {
    return [by_deg](std::size_t, const std::string& column, const std::string& cell) {
      return column == "q5_deg" ? std::to_string(std::stod(cell) - by_deg)
             : column == "x_mm" ? std::to_string(std::stod(cell) + 3.0)
                                : cell;
    };
  };
  const Ended zero = robot.check(moved(30.0));
  EXPECT_EQ(zero.code, 13) << zero.err;
  EXPECT_TRUE(says(zero.out, "The zero of joint 5 is off by 52")) << zero.out;
  EXPECT_TRUE(says(zero.out, "far more than wear")) << zero.out;
  EXPECT_TRUE(says(zero.out, "master it again")) << zero.out;
  EXPECT_FALSE(says(zero.err, "not of this robot")) << zero.err;
  EXPECT_TRUE(says(robot.check(moved(30.0), {"--json"}).out, "\"far_beyond_usual\":true"));
  const Ended other = robot.check([](std::size_t, const std::string& column, const std::string& cell) {
    return column == "q3_deg" ? scaled(cell, 0.8) : cell;
  });
  EXPECT_EQ(other.code, 12) << other.out;
  EXPECT_TRUE(says(other.err, "not of this robot")) << other.err;
}

TEST(Check, SaysWhatItCannotTellAChangeFrom) {
  const SmallJob job;
  ASSERT_EQ(run("demecal", {"diagnose", job.data(), "--declare", "registration,joint_corrections", "--candidates",
                            "joint_offset", "--out", job.path("out")})
                .code,
            0);
  const Ended own = run("demecal", {"check", job.path("out/model.yaml"), job.data()});
  EXPECT_EQ(own.code, 0) << own.out;
  EXPECT_TRUE(says(own.err, "made from these very poses")) << own.err;
  std::string model = job.text("out/model.yaml");
  const std::size_t begin = model.find("# Covariance of these numbers"),
                    end = model.find("\nprediction_interval:", begin);
  ASSERT_NE(end, std::string::npos);
  std::ofstream(job.path("unsure.yaml")) << model.erase(begin, end + 1 - begin);
  const Ended unsure = run("demecal", {"check", job.path("unsure.yaml"), job.data()});
  EXPECT_EQ(unsure.code, 11) << unsure.out;
  EXPECT_TRUE(says(unsure.err, "nothing says how sure the model's numbers are")) << unsure.err;
}

}  // namespace
}  // namespace demecal
