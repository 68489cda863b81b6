// Readers end with a program or with a sentence, whatever bytes they are given.
#include <gtest/gtest.h>

#include <algorithm>

#include "errors/input_error.hpp"
#include "kinematics/forward.hpp"
#include "written_program.hpp"

namespace demecal {
namespace {

constexpr std::string_view kTelling = "[]{}(),;:=\"'!#.$&\n\r\t p1-eE";

/// The text with a few bytes changed, taken out, doubled, or cut off.
std::string disturbed(RandomStream& stream, std::string text) {
  const std::size_t changes = 1 + stream.index(4);
  for (std::size_t i = 0; i < changes && !text.empty(); ++i) {
    const std::size_t at = stream.index(text.size());
    switch (stream.index(5)) {
      case 0:
        text[at] = kTelling[stream.index(kTelling.size())];
        break;
      case 1:
        text.erase(at, 1 + stream.index(6));
        break;
      case 2:
        text.insert(at, text.substr(at, stream.index(30)));
        break;
      case 3:
        text[at] = static_cast<char>(stream.index(256));
        break;
      default:
        text.resize(at);
    }
  }
  return text;
}

/// Every number lies inside the text, and none overlaps another.
void expect_sound(const Program& program, const std::string& text) {
  std::vector<std::pair<std::size_t, std::size_t>> spans;
  for (const Target& target : program.targets) {
    for (const auto* cells : {&target.joints, &target.position, &target.orientation}) {
      for (const Cell& cell : *cells) spans.emplace_back(cell.begin, cell.begin + cell.size);
    }
  }
  std::sort(spans.begin(), spans.end());
  std::size_t last = 0;
  for (const auto& [begin, end] : spans) {
    EXPECT_GE(begin, last);
    EXPECT_LT(begin, end);
    last = end;
  }
  EXPECT_LE(last, text.size());
}

TEST(Readers, EndWithAProgramOrASentence) {
  RandomStream stream{7401};
  const Chain arm = wrist_arm();
  int read = 0, refused = 0;
  for (int repetition = 0; repetition < 400; ++repetition) {
    for (const Language language : kLanguages) {
      const bool of_poses = stream.chance(0.5);
      const auto line = [&](int index) {
        const JointVector joints = random_joints(stream, arm);
        return of_poses ? pose_line(language, forward(arm, joints), joints, index, 3)
                        : joints_line(language, joints, index, 3);
      };
      const std::string text = disturbed(stream, written(language, of_poses, 2, line, "\n"));
      try {
        expect_sound(read_program(language, text, "p", arm), text);
        ++read;
      } catch (const InputError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(read, 200);
  EXPECT_GT(refused, 200);
}

TEST(Readers, RefuseBracketsWithoutEnd) {
  for (const char bracket : {'[', '{', '('}) {
    std::string text = "movej(";
    for (int i = 0; i < 100000; ++i) text += bracket;
    for (const Language language : {Language::krl, Language::rapid, Language::urscript}) {
      try {
        read_program(language, text, "p", wrist_arm());
      } catch (const InputError&) {
        continue;
      }
      EXPECT_TRUE(bracket == '(' || (bracket == '{') != (language == Language::krl));
    }
  }
}

}  // namespace
}  // namespace demecal
