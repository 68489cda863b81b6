// demecal robot: arms from URDFs, and where they stand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::json;

const std::string kSeed = std::string(DEMECAL_SOURCE_DIR) + "/tests/fuzz/seeds/arm.urdf";

TEST(Robot, IsImportedAndShownWhereItsUrdfHasIt) {
  SmallJob job;
  const std::string robot = job.path("robot.yaml");
  const Ended imported = run("demecal", {"robot", "import", kSeed, "--out", robot});
  ASSERT_EQ(imported.code, 0) << imported.err;
  EXPECT_THAT(imported.out, AllOf(HasSubstr("2 joints"), HasSubstr("from link base to link tool0")));
  const Ended shown = run("demecal", {"robot", "show", robot, "--at", "-90,90", "--json"});
  ASSERT_EQ(shown.code, 0) << shown.err;
  EXPECT_THAT(shown.err, IsEmpty());
  const Json pose = Json::parse(shown.out);
  EXPECT_EQ(pose["joints"][1]["type"], "continuous");
  // 400 up, 300 along x (90 deg by the origin, -90 deg by the joint), and then 100 along what was z and is x now.
  const double expected[] = {400.0, 0.0, 400.0};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(pose["position_mm"][i].get<double>(), expected[i], 1e-4);
    EXPECT_EQ(pose["tool_position_mm"][i], pose["position_mm"][i]);
  }
  EXPECT_THAT(run("demecal", {"robot", "show", robot}).out,
              AllOf(HasSubstr("turns on and on"), HasSubstr("KUKA, A B C deg")));
  EXPECT_EQ(run("demecal", {"robot", "import", kSeed, "--out", robot}).code, 0);
}

TEST(Robot, HasItsMassesAndInertiasShown) {
  SmallJob job;
  std::ostringstream seed;
  seed << std::ifstream(kSeed).rdbuf();
  std::string urdf = seed.str();
  const std::string inertial =
      "<inertial><mass value=\"2\"/><origin xyz=\"0 0 0.1\"/><inertia ixx=\"0.02\" ixy=\"0.001\" ixz=\"0\" "
      "iyy=\"0.03\" iyz=\"0\" izz=\"0.04\"/></inertial>";
  const std::size_t at = urdf.find("<joint");
  ASSERT_NE(at, std::string::npos);
  urdf.insert(at,
              "<joint name=\"weighed\" type=\"fixed\"><parent link=\"tool0\"/><child link=\"weight\"/></joint>\n"
              "<link name=\"weight\">" +
                  inertial + "</link>\n");
  std::ofstream(job.path("weighed.urdf")) << urdf;
  const std::string robot = job.path("robot.yaml");
  const Ended imported =
      run("demecal", {"robot", "import", job.path("weighed.urdf"), "--tip", "tool0", "--out", robot});
  ASSERT_EQ(imported.code, 0) << imported.err;
  EXPECT_THAT(job.text("robot.yaml"), HasSubstr("inertia_kgm2: ["));
  const Json links = Json::parse(run("demecal", {"robot", "show", robot, "--json"}).out)["links"];
  ASSERT_EQ(links.size(), 2u);
  EXPECT_EQ(links[1]["inertia_kgm2"].size(), 6u);
  EXPECT_THAT(run("demecal", {"robot", "show", robot}).out, HasSubstr("principal moments"));
}

TEST(Robot, BeyondItsLimitsIsShownWithAWarning) {
  SmallJob job;
  const std::string robot = job.path("robot.yaml");
  ASSERT_EQ(run("demecal", {"robot", "import", kSeed, "--out", robot}).code, 0);
  const Ended shown = run("demecal", {"robot", "show", robot, "--at", "170,1000", "--json"});
  EXPECT_EQ(shown.code, 0);
  EXPECT_THAT(shown.err, HasSubstr("joint 1 at 170 deg is beyond its limits"));
  EXPECT_EQ(Json::parse(shown.out)["warnings"].size(), 1u);
  EXPECT_EQ(run("demecal", {"robot", "show", robot, "--at", "1,2,3"}).code, 10);
  EXPECT_EQ(run("demecal", {"robot", "show", robot, "--at", "1,x"}).code, 10);
  EXPECT_EQ(run("demecal", {"robot", "show", robot, "--at", "1,,2"}).code, 10);
  EXPECT_EQ(run("demecal", {"robot", "show", robot, "--at", "170 1000", "--json"}).out, shown.out);
  EXPECT_EQ(run("demecal", {"robot", "import", robot, "--out", job.path("two.yaml")}).code, 11);
  EXPECT_EQ(run("demecal", {"robot", "import", kSeed, "--tip", "c", "--out", job.path("two.yaml")}).code, 11);
  EXPECT_FALSE(std::filesystem::exists(job.path("two.yaml")));
}

TEST(Robot, ComesBackAsItsUrdf) {
  SmallJob job;
  const std::string robot = job.path("robot.yaml");
  ASSERT_EQ(run("demecal", {"robot", "import", kSeed, "--out", robot}).code, 0);
  const Ended exported = run("demecal", {"export", robot, "--format", "urdf", "--out", job.path("again.urdf")});
  ASSERT_EQ(exported.code, 0) << exported.err;
  std::ostringstream seed;
  seed << std::ifstream(kSeed).rdbuf();
  EXPECT_EQ(job.text("again.urdf"), seed.str());
}

}  // namespace
}  // namespace demecal
