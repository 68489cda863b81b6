#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "errors/check.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"
#include "programs/correct_program.hpp"
#include "programs/target_correction.hpp"

namespace demecal::inline programs {

std::vector<std::string> corrected_files(const ProgramSource& source, const CorrectedProgram& corrected) {
  std::vector<std::string> texts;
  for (std::size_t file = 0; file < source.files().size(); ++file) {
    texts.push_back(replaced(source.files()[file].text, corrected.program, corrected.targets, source.begin(file)));
  }
  return texts;
}

std::string replaced(std::string_view text, const Program& program, const std::vector<CorrectedTarget>& targets,
                     std::size_t begin) {
  std::map<std::size_t, std::pair<std::size_t, const std::string*>> changes;  // by first byte: size and new text
  for (std::size_t i = 0; i < targets.size(); ++i) {
    std::vector<Cell> cells = program.targets[i].is_pose() ? program.targets[i].position : program.targets[i].joints;
    cells.insert(cells.end(), program.targets[i].orientation.begin(), program.targets[i].orientation.end());
    for (std::size_t cell = 0; cell < targets[i].texts.size(); ++cell) {
      const std::string& changed = targets[i].texts[cell];
      const std::size_t at = cells[cell].begin;
      if (!changed.empty() && at >= begin && at < begin + text.size())
        changes[at - begin] = {cells[cell].size, &changed};
    }
  }
  std::string result;
  result.reserve(text.size() + 4 * changes.size());
  std::size_t kept_from = 0;
  for (const auto& [at, change] : changes) {
    DEMECAL_CHECK(at >= kept_from, "numbers overlap at byte " << at);
    result += text.substr(kept_from, at - kept_from);
    result += *change.second;
    kept_from = at + change.first;
  }
  result += text.substr(kept_from);
  return result;
}

}  // namespace demecal::inline programs
