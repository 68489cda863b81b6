// Which tool and which frame hold at a motion, in programs whose routines branch, repeat and call one another.
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal::inline parsed_programs {

/// What a reader finds in the order of the text, and what holds behind it on every path. What paths set differently is
/// unknown where they meet. A call does what the routine of this name does; a routine begins with what its callers hold
/// or, without any, with nothing stated, unless a routine that it does not call sets it.
class FrameFlow {
 public:
  enum class Block {
    branch,     ///< its body may be skipped, unless an alternative takes all that is left
    selection,  ///< nothing but alternatives
    loop,       ///< its body may be skipped or repeated
    repeated,   ///< its body is run once at least
    endless     ///< only leave_loop() ends it
  };

  /// `tool` and `frame` are what sentences call them: "$TOOL" and "$BASE"; empty: no statement sets it.
  FrameFlow(std::string tool, std::string frame);

  /// A routine of this name (as calls name it; empty: none) in this file begins, and the one before it ends.
  void begin_routine(std::size_t at, const std::string& name, std::size_t file);
  /// A routine inside the present one begins; behind close_routine() the present one goes on.
  void open_routine(std::size_t at, const std::string& name, std::size_t file);
  void close_routine(std::size_t at);
  void set_tool(std::size_t at, const KnownFrame& tool);
  void set_frame(std::size_t at, const KnownFrame& frame);
  /// `is_routine`: whether a name that is none of these routines is one of another file.
  void call(std::size_t at, const std::string& name, bool is_routine);
  /// The routine may run at any time from here.
  void call_at_any_time(const std::string& name) { at_any_time_.insert(name); }
  void open(std::size_t at, Block kind);
  void alternative(std::size_t at, bool takes_all_left);
  /// What the innermost block's condition calls has been told: its body, or this alternative's, is skipped from here.
  void condition_ends(std::size_t at);
  void close(std::size_t at);
  void leave_loop(std::size_t at);
  /// Goes back to where the innermost loop begins.
  void repeat_loop(std::size_t at);
  void leave_routine(std::size_t at);
  void label(std::size_t at, const std::string& name);
  void jump(std::size_t at, const std::string& name, bool always);
  /// After all of them, before at().
  void finish();

  struct Held {
    StatedFrames frames{};
    /// The call on the way here of a routine that is none of these, which is taken to leave tool and frame alone.
    std::optional<std::size_t> call{};
  };
  Held at(std::size_t offset) const;
  /// Whether the program always comes from `begin` to `end` through what stands between them and through no routine of
  /// its own.
  bool is_straight(std::size_t begin, std::size_t end) const;
  /// Tells `program`, whose motions are known, the way through it, and where calls of routines that move leave unknown
  /// where the arm comes from.
  void note_arrivals(Program& program) const;
  /// The calls of routines of other files.
  std::set<std::size_t> calls_elsewhere() const;

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// Of a tool or a frame: not reached; as at the routine's begin; or values_[index].
  struct Value {
    enum class Kind { unreached, entry, known } kind = Kind::unreached;
    std::size_t index = 0;
    std::size_t call = kNone;  ///< the first that it is believed through
    bool operator==(const Value&) const = default;
  };
  struct State {
    Value tool{}, frame{};
    bool operator==(const State&) const = default;
  };
  struct Node {
    std::size_t at = 0, routine = 0;
    std::optional<std::size_t> tool{}, frame{};  ///< of values_
    std::string callee{};                        ///< empty: it calls nothing
    bool believed = false;                       ///< the callee may be one of another file
    std::size_t called = kNone;                  ///< the routine
    std::vector<std::size_t> next{};
    State in{};
  };
  struct Routine {
    std::string name;
    std::size_t file = 0, entry = 0;
    std::size_t around = kNone;  ///< the routine that it is inside of
    State exit{}, begin{};
    std::vector<std::size_t> nodes{};
    std::set<std::size_t> exits{};    ///< nodes
    std::set<std::size_t> callers{};  ///< nodes
    bool sets_tool = false, sets_frame = false;
    std::map<std::string, std::size_t> labels{};
    std::vector<std::pair<std::size_t, std::string>> jumps{};
  };
  struct OpenBlock {
    Block kind;
    std::size_t node;  ///< where a loop goes back to
    std::size_t skip;  ///< where the next alternative, or what is behind the block, begins
    std::vector<std::size_t> ends{};
    bool complete = false;
  };

  /// A routine that another has interrupted in the text.
  struct OpenRoutine {
    std::size_t routine;
    std::vector<std::size_t> current;
    std::vector<OpenBlock> blocks;
  };

  std::size_t add(std::size_t at);
  std::size_t add_turn(std::size_t at);
  void start_routine(std::size_t at, const std::string& name, std::size_t file);
  void end_routine();
  OpenBlock* innermost_loop();
  void join(const Value& other, std::size_t differing, Value& value) const;
  bool join(const State& other, State& state) const;
  static Value after(const Value& before, const Value& change);
  State out_of(const Node& node) const;
  static State begun(const State& state, const State& begin);
  void resolve_calls();
  void follow();
  void begin_called_routines();
  KnownFrame initial(std::size_t routine, bool of_tool) const;
  std::set<std::size_t> called_by(std::size_t routine) const;
  const Node* node_at(std::size_t offset) const;
  bool sets(std::size_t routine, bool of_tool) const;
  std::vector<std::size_t> routines_named(const std::string& name, std::size_t routine) const;
  KnownFrame value_of(const Value& value, bool of_tool) const;

  std::string tool_, frame_;
  std::vector<KnownFrame> values_;  ///< the first two: a tool and a frame that paths set differently
  std::vector<Node> nodes_;         ///< in the order of the text
  std::vector<Routine> routines_;
  std::map<std::string, std::vector<std::size_t>> by_name_;
  std::set<std::string> at_any_time_;
  std::vector<std::size_t> current_;  ///< the nodes that lead to the next
  std::vector<OpenBlock> blocks_;
  std::size_t present_ = 0;  ///< the routine that statements are of
  std::vector<OpenRoutine> interrupted_;
};

/// Says in `program`, at the first of these calls, that their routines are taken to leave tool and frame alone. `names`
/// has what each call is called by; `remedy` says what helps where they do not.
void note_calls_elsewhere(const ProgramText& text, const std::set<std::size_t>& calls,
                          const std::map<std::size_t, std::string>& names, Program& program,
                          const std::string& remedy = "--with FILE takes the file in");

}  // namespace demecal::inline parsed_programs
