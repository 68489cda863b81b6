// What ROS 2 and other DDS programs are told of the unkeyed topics is what the document of the protocol says of the
// same messages, which the lists of fields are held to.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <sstream>

namespace demecal {
namespace {

const std::string kDocuments = DEMECAL_SOURCE_DIR;
const std::vector<std::string> kMirrored{"CauseFound", "Control",  "FinalFigures",
                                         "LoopNews",   "Progress", "WorkerStatus"};

/// Without comments, in one line.
std::string code_in(const std::string& path, const std::string& comment) {
  std::ifstream file(kDocuments + path);
  std::stringstream text;
  for (std::string line; std::getline(file, line);) text << line.substr(0, line.find(comment)) << ' ';
  return std::regex_replace(text.str(), std::regex("\\s+"), " ");
}

std::string fields_of(const std::string& document, const std::string& name) {
  std::smatch match;
  const std::string code = code_in(document, "//");
  return std::regex_search(code, match, std::regex("struct " + name + " \\{ ([^}]*?) ?\\};")) ? match[1].str() : "";
}

std::string replaced(const std::string& text, const char* pattern, const char* by) {
  return std::regex_replace(text, std::regex(pattern), by);
}

/// The fields as they stand in the protocol, without keys and what a place takes.
std::string mirrored(const std::string& name) {
  const std::string fields = fields_of("/idl/calibration.idl", name == "Progress" ? "PlacedProgress" : name);
  return replaced(replaced(fields, "^@key string<255> writer; @key uint32 place; boolean over; ", ""), "@key ", "");
}

TEST(Ros2Interface, HasTheFieldsOfTheProtocol) {
  for (const std::string& name : kMirrored) {
    const std::string expected = mirrored(name);
    EXPECT_FALSE(expected.empty()) << name;
    EXPECT_EQ(fields_of("/idl/ros2.idl", name + "_"), expected);
  }
  EXPECT_EQ(fields_of("/idl/ros2.idl", "String_"), "string data;");
}

TEST(Ros2Interface, HasNoKeysAndOnlyFinalTypes) {
  const std::string code = code_in("/idl/ros2.idl", "//");
  EXPECT_EQ(code.find("@key"), std::string::npos);
  const auto count = [&](const std::string& pattern) {
    const std::regex all(pattern);
    return std::distance(std::sregex_iterator(code.begin(), code.end(), all), std::sregex_iterator());
  };
  EXPECT_EQ(count("@final struct"), count("struct"));
  EXPECT_EQ(count("struct"), 7);
}

TEST(Ros2Interface, MessageDefinitionsSayTheSame) {
  for (const std::string& name : kMirrored) {
    std::string expected = replaced(mirrored(name), ";", "");
    expected = replaced(expected, "string<(\\d+)>", "string<=$1");
    expected = replaced(replaced(expected, "\\bdouble\\b", "float64"), "boolean ", "bool ");
    expected = replaced(expected, "sequence<(\\w+), (\\d+)>", "$1[<=$2]");
    std::string written = code_in("/configs/ros2/demecal/msg/" + name + ".msg", "#");
    written = replaced(replaced(written, "^ +", ""), " +$", "");
    EXPECT_EQ(written, expected) << name;
  }
}

}  // namespace
}  // namespace demecal
