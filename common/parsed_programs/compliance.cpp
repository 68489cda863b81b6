#include "parsed_programs/compliance.hpp"

namespace demecal::inline parsed_programs {

void note_compliance(const ProgramText& text, std::size_t begin, const std::string& statement, const std::string& end,
                     Program& program) {
  program.remarks.push_back({text.place(begin), "",
                             "behind " + statement + " the arm gives way to forces, up to " + end +
                                 ": what it is sent to there is corrected as if it did not"});
  program.joints_lost_at.push_back(begin);
}

}  // namespace demecal::inline parsed_programs
