// The strict wrapper of YAML: nodes, their lines and their complaints; text that reads back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "../config/temporary_folder.hpp"
#include "yaml/yaml_node.hpp"
#include "yaml/yaml_text.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;

YamlNode yaml(const std::string& text) {
  return parse_yaml(text, "f.yaml");
}

TEST(Yaml, KnowsKeysAndLines) {
  const YamlNode root = yaml("a: 1\nb:\n  - {c: 2}\n  - c: 3\n    d: [4, 5]\n");
  EXPECT_EQ(root.at("b").line, 2u);
  const YamlNode& c = root.at("b").list()[1].at("c");
  EXPECT_EQ(c.key, "b[2].c");
  EXPECT_EQ(c.line, 4u);
  EXPECT_THAT(root.at("b").list()[1].at("d").numbers(), ElementsAre(4.0, 5.0));
  EXPECT_EQ(root.find("z"), nullptr);
}

TEST(Yaml, ReadsScalarsOfEveryKind) {
  const YamlNode root =
      yaml("n: -1.5e-3\ni: -7\ns: 18446744073709551615\nt: true\nw: a word\nv: [1, 2, 3]\nr: [-1, 2]\n");
  EXPECT_EQ(root.at("n").number(), -1.5e-3);
  EXPECT_EQ(root.at("i").whole_number(-10, 10), -7);
  EXPECT_EQ(root.at("s").seed(), 18446744073709551615u);
  EXPECT_TRUE(root.at("t").boolean());
  EXPECT_EQ(root.at("w").text(), "a word");
  EXPECT_EQ(root.at("v").vector3(), Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(root.at("r").range(), std::pair(-1.0, 2.0));
}

TEST(Yaml, ComplainsWithFileLineValueKeyAndRule) {
  const YamlNode root = yaml("n: many\nq: \"5\"\ne:\nl: [1, 2]\nm: {a: 1}\nf: 1.5\nb: yes\nr: [2, 1]\nk: .nan\n");
  const auto said = [&](const char* key, auto ask) { return complaint([&] { ask(root.at(key)); }); };
  const auto number = [](const YamlNode& n) { n.number(); };
  EXPECT_EQ(said("n", number), "f.yaml:1: 'many': n must be a number");
  EXPECT_EQ(said("q", number), "f.yaml:2: '5': q must be a number");
  EXPECT_EQ(said("e", number), "f.yaml:3: e must be a number");
  EXPECT_EQ(said("k", number), "f.yaml:9: '.nan': k must be a number");
  EXPECT_EQ(said("l", [](const YamlNode& n) { n.vector3(); }), "f.yaml:4: l must have 3 elements, not 2");
  EXPECT_EQ(said("l", [](const YamlNode& n) { n.at("a"); }), "f.yaml:4: l must be a map of keys and values");
  EXPECT_EQ(said("m", [](const YamlNode& n) { n.list(); }), "f.yaml:5: m must be a list");
  EXPECT_EQ(said("m", [](const YamlNode& n) { n.at("b"); }), "f.yaml:5: m.b is missing");
  EXPECT_EQ(said("m", [](const YamlNode& n) { n.text(); }), "f.yaml:5: m must be a text");
  EXPECT_EQ(said("f", [](const YamlNode& n) { n.whole_number(0, 9); }), "f.yaml:6: '1.5': f must be a whole number");
  EXPECT_EQ(said("f", [](const YamlNode& n) { n.number(2.0, 3.0); }), "f.yaml:6: '1.5': f must lie within 2 to 3");
  EXPECT_EQ(said("b", [](const YamlNode& n) { n.boolean(); }),
            "f.yaml:7: 'yes': b must be one of: true false; the nearest is 'true'");
  EXPECT_EQ(said("r", [](const YamlNode& n) { n.range(); }), "f.yaml:8: '[2, 1]': r must rise from lower to upper");
}

TEST(Yaml, NamesTheNearestKey) {
  const YamlNode root = yaml("gp:\n  population: 3\n");
  EXPECT_EQ(complaint([&] {
              root.at("gp").with_keys({"tournament_size", "population_size"});
            }),
            "f.yaml:2: 'population': is no key of gp; the nearest is 'population_size'. Keys that are allowed here: "
            "tournament_size population_size");
  EXPECT_EQ(complaint([&] {
              root.with_keys({"gd", "go"});
            }),
            "f.yaml:1: 'gp': is no key; the nearest is 'gd'. Keys that are allowed here: gd go");
}

TEST(Yaml, ChecksTheKindAndVersionOfAFile) {
  EXPECT_EQ(complaint([] { yaml("demecal_robot: 1\n").with_version("robot", 1); }), "");
  EXPECT_EQ(complaint([] { yaml("demecal_robot: 2\n").with_version("robot", 1); }),
            "f.yaml:1: '2': demecal_robot must be 1");
  EXPECT_EQ(complaint([] { yaml("a: 1\ndemecal_job: 1\n").with_version("robot", 1); }),
            "f.yaml:2: 'demecal_job': demecal_job marks another kind of file; demecal_robot: 1 is expected");
  EXPECT_EQ(complaint([] { yaml("\na: 1\n").with_version("robot", 1); }),
            "f.yaml:2: demecal_robot: 1 is missing: it says what kind of file this is");
}

TEST(Yaml, RefusesWhatIsNoSingleDocument) {
  struct Case {
    const char* text;
    const char* sentence;
  };
  for (const auto& [text, sentence] : {
           Case{"", "f.yaml: is empty"},
           Case{"# only a comment\n", "f.yaml: is empty"},
           Case{"a: 1\n---\nb: 2\n", "f.yaml:3: must hold one YAML document, not several"},
           Case{"a: 1\nb: 2\na: 3\n", "f.yaml:3: 'a': is a key that stands twice in one map"},
           Case{"a: {b: 1, b: 2}\n", "f.yaml:1: 'b': is a key that stands twice in one map"},
           Case{"a: 1\n\tb: 2\n", "f.yaml:2: is not valid YAML: illegal tab when looking for indentation"},
           Case{"a: [1, 2\nb: 3\n", "f.yaml:2: is not valid YAML: end of sequence flow not found"},
           Case{"a: 1\nf: [+, *, %]\n",
                "f.yaml:2: is not valid YAML: alias not found after * (symbols such as * and % need quotes)"},
           Case{"? [1, 2]\n: 3\n", "f.yaml:1: a key must be a word"},
       }) {
    EXPECT_EQ(complaint([&] { yaml(text); }), sentence);
  }
}

TEST(Yaml, SurvivesNestingWithoutEnd) {
  EXPECT_NE(complaint([] { yaml("a: &x [*x]\n"); }), "");
  std::string doubling = "a0: &a0 [1, 1]\n";
  for (int i = 1; i < 30; ++i) {
    const std::string one = std::to_string(i), before = std::to_string(i - 1);
    doubling += "a" + one + ": &a" + one + " [*a" + before + ", *a" + before + "]\n";
  }
  EXPECT_NE(complaint([&] { yaml(doubling); }), "");
}

TEST(Yaml, ReadsTheCovarianceOfAThousandNumbers) {
  constexpr std::size_t kValues = 500500;
  std::string triangle = "triangle: [-1.2345e-05";
  for (std::size_t i = 1; i < kValues; ++i) triangle += ", -1.2345e-05";
  EXPECT_EQ(yaml(triangle + "]\n").at("triangle").children.size(), kValues);
}

TEST(Yaml, RefusesACommaThatWouldBeginDocumentsWithoutEnd) {
  EXPECT_NE(complaint([] { yaml(", a: 1\n"); }), "");
}

TEST(YamlText, ReadsBackTheSame) {
  std::mt19937_64 bits(29);
  const std::string letters =
      "ab Z_-./:#'\"\\{}[],&*%!|>@`\n\t\x01"
      "1";
  for (int trial = 0; trial < 500; ++trial) {
    std::string text;
    for (std::uint64_t i = 1 + bits() % 8; i > 0; --i) text += letters[bits() % letters.size()];
    EXPECT_EQ(yaml("a: " + yaml_text(text) + "\n").at("a").text(), text);
  }
  for (const char* word : {"true", "No", "null", "~", "PUMA 761", "Größe", "on"}) {
    const YamlNode root = yaml("a: [" + yaml_text(word) + "]\n");
    EXPECT_EQ(root.at("a").list()[0].text(), word);
  }
}

TEST(YamlText, WritesNumbersInTheirBordersUnit) {
  EXPECT_EQ(yaml_mm({0.15025, 0.00163, -1.0}), "[150.25, 1.63, -1000]");
  EXPECT_EQ(degrees_text(3.141592653589793), "180");
  EXPECT_EQ(yaml_comment("two\nlines"), "# two lines\n");
}

}  // namespace
}  // namespace demecal
