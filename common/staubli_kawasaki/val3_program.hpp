// Staubli VAL3: the values that a data file (.dtx) declares, as tags with attributes, and what the code of programs
// (.pgx) does with these points, joints, frames and tools: to which it moves, with which tool, and which it changes.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "kinematics/chain.hpp"
#include "parsed_programs/language.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline staubli_kawasaki {

/// One <Value .../>, and what the <Data ...> around it says of it.
struct Val3Value {
  std::string name{};  ///< "pPick[2]": that of the data and its key
  std::string type{};  ///< of the data, as written
  std::size_t begin = 0;
  std::map<std::string, BracketItem> attributes{};  ///< where the text inside the quotes stands
};

/// All values of the text. Throws InputError where a tag or a quote is never closed.
std::vector<Val3Value> val3_values(const ProgramText& text);

/// What stands between <Code> and </Code> of one program.
struct Val3Code {
  std::string name{};
  std::size_t begin = 0, end = 0;
  std::set<std::string> locals{};  ///< the names of its parameters and local variables
};

/// All programs of the text. Throws InputError as val3_values() does.
std::vector<Val3Code> val3_programs(const ProgramText& text);

/// Why lengths are not millimetres, where the application says so: a file of the program's, or one beside it that names
/// a file of the program's. Empty: they are.
std::string val3_inches(const ProgramText& text, const ControllerData& controller);

/// A motion to a point or to joints of the data.
struct Val3Motion {
  std::size_t begin = 0;  ///< of the motion in the text
  Motion motion = Motion::joints;
  std::string tool{};  ///< "tGrip[0]"; empty: it is computed
};

/// A motion to a place near a value of the data: appro(NAME, OFFSET) or compose(NAME, FRAME, OFFSET).
struct Val3Nearby {
  std::size_t begin = 0;  ///< of the motion in the text
  std::string name{};
  std::optional<Eigen::Vector3d> shift_m{};  ///< that the offset writes, if it does not turn
  std::string offset{};                      ///< the value that is the offset; empty: none
  bool along_tool = true;                    ///< by the tool's axes at the point, as appro() takes it
};

/// Reads the code of all programs. Names are those of val3_values(): "pPick[2]", and "pPick[0]" of pPick alone; an
/// index that is computed speaks of every value of its name. What is used in a way that is not known to leave it as it
/// is, is taken to be changed.
class Val3Statements {
 public:
  explicit Val3Statements(const ProgramText& text);
  Val3Statements(const Val3Statements&) = delete;
  Val3Statements& operator=(const Val3Statements&) = delete;

  /// The code of all programs, without comments, every byte where it stood; all else is blank.
  const ProgramText& code() const { return code_; }
  /// Whether there is any code.
  bool any() const { return any_; }
  std::vector<Val3Motion> motions(const std::string& name) const;
  /// Why the value need not be that of the data when it is used, as "the program changes it"; empty: it is.
  std::string changed(const std::string& name) const;
  /// All motions to values, or near them, by the values' names; of a computed index the name without it.
  const std::map<std::string, std::vector<Val3Motion>>& motions() const { return motions_; }
  const std::vector<Val3Nearby>& nearby() const { return nearby_; }
  /// The calls of programs that are none of these, the tasks of such, and libraries that are loaded, and where they
  /// stand.
  const std::map<std::size_t, std::string>& calls_elsewhere() const { return calls_elsewhere_; }
  /// Where motions go to what is computed, and what that is.
  const std::map<std::size_t, std::string>& computed() const { return computed_; }

 private:
  struct Reference {
    std::string name{};  ///< with its index, if that is known; empty: none
    std::size_t end = 0;
    bool whole = false;  ///< nothing of it is taken, as by .trf
  };
  struct Argument {
    std::size_t begin, end;
  };

  void read(std::size_t begin, std::size_t end, const std::string& use);
  void note_loading(std::size_t begin, std::size_t open, std::size_t end);
  std::size_t read_reference(std::size_t begin, std::size_t end, const std::string& use);
  std::size_t read_call(std::size_t begin, std::size_t open, std::size_t end);
  void read_motion(const std::string& word, std::size_t begin, const std::vector<Argument>& arguments);
  void read_goal(const Argument& argument, const Val3Motion& motion);
  bool read_nearby(const Argument& argument, const Val3Motion& motion);
  std::optional<Eigen::Vector3d> written_shift_m(const Argument& offset) const;
  Reference reference(std::size_t begin, std::size_t end) const;
  /// The reference that the argument is, and nothing else.
  Reference only_reference(const Argument& argument) const;
  std::vector<Argument> arguments(std::size_t open, std::size_t close) const;
  std::size_t close_of(std::size_t open, std::size_t end) const;

  const ProgramText& text_;
  ProgramSource bare_;
  ProgramText code_;
  const std::set<std::string>* locals_ = nullptr;  ///< names of the program that is read, which hide those of the data
  int depth_ = 0;                                  ///< of brackets
  bool any_ = false;
  std::map<std::string, std::vector<Val3Motion>> motions_;
  std::map<std::string, std::string> changed_;
  std::map<std::size_t, std::string> computed_, calls_elsewhere_;
  std::vector<Val3Nearby> nearby_;
};

/// What a program of Language::write drives to and how fast, a data file; and the program, which is named "program".
std::string val3_written_data(std::span<const ProgrammedStop> stops, const Chain& arm);
std::string val3_written_program(std::span<const ProgrammedStop> stops);

}  // namespace demecal::inline staubli_kawasaki
