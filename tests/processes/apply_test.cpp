// demecal apply: programs in, corrected programs out, and nothing written where something is wrong.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "small_job.hpp"

namespace demecal {
namespace {

using Json = nlohmann::json;

constexpr const char* kVal2 =
    ".PROGRAM t1\r\n MOVE #cp[1]\r\n.END\r\n.LOCATIONS\r\n#cp[1] 40.0 -30.5 140 5 -50 10.25\r\n"
    "#cp[2] 35.0 -40.5 150 -5 -60 0\r\nmcp[1] 16384 0 0 0 -16384 0 0 0 -16384 9600 11200 -1600\r\n.END";
constexpr const char* kCsv =
    "name,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,note\na,40,-30.5,140,5,-50,10.25,\"x, y\"\n";

/// A model found on simulated data, and files beside it.
class Applied {
 public:
  Applied() {
    const Ended ended = run("demecal", {"diagnose", job_.data(), "--declare", "registration,joint_corrections",
                                        "--candidates", "joint_offset,gear_harmonic", "--out", job_.path("out")});
    EXPECT_EQ(ended.code, 0) << ended.err;
  }

  Ended apply(const std::string& program, const std::string& text, std::vector<std::string> more = {},
              const std::string& out = "") {
    std::ofstream(job_.path(program), std::ios::binary) << text;
    std::vector<std::string> arguments{"apply", job_.path("out/model.yaml"), job_.path(program), "--out",
                                       job_.path(out.empty() ? "new-" + program : out)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run("demecal", arguments);
  }

  void declare_home(const std::string& home_deg) {
    const std::string model = job_.text("out/model.yaml"), robot = "\nrobot:\n";
    const std::size_t place = model.find(robot);
    ASSERT_NE(place, std::string::npos) << model;
    std::ofstream(job_.path("out/model.yaml"), std::ios::binary)
        << model.substr(0, place + robot.size()) << "  home_deg: [" << home_deg << "]\n"
        << model.substr(place + robot.size());
  }
  /// As if the check of the model's data had found these.
  void find_in_data(const std::string& kinds) {
    std::string model = job_.text("out/model.yaml");
    const std::size_t place = model.find("sha256: ");
    ASSERT_NE(place, std::string::npos) << model;
    std::ofstream(job_.path("out/model.yaml"), std::ios::binary) << model.insert(place, "findings: [" + kinds + "], ");
  }
  std::string path(const std::string& name) const { return job_.path(name); }
  std::string text(const std::string& name) const { return job_.text(name); }
  std::string result(const std::string& program) const { return job_.text("new-" + program); }
  bool wrote(const std::string& program) const { return std::filesystem::exists(job_.path("new-" + program)); }

 private:
  SmallJob job_;
};

TEST(Apply, NeverOverwritesTheProgramNorFilesThatAreNotOurs) {
  Applied applied;
  const Ended itself = applied.apply("a.csv", kCsv, {}, "a.csv");
  EXPECT_EQ(itself.code, 10);
  EXPECT_NE(itself.err.find("is the program itself"), std::string::npos) << itself.err;
  std::filesystem::create_symlink(applied.path("a.csv"), applied.path("link.csv"));
  std::filesystem::create_hard_link(applied.path("a.csv"), applied.path("hard.csv"));
  EXPECT_EQ(applied.apply("a.csv", kCsv, {}, "link.csv").code, 10);
  EXPECT_EQ(applied.apply("a.csv", kCsv, {"--force"}, "hard.csv").code, 10);
  EXPECT_EQ(applied.text("a.csv"), kCsv);
  std::ofstream(applied.path("other.csv"), std::ios::binary) << "something else\n";
  const Ended other = applied.apply("a.csv", kCsv, {}, "other.csv");
  EXPECT_EQ(other.code, 10);
  EXPECT_NE(other.err.find("--force"), std::string::npos) << other.err;
  EXPECT_EQ(applied.text("other.csv"), "something else\n");
  EXPECT_EQ(applied.apply("a.csv", kCsv, {"--force"}, "other.csv").code, 0);
  EXPECT_TRUE(applied.text("other.csv").starts_with("# corrected by demecal "));
}

TEST(Apply, CorrectsValAndCsvFilesAndWritesNothingWhereSomethingIsWrong) {
  Applied applied;
  const Ended val2 = applied.apply("a.v2", kVal2);
  ASSERT_EQ(val2.code, 0) << val2.err;
  EXPECT_NE(val2.out.find("2 targets corrected"), std::string::npos) << val2.out;
  const std::string corrected = applied.result("a.v2");
  EXPECT_NE(val2.err.find("a.v2:7: mcp[1]: the arm's configuration is not known"), std::string::npos) << val2.err;
  EXPECT_TRUE(corrected.starts_with(".PROGRAM t1\r\n; corrected by demecal ")) << corrected;
  const std::string kept(" MOVE #cp[1]\r\n.END\r\n.LOCATIONS\r\n#cp[1] ");
  EXPECT_NE(corrected.find(kept), std::string::npos) << corrected;
  EXPECT_NE(corrected, kVal2);
  EXPECT_NE(corrected.find("\r\nmcp[1] 16384 0 0 0 -16384 0 0 0 -16384 "), std::string::npos) << corrected;
  EXPECT_TRUE(corrected.ends_with("\r\n.END"));

  const Ended csv = applied.apply("b.csv", kCsv, {"--json"});
  ASSERT_EQ(csv.code, 0) << csv.err;
  const Json summary = Json::parse(csv.out);
  ASSERT_EQ(summary["targets"].size(), 1u);
  EXPECT_EQ(summary["targets"][0]["nominal"].size(), 6u);
  EXPECT_GT(summary["targets"][0]["moved_mm"], 0.1);
  EXPECT_TRUE(applied.result("b.csv").ends_with(",\"x, y\"\n"));

  const Ended broken = applied.apply("c.csv", "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n1,2,3,4,5,six\n");
  EXPECT_EQ(broken.code, 11);
  EXPECT_NE(broken.err.find("c.csv:2: 'six': must be a number (column 11)"), std::string::npos) << broken.err;
  EXPECT_FALSE(applied.wrote("c.csv"));

  const std::string outside = "#cp[1] 350 -30.5 140 5 -50 10.25\n";
  EXPECT_EQ(applied.apply("d.v2", ".LOCATIONS\n" + outside).code, 0);
  const Ended strict = applied.apply("e.v2", ".LOCATIONS\n" + outside, {"--strict"});
  EXPECT_EQ(strict.code, 11);
  EXPECT_NE(strict.err.find("e.v2:2: #cp[1]: joint 1 is sent to 350.0000 deg, outside its limits"), std::string::npos)
      << strict.err;
  EXPECT_FALSE(applied.wrote("e.v2"));

  const Ended again = applied.apply("new-a.v2", corrected);
  EXPECT_EQ(again.code, 11);
  EXPECT_NE(again.err.find("new-a.v2:2: "), std::string::npos) << again.err;
  EXPECT_NE(again.err.find("was corrected already"), std::string::npos) << again.err;
  EXPECT_EQ(applied.apply("a.v2", kVal2, {"--near", "40,-30.5,140,5,-50,10.25"}).code, 0)
      << "ours may be written again";
  EXPECT_EQ(applied.apply("a.v2", kVal2, {"--near", "40,-30.5"}).code, 10);

  EXPECT_EQ(applied.apply("f.v2", kVal2, {"--language", "logo"}).code, 10);
  EXPECT_EQ(applied.apply("g.txt", "hello\n").code, 11);
}

TEST(Apply, SaysWhatATextWithoutMotionsIs) {
  Applied applied;
  const Ended none = applied.apply("hello.ls", "Hello, world.\n");
  EXPECT_EQ(none.code, 11);
  EXPECT_NE(none.err.find("hello.ls: is no program in FANUC"), std::string::npos) << none.err;
  EXPECT_FALSE(applied.wrote("hello.ls"));
  const std::string program = "/PROG  HELLO\n/MN\n   1:  DO[1]=ON ;\n/POS\n/END\n";
  const Ended still = applied.apply("still.ls", program);
  EXPECT_EQ(still.code, 0);
  EXPECT_NE(still.err.find("still.ls: it holds no motion and no point: there is nothing to correct"), std::string::npos)
      << still.err;
  EXPECT_EQ(applied.result("still.ls"), program);
  EXPECT_EQ(applied.apply("strict.ls", program, {"--strict"}).code, 11);
}

TEST(Apply, WritesTheFilesOfAProgramIntoAFolder) {
  Applied applied;
  const std::string source = "DEF a()\nPTP XP1\nEND\n";
  const std::string data = "DEFDAT a\nDECL E6AXIS XP1={A1 40.0,A2 -30.5,A3 140.0,A4 5.0,A5 -50.0,A6 10.25}\nENDDAT\n";
  std::ofstream(applied.path("a.dat"), std::ios::binary) << data;
  const std::vector<std::string> with{"--with", applied.path("a.dat")};
  const Ended alone = applied.apply("a.src", source);
  EXPECT_EQ(alone.code, 0) << alone.err;
  EXPECT_NE(alone.err.find("a.src: a.dat beside it, which usually belongs to the program, was not read"),
            std::string::npos)
      << alone.err;
  const Ended both = applied.apply("a.src", source, with, "corrected");
  ASSERT_EQ(both.code, 0) << both.err;
  EXPECT_EQ(both.err.find("beside it"), std::string::npos) << both.err;
  EXPECT_NE(both.out.find("a.dat:2: XP1"), std::string::npos) << both.out;
  EXPECT_EQ(applied.text("corrected/a.src"), source);
  const std::string corrected = applied.text("corrected/a.dat");
  EXPECT_TRUE(corrected.starts_with("DEFDAT a\n; corrected by demecal ")) << corrected;
  EXPECT_EQ(corrected.find("A1 40.0,"), std::string::npos) << corrected;

  EXPECT_EQ(applied.apply("a.src", source, with, "corrected").code, 0) << "ours may be written again";
  EXPECT_EQ(applied.apply("a.src", source, with, ".").code, 10) << "the folder of the program itself";
  EXPECT_EQ(applied.text("a.dat"), data);
  EXPECT_EQ(applied.apply("a.src", source, with, "new-a.src").code, 10) << "a file";
  EXPECT_EQ(applied.apply("a.src", source, with, "new-a.src/deeper").code, 10) << "below a file";
  EXPECT_EQ(applied.apply("a.src", source, {"--with", applied.path("a.src")}, "twice").code, 10);
  EXPECT_EQ(applied.apply("a.src", source, {"--with", applied.path("b.dat")}, "lacking").code, 11);
  const Ended again = applied.apply("a.src", source, {"--with", applied.path("corrected/a.dat")}, "again");
  EXPECT_EQ(again.code, 11);
  EXPECT_NE(again.err.find("corrected/a.dat:2: "), std::string::npos) << again.err;
  std::ofstream(applied.path("corrected/a.dat"), std::ios::binary) << "another's\n";
  EXPECT_EQ(applied.apply("a.src", source, with, "corrected").code, 10);
  EXPECT_EQ(applied.text("corrected/a.dat"), "another's\n");
  EXPECT_EQ(applied.apply("a.csv", kCsv, with, "tables").code, 11) << "a table is one file";
}

TEST(Apply, TakesFramesToolsAndPulsesThatTheControllerKeeps) {
  Applied applied;
  const std::string tool =
      "/PROG  A\n/MN\n/POS\nP[1]{\n   GP1:\n\tUF : 0, UT : 2,\n\tJ1= 40.0 deg, J2= -30.5 deg, J3= 140.0 deg,\n\t"
      "J4= 5.0 deg, J5= -50.0 deg, J6= 10.25 deg\n};\n/END\n";
  const Ended unknown = applied.apply("a.ls", tool);
  EXPECT_EQ(unknown.code, 0) << unknown.err;
  EXPECT_NE(unknown.err.find("a.ls:4: P[1]: UT 2 is given neither in this program nor by --frames"), std::string::npos)
      << unknown.err;
  EXPECT_EQ(applied.result("a.ls"), tool);
  std::ofstream(applied.path("frames.yaml")) << "demecal_frames: 1\ntools:\n  2: {xyz_mm: [0, 0, 100], rpy_deg: [0, 0, "
                                                "0]}\n";
  const Ended known = applied.apply("a.ls", tool, {"--frames", applied.path("frames.yaml")});
  EXPECT_EQ(known.code, 0) << known.err;
  EXPECT_NE(applied.result("a.ls"), tool) << known.err;
  EXPECT_EQ(applied.apply("a.ls", tool, {"--frames", applied.path("a.ls")}).code, 11);

  const std::string job =
      "/JOB\n//POS\n///PULSE\nC00001=40000,-30500,140000,5000,-50000,10250\n//INST\nNOP\nMOVJ "
      "C00001 VJ=5.00\nEND\n";
  const Ended pulses = applied.apply("a.jbi", job);
  EXPECT_NE(pulses.err.find("a.jbi:4: C00001: it is in pulses"), std::string::npos) << pulses.err;
  EXPECT_EQ(applied.result("a.jbi"), job);
  const Ended counted = applied.apply("a.jbi", job, {"--json", "--pulses-per-deg", "1000,1000,1000,1000,1000,1000"});
  ASSERT_EQ(counted.code, 0) << counted.err;
  EXPECT_NEAR(Json::parse(counted.out)["targets"][0]["nominal"][1].get<double>(), -30.5, 1e-9);
  EXPECT_NE(applied.result("a.jbi"), job);
  EXPECT_EQ(applied.apply("a.jbi", job, {"--pulses-per-deg", "1000,1000"}).code, 10);
  EXPECT_EQ(applied.apply("a.jbi", job, {"--pulses-per-deg", "1000,1000,1000,1000,1000,0"}).code, 10);
}

TEST(Apply, ADeclaredHomeTellsTheConfigurationAsNearDoes) {
  Applied applied;
  const std::string unknown = "the arm's configuration is not known", home = "40,-30,188,0,-60,-136";
  const std::string pose_alone = ".LOCATIONS\nmcp[1] 16384 0 0 0 -16384 0 0 0 -16384 9600 11200 -1600\n.END\n";
  EXPECT_NE(applied.apply("a.v2", pose_alone).err.find(unknown), std::string::npos);
  const Ended told = applied.apply("a.v2", pose_alone, {"--near", home});
  EXPECT_EQ(told.err.find(unknown), std::string::npos) << told.err;
  const std::string near = applied.result("a.v2");
  ASSERT_NO_FATAL_FAILURE(applied.declare_home(home));
  const Ended at_home = applied.apply("a.v2", pose_alone);
  EXPECT_EQ(at_home.code, 0) << at_home.err;
  EXPECT_EQ(at_home.err.find(unknown), std::string::npos) << at_home.err;
  EXPECT_EQ(applied.result("a.v2"), near);
}

TEST(Apply, TakesAToolPointWithBlanksOrCommas) {
  Applied applied;
  EXPECT_EQ(applied.apply("a.csv", kCsv, {"--tool-mm", "10", "-20", "150"}).code, 0);
  EXPECT_EQ(applied.apply("b.csv", kCsv, {"--tool-mm", "10,-20,150"}).code, 0);
  EXPECT_EQ(applied.result("a.csv"), applied.result("b.csv"));
  EXPECT_EQ(applied.apply("c.csv", kCsv, {"--tool-mm", "10,-20"}).code, 10);
}

TEST(Apply, SaysFirstThatTheDataOfTheModelHadFindings) {
  Applied applied;
  EXPECT_EQ(applied.apply("a.csv", kCsv).err.find("check of the data"), std::string::npos);
  applied.find_in_data("wrong_contact, outlier");
  const Ended doubtful = applied.apply("b.csv", kCsv, {"--strict"});
  EXPECT_EQ(doubtful.code, 0) << doubtful.err;
  const std::string first = doubtful.err.substr(0, doubtful.err.find('\n'));
  EXPECT_NE(first.find("(wrong_contact, outlier)"), std::string::npos) << doubtful.err;
}

TEST(Apply, WarnsWhereTheDataOfTheModelContradictTheArm) {
  Applied applied;
  applied.find_in_data("joint_sign");
  const Ended contradicted = applied.apply("a.csv", kCsv);
  EXPECT_EQ(contradicted.code, 0);
  const std::string first = contradicted.err.substr(0, contradicted.err.find('\n'));
  EXPECT_NE(first.find("contradict the arm (joint_sign)"), std::string::npos) << contradicted.err;
  EXPECT_EQ(applied.apply("b.csv", kCsv, {"--strict"}).code, 11);
  EXPECT_FALSE(applied.wrote("b.csv"));
}

}  // namespace
}  // namespace demecal
