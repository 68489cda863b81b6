#include "config/read_declared.hpp"

#include <algorithm>

namespace demecal {

DeclaredModel declared_of(std::span<const std::string> words) {
  DeclaredModel declared;
  for (const std::string& known : declared_words()) {
    declared.*declared_flag(known) = std::find(words.begin(), words.end(), known) != words.end();
  }
  return declared;
}

DeclaredModel read_declared(const YamlNode& list) {
  DeclaredModel declared;
  for (const YamlNode& item : list.list()) {
    bool DeclaredModel::*const flag = declared_flag(item.text());
    if (flag == nullptr) item.fail_choice(declared_words());
    if (declared.*flag) item.fail("is declared twice");
    declared.*flag = true;
  }
  return declared;
}

}  // namespace demecal
