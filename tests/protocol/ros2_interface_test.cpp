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
const std::vector<std::string> kMirrored{"CauseFound", "Control",  "EpochFigures", "FinalFigures",
                                         "LoopNews",   "Progress", "WorkerStatus"};
const std::regex kEnumerations("\\b(RunState|Stage|RoundVerdict) (?=\\w+;)");

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

/// The fields as they stand in the protocol, without keys, enumerations as numbers.
std::string mirrored(const std::string& name) {
  const std::string fields = replaced(fields_of("/idl/calibration.idl", name), "@key ", "");
  return std::regex_replace(fields, kEnumerations, "uint32 ");
}

TEST(Ros2Interface, HasTheFieldsOfTheProtocol) {
  for (const std::string& name : kMirrored) {
    const std::string expected = replaced(mirrored(name), "<EpochFigures,", "<EpochFigures_,");
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
  EXPECT_EQ(count("struct"), 8);
}

TEST(Ros2Interface, MessageDefinitionsSayTheSame) {
  const std::string protocol = code_in("/idl/calibration.idl", "//");
  for (const std::string& name : kMirrored) {
    std::string expected;
    const std::string fields = fields_of("/idl/calibration.idl", name);
    for (std::sregex_iterator found(fields.begin(), fields.end(), kEnumerations), end; found != end; ++found) {
      std::smatch values;
      ASSERT_TRUE(std::regex_search(protocol, values, std::regex("enum " + (*found)[1].str() + " \\{ ([^}]*) \\}")));
      std::istringstream words(replaced(values[1].str(), ",", ""));
      int number = 0;
      for (std::string word; words >> word;) expected += "uint32 " + word + " = " + std::to_string(number++) + ' ';
    }
    expected += replaced(mirrored(name), ";", "");
    expected = replaced(expected, "string<(\\d+)>", "string<=$1");
    expected = replaced(expected, "sequence<(\\w+), (\\d+)>", "$1[<=$2]");
    expected = replaced(replaced(expected, "double ", "float64 "), "boolean ", "bool ");
    std::string written = code_in("/configs/ros2/demecal/msg/" + name + ".msg", "#");
    written = replaced(replaced(written, "^ +", ""), " +$", "");
    EXPECT_EQ(written, expected) << name;
  }
}

}  // namespace
}  // namespace demecal
