// The document of the protocol, idl/calibration.idl, and the lists of fields say the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "protocol/fields.hpp"

namespace demecal {
namespace {

template <class Plain>
const char* const kStruct = nullptr;
template <>
const char* const kStruct<Individual> = "Individual";
template <>
const char* const kStruct<SharedFunction> = "SharedFunction";
template <>
const char* const kStruct<GpParameters> = "GpParameters";
template <>
const char* const kStruct<Archipelago> = "Archipelago";
template <>
const char* const kStruct<TrainingTable> = "TrainingTable";
template <>
const char* const kStruct<CauseName> = "CauseName";
template <>
const char* const kStruct<SetTraining> = "SetTraining";
template <>
const char* const kStruct<WorkTable> = "WorkTable";
template <>
const char* const kStruct<WorkInputs> = "WorkInputs";
template <>
const char* const kStruct<Migrants> = "Migrants";
template <>
const char* const kStruct<IslandState> = "IslandState";

/// The type of a field as IDL spells it, chosen by the type of a pointer to its value.
std::string type_of(const bool*) {
  return "boolean";
}
std::string type_of(const std::uint8_t*) {
  return "octet";
}
std::string type_of(const std::int32_t*) {
  return "int32";
}
std::string type_of(const std::uint32_t*) {
  return "uint32";
}
std::string type_of(const std::uint64_t*) {
  return "uint64";
}
std::string type_of(const double*) {
  return "double";
}
std::string type_of(const Primitive*) {
  return "octet";
}
std::string type_of(const Tree*) {
  return "Formula";
}
template <class Plain>
requires std::is_class_v<Plain> std::string type_of(const Plain*) {
  return kStruct<Plain>;
}
template <class Value>
requires std::is_enum_v<Value> std::string type_of(const Value*) {
  return std::string(kEnumeration<Value>.name);
}
template <class Element>
std::string type_of(const std::vector<Element>*) {
  const std::string element = type_of(static_cast<const Element*>(nullptr));
  return "sequence<" + element + (element.ends_with('>') ? " >" : ">");
}
template <std::size_t most>
std::string type_of(const BoundedField<most, std::string&>*) {
  return "string<" + std::to_string(most) + ">";
}
template <std::size_t most, class Element>
std::string type_of(const BoundedField<most, std::vector<Element>&>*) {
  return "sequence<" + type_of(static_cast<const Element*>(nullptr)) + ", " + std::to_string(most) + ">";
}
template <FieldKind kind, class Field>
std::string type_of(const SpecialField<kind, Field>*) {
  if (kind == FieldKind::octet) return "octet";
  if (kind == FieldKind::word) return "string<" + std::to_string(kMostWord) + ">";
  const std::string type = type_of(static_cast<const std::remove_reference_t<Field>*>(nullptr));
  return kind == FieldKind::key ? "@key " + type : type;
}
template <std::size_t most, class Rows, class NumberOf>
std::string type_of(const ColumnField<most, Rows, NumberOf>*) {
  using Value = std::remove_cvref_t<std::invoke_result_t<NumberOf, typename Rows::value_type&>>;
  return "sequence<" + type_of(static_cast<const Value*>(nullptr)) + ", " + std::to_string(most) + ">";
}

/// A list of fields as IDL declares them, in one line.
class Declaration {
 public:
  template <class Field>
  void operator()(const char* name, Field&& field) {
    text_ += (text_.empty() ? "" : " ") + type_of(&field) + ' ' + name + ';';
  }
  std::string text() const { return text_; }

 private:
  std::string text_;
};

template <class Plain>
std::string declared() {
  Plain blank{};
  Declaration declaration;
  visit_fields(declaration, blank);
  return declaration.text();
}

using Declarations = std::map<std::string, std::string>;

/// Those that `keyword` begins in the document, without comments, each in one line.
Declarations in_the_document(const std::string& keyword) {
  std::ifstream file(std::string(DEMECAL_SOURCE_DIR) + "/idl/calibration.idl");
  std::stringstream text;
  for (std::string line; std::getline(file, line);) text << line.substr(0, line.find("//")) << ' ';
  const std::string code = std::regex_replace(text.str(), std::regex("\\s+"), " ");
  const std::regex declaration(keyword + " (\\w+) \\{ ?([^}]*?) ?\\};");
  Declarations found;
  for (std::sregex_iterator match(code.begin(), code.end(), declaration), end; match != end; ++match)
    found[(*match)[1]] = (*match)[2];
  return found;
}

TEST(Document, DeclaresTheStructsThatTheListsAreOf) {
  const Declarations listed{
      {"MessagePart", declared<MessagePart>()},     {"Formula", declared<FlatFormula>()},
      {"Individual", declared<Individual>()},       {"SharedFunction", declared<SharedFunction>()},
      {"GpParameters", declared<GpParameters>()},   {"Archipelago", declared<Archipelago>()},
      {"TrainingTable", declared<TrainingTable>()}, {"CauseName", declared<CauseName>()},
      {"SetTraining", declared<SetTraining>()},     {"WorkTable", declared<WorkTable>()},
      {"WorkInputs", declared<WorkInputs>()},       {"CalibrationData", declared<CalibrationData>()},
      {"Migrants", declared<Migrants>()},           {"IslandState", declared<IslandState>()},
      {"IslandTask", declared<IslandTask>()},       {"PlacedProgress", declared<PlacedProgress>()},
      {"Checkpoint", declared<Checkpoint>()},       {"Outcome", declared<Outcome>()},
      {"WorkerStatus", declared<WorkerStatus>()},   {"Control", declared<Control>()},
      {"LoopNews", declared<LoopNews>()},           {"CauseFound", declared<CauseFound>()},
      {"FinalFigures", declared<FinalFigures>()}};
  EXPECT_EQ(in_the_document("struct"), listed);
}

template <class... Values>
Declarations listed_values() {
  return {{std::string(kEnumeration<Values>.name), std::string(kEnumeration<Values>.values)}...};
}

TEST(Document, DeclaresTheEnumerationsThatAreListed) {
  EXPECT_EQ(in_the_document("enum"), (listed_values<ConstantPolicy, Topology, Replacement, Loss, Breeds, WorkKind>()));
}

template <class E>
std::string words_in_a_sentence() {
  std::string sentence;
  for (std::size_t i = 0; i < kWords<E>.size(); ++i) {
    sentence += i == 0 ? "" : i + 1 == kWords<E>.size() ? " or " : ", ";
    sentence += kWords<E>[i];
    EXPECT_LE(std::string(kWords<E>[i]).size(), kMostWord);
  }
  return sentence;
}

TEST(Document, SaysTheWordsThatTravel) {
  std::ifstream file(std::string(DEMECAL_SOURCE_DIR) + "/idl/calibration.idl");
  std::map<std::string, std::string> said;
  for (std::string line; std::getline(file, line);) {
    std::smatch found;
    if (std::regex_match(line, found, std::regex("  string<15> (\\w+); +// (.*)"))) said[found[1]] = found[2];
  }
  EXPECT_EQ(said, (Declarations{{"state", words_in_a_sentence<Control::State>()},
                                {"stage", words_in_a_sentence<LoopNews::Stage>()},
                                {"verdict", words_in_a_sentence<LoopNews::Verdict>()}}));
}

}  // namespace
}  // namespace demecal
