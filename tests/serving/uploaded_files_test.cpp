// Uploaded YAML names uploaded files only, however it is written.
#include "serving/job_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "errors/input_error.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::set<std::string> kUploaded{"job.yaml", "data.yaml", "arm.yml", "poses.csv", "arm.urdf", "trap.csv"};

/// The sentence that the YAML is refused with; empty where it is not.
std::string refusal_of(const std::string& text) {
  try {
    check_named_files(parse_yaml(text, "job.yaml"), kUploaded);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(NamedFiles, MayLieBesideTheFileThatNamesThem) {
  for (const char* const text :
       {"demecal_job: 1\ndata: data.yaml\nseed: 3\n", "data: ./data.yaml\n", "data: [data.yaml, missing.yaml]\n",
        "robot: arm.yml\nposes: poses.csv\n", "poses: [{file: poses.csv}, {file: trap.csv}]\n", "poses: [poses.csv]\n",
        "urdf: {file: arm.urdf, base: base_link}\n", "name: a... b\n", "name: 'x / y'\n",
        "joint_errors: [{joint: 1, formula: \"0.004 * SIN(2 * theta - 1.2) / 2\"}]\n", "data: ..data.yaml\n"}) {
    EXPECT_EQ(refusal_of(text), "") << text;
  }
}

TEST(NamedFiles, AreNowhereElse) {
  for (const char* const text :
       {"data: /etc/passwd\n", "data: ../other/data.yaml\n", "data: x/../../other/data.yaml\n", "data: ..\n",
        "data: [data.yaml, ../b.yaml]\n", "data: {stations: [/a.yaml]}\n", "robot: \"\\x2fetc/passwd\"\n",
        "robot: \"..\\u002fx\"\n", "robot: \"data.yaml\\0/../../x\"\n", "robot: >-\n  /etc/passwd\n",
        "poses: &p ../poses.csv\n", "a: &x /abs\nb: *x\n", "gp: {seed_models: [../model.yaml]}\n",
        "poses: [{file: /dev/zero}]\n", "urdf: {file: //x}\n", "anything: {that: {comes: [later, '/x']}}\n"}) {
    EXPECT_THAT(refusal_of(text), HasSubstr("uploaded files only")) << text;
  }
  EXPECT_THAT(refusal_of("demecal_job: 1\n\ndata: ../x.yaml\n"), HasSubstr("job.yaml:3: '../x.yaml'"));
}

TEST(NamedFiles, AreReadAsYamlOnlyWhereTheyAreCheckedAsYaml) {
  for (const char* const text : {"data: trap.csv\n", "data: [data.yaml, ./trap.csv]\n", "robot: .//trap.csv\n",
                                 "gp: {seed_models: [trap.csv]}\n", "data: {stations: [poses.csv]}\n"}) {
    EXPECT_THAT(refusal_of(text), HasSubstr("must end in .yaml")) << text;
  }
}

TEST(Job, IsTheOneThatSaysItIs) {
  const auto parsed = [](const char* text) { return parse_yaml(text, "x.yaml"); };
  const YamlNode data = parsed("demecal_dataset: 1\n"), job = parsed("demecal_job: 1\ndata: d.yaml\n");
  const JobFiles found = find_job({{"d.yaml", data}, {"run.yaml", job}});
  EXPECT_EQ(found.job, "run.yaml");
  EXPECT_THAT(found.data, ElementsAre("d.yaml"));
  EXPECT_THAT(find_job({{"j.yaml", parsed("demecal_job: 1\ndata: [a.yaml, b.yaml]\n")}}).data,
              ElementsAre("a.yaml", "b.yaml"));
  EXPECT_THAT(find_job({{"j.yaml", parsed("demecal_job: 1\ndata: {stations: [a.yaml], tool: shared}\n")}}).data,
              ElementsAre("a.yaml"));
  EXPECT_THAT(find_job({{"j.yaml", parsed("demecal_job: 1\n")}}).data, ElementsAre());
  EXPECT_THROW(find_job({}), InputError);
  EXPECT_THROW(find_job({{"d.yaml", data}}), InputError);
  EXPECT_THROW(find_job({{"a.yaml", job}, {"b.yaml", job}}), InputError);
  EXPECT_THROW(find_job({{"list.yaml", parsed("[demecal_job]\n")}}), InputError);
}

}  // namespace
}  // namespace demecal
