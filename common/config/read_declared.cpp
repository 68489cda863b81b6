#include "config/read_declared.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace demecal {
namespace {

struct DeclaredWord {
  std::string_view word;
  bool DeclaredModel::*flag;
};
constexpr std::array<DeclaredWord, 5> kDeclared{{{"registration", &DeclaredModel::registration},
                                                 {"tool", &DeclaredModel::tool},
                                                 {"joint_offset", &DeclaredModel::joint_offset},
                                                 {"geometry", &DeclaredModel::geometry},
                                                 {"joint_corrections", &DeclaredModel::joint_corrections}}};

}  // namespace

std::vector<std::string> declared_words() {
  std::vector<std::string> words;
  for (const DeclaredWord& known : kDeclared) words.emplace_back(known.word);
  return words;
}

DeclaredModel declared_of(std::span<const std::string> words) {
  DeclaredModel declared;
  for (const DeclaredWord& known : kDeclared) {
    declared.*known.flag = std::find(words.begin(), words.end(), known.word) != words.end();
  }
  return declared;
}

DeclaredModel read_declared(const YamlNode& list) {
  DeclaredModel declared;
  for (const YamlNode& item : list.list()) {
    const auto found = std::find_if(kDeclared.begin(), kDeclared.end(),
                                    [&](const DeclaredWord& known) { return known.word == item.text(); });
    if (found == kDeclared.end()) item.fail_choice(declared_words());
    if (declared.*found->flag) item.fail("is declared twice");
    declared.*found->flag = true;
  }
  return declared;
}

}  // namespace demecal
