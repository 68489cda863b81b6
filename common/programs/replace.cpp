#include "programs/replace.hpp"

#include <map>

#include "errors/check.hpp"

namespace demecal {

std::string replaced(std::string_view text, const Program& program, const std::vector<CorrectedTarget>& targets) {
  std::map<std::size_t, std::pair<std::size_t, const std::string*>> changes;  // by first byte: size and new text
  for (std::size_t i = 0; i < targets.size(); ++i) {
    std::vector<Cell> cells = program.targets[i].is_pose() ? program.targets[i].position : program.targets[i].joints;
    cells.insert(cells.end(), program.targets[i].orientation.begin(), program.targets[i].orientation.end());
    for (std::size_t cell = 0; cell < targets[i].texts.size(); ++cell) {
      const std::string& changed = targets[i].texts[cell];
      if (!changed.empty()) changes[cells[cell].begin] = {cells[cell].size, &changed};
    }
  }
  std::string result;
  result.reserve(text.size() + 4 * changes.size());
  std::size_t kept_from = 0;
  for (const auto& [begin, change] : changes) {
    DEMECAL_CHECK(begin >= kept_from, "numbers overlap at byte " << begin);
    result += text.substr(kept_from, begin - kept_from);
    result += *change.second;
    kept_from = begin + change.first;
  }
  result += text.substr(kept_from);
  return result;
}

}  // namespace demecal
