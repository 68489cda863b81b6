#include "yaml/yaml_node.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "errors/input_error.hpp"
#include "yaml/files.hpp"

namespace demecal::inline yaml {
namespace {

constexpr int kDeepest = 32;  // an alias within its own anchor would have no end

/// Aliases of aliases grow beyond any memory, but a model may state the covariance of a thousand numbers.
std::size_t most_values(const std::string& text) {
  constexpr std::size_t kAlways = 100000, kBytesEach = 8;
  return std::max(kAlways, text.size() / kBytesEach);
}

std::size_t line_of(const YAML::Mark& mark) {
  return mark.is_null() ? 0 : static_cast<std::size_t>(mark.line) + 1;
}

/// Turns yaml-cpp's nodes into ours.
class Conversion {
 public:
  Conversion(std::string file, std::size_t most_values) : file_(std::move(file)), most_values_(most_values) {}

  YamlNode convert(const YAML::Node& source, std::size_t line, const std::string& key, int depth = 0) {
    if (depth > kDeepest) throw InputError({file_, line}, "", key + " is nested too deeply");
    if (++nodes_ > most_values_) throw InputError({file_, line}, "", "holds too many values");
    YamlNode node;
    node.file = file_;
    node.line = line;
    node.key = key;
    if (source.IsScalar()) {
      node.kind = YamlNode::Kind::scalar;
      node.scalar = source.Scalar();
      node.quoted = source.Tag() == "!";
    } else if (source.IsSequence()) {
      node.kind = YamlNode::Kind::list;
      convert_items(source, node, depth);
    } else if (source.IsMap()) {
      node.kind = YamlNode::Kind::map;
      convert_entries(source, node, depth);
    }
    return node;
  }

 private:
  void convert_items(const YAML::Node& source, YamlNode& list, int depth) {
    for (const YAML::Node& item : source) {
      const std::string key = list.key + "[" + std::to_string(list.children.size() + 1) + "]";
      list.children.push_back(convert(item, line_of(item.Mark()), key, depth + 1));
    }
  }

  void convert_entries(const YAML::Node& source, YamlNode& map, int depth) {
    for (const auto& entry : source) {
      const std::size_t line = line_of(entry.first.Mark());
      if (!entry.first.IsScalar()) throw InputError({file_, line}, "", "a key must be a word");
      const std::string name = entry.first.Scalar();
      if (map.find(name)) throw InputError({file_, line}, name, "is a key that stands twice in one map");
      map.children.push_back(convert(entry.second, line, map.key.empty() ? name : map.key + "." + name, depth + 1));
      map.children.back().name = name;
    }
  }

  std::string file_;
  std::size_t most_values_, nodes_ = 0;
};

std::string line_text(const std::string& text, std::size_t line) {
  std::istringstream stream(text);
  std::string found;
  for (std::size_t i = 0; i < line; ++i) std::getline(stream, found);
  return found;
}

/// What YAML makes of an unquoted * or % confuses those who list functions.
std::string quoting_hint(const std::string& line) {
  const bool symbols = line.find('*') != std::string::npos || line.find('%') != std::string::npos;
  return symbols ? " (symbols such as * and % need quotes)" : "";
}

/// What a document begins with, and whether there are too many values. YAML::LoadAll would return documents without end
/// where one begins with a comma.
class Outline final : public YAML::EventHandler {
 public:
  Outline(std::string file, std::size_t most_values) : file_(std::move(file)), most_values_(most_values) {}

  bool is_null() const { return is_null_; }
  std::size_t line() const { return line_; }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { count(mark, true); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { count(mark, false); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t, const std::string&) override {
    count(mark, false);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    count(mark, false);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    count(mark, false);
  }
  void OnMapEnd() override {}

 private:
  void count(const YAML::Mark& mark, bool null) {
    if (values_ == 0) {
      is_null_ = null;
      line_ = line_of(mark);
    }
    if (++values_ > most_values_) throw InputError({file_, line_of(mark)}, "", "holds too many values");
  }

  std::string file_;
  std::size_t most_values_, values_ = 0, line_ = 0;
  bool is_null_ = true;
};

void check_outline(const std::string& text, const std::string& file) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  Outline first(file, most_values(text)), second(file, most_values(text));
  if (!parser.HandleNextDocument(first) || first.is_null()) throw InputError({file, 0}, "", "is empty");
  if (parser.HandleNextDocument(second) && !second.is_null()) {
    throw InputError({file, second.line()}, "", "must hold one YAML document, not several");
  }
}

}  // namespace

YamlNode parse_yaml(const std::string& text, const std::string& file) {
  YAML::Node found;
  try {
    check_outline(text, file);
    found = YAML::Load(text);
  } catch (const YAML::Exception& fault) {
    const std::size_t line = line_of(fault.mark);
    throw InputError({file, line}, "", "is not valid YAML: " + fault.msg + quoting_hint(line_text(text, line)));
  }
  return Conversion(file, most_values(text)).convert(found, line_of(found.Mark()), "");
}

YamlNode read_yaml(const std::filesystem::path& path) {
  return parse_yaml(read_file(path), path.string());
}

}  // namespace demecal::inline yaml
