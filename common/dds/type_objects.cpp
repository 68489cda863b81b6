#include "dds/type_objects.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastrtps/types/TypeObject.h>
#include <fastrtps/types/TypeObjectFactory.h>
#include <fastrtps/utils/md5.h>
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>

#include "protocol/fields.hpp"

namespace demecal::inline dds {
namespace {

namespace types = eprosima::fastrtps::types;

/// As Fast DDS calls it.
template <Number N>
constexpr const char* number_name() {
  if constexpr (std::is_same_v<N, bool>) return "bool";
  if constexpr (std::is_same_v<N, double>) return "double";
  if constexpr (std::is_same_v<N, std::uint32_t>) return "uint32_t";
  if constexpr (std::is_same_v<N, std::uint64_t>) return "uint64_t";
}

/// Makes a member of each field.
class MemberList {
 public:
  explicit MemberList(types::CompleteStructType& type) : type_(type) {}

  template <class Field>
  void operator()(const char* name, const Field& field) {
    types::CompleteStructMember member;
    member.common().member_id(next_++);
    member.detail().name(name);
    describe(member, field);
    type_.member_seq().push_back(member);
  }

 private:
  template <class Value>
  void describe(types::CompleteStructMember& member, const Value&) {
    member.common().member_type_id(*factory().get_type_identifier(number_name<Value>(), false));
  }
  template <FieldKind kind, class Field>
  void describe(types::CompleteStructMember& member, const SpecialField<kind, Field>& field) {
    if constexpr (kind == FieldKind::key) set_key(member);
    if constexpr (kind == FieldKind::word) {
      member.common().member_type_id(*factory().get_string_identifier(kMostWord, false));
    } else {
      describe(member, field.field);
    }
  }
  template <std::size_t most, class Field>
  void describe(types::CompleteStructMember& member, const BoundedField<most, Field>&) {
    member.common().member_type_id(*factory().get_string_identifier(most, false));
  }

  template <std::size_t most, class Rows, class NumberOf>
  void describe(types::CompleteStructMember& member, const ColumnField<most, Rows, NumberOf>& column) {
    using Value = std::remove_cvref_t<decltype(column.number(*column.rows.begin()))>;
    member.common().member_type_id(*factory().get_sequence_identifier(number_name<Value>(), most, false));
  }

  /// By the flag and by the annotation: Fast DDS makes dynamic types of the latter.
  static void set_key(types::CompleteStructMember& member) {
    member.common().member_flags().IS_KEY(true);
    types::AppliedAnnotation key;
    key.annotation_typeid(*factory().get_type_identifier_trying_complete("key"));
    types::AppliedAnnotationParameter value;
    MD5 hash("value");
    std::copy_n(hash.digest, 4, value.paramname_hash().begin());
    types::AnnotationParameterValue yes;
    yes._d(types::TK_BOOLEAN);
    yes.from_string("true");
    value.value(yes);
    key.param_seq().push_back(value);
    member.detail().ann_custom().push_back(key);
  }

  static types::TypeObjectFactory& factory() { return *types::TypeObjectFactory::get_instance(); }

  types::CompleteStructType& type_;
  types::MemberId next_ = 0;
};

template <class Plain>
std::shared_ptr<types::TypeObject> type_object(const std::string& name) {
  auto object = std::make_shared<types::TypeObject>();
  object->_d(types::EK_COMPLETE);
  object->complete()._d(types::TK_STRUCTURE);
  types::CompleteStructType& structure = object->complete().struct_type();
  structure.struct_flags().IS_FINAL(true);
  structure.header().detail().type_name(name);
  MemberList members(structure);
  const Plain empty{};
  visit_fields(members, empty);
  return object;
}

/// By the hash of the object (Extensible and Dynamic Topic Types for DDS, 7.3.1.2).
types::TypeIdentifier identifier_of(const types::TypeObject& object) {
  std::string bytes(types::TypeObject::getCdrSerializedSize(object) + 4, '\0');
  eprosima::fastcdr::FastBuffer buffer(bytes.data(), bytes.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS, eprosima::fastcdr::Cdr::DDS_CDR);
  object.serialize(cdr);
  MD5 hash;
  hash.init();
  hash.update(bytes.data(), static_cast<MD5::size_type>(cdr.getSerializedDataLength()));
  hash.finalize();
  types::TypeIdentifier identifier;
  identifier._d(types::EK_COMPLETE);
  std::copy_n(hash.digest, sizeof(types::EquivalenceHash), identifier.equivalence_hash());
  return identifier;
}

template <class Plain>
void announce(eprosima::fastdds::dds::TopicDataType& type) {
  const auto object = type_object<Plain>(type.getName());
  type.type_identifier(eprosima::fastdds::dds::TypeIdV1(identifier_of(*object)));
  type.type_object(eprosima::fastdds::dds::TypeObjectV1(*object));
}

}  // namespace

void add_type_object(eprosima::fastdds::dds::TopicDataType& type, Topic topic) {
  type.auto_fill_type_information(false);
  type.auto_fill_type_object(false);
  if (topic == Topic::worker) announce<WorkerStatus>(type);
  if (topic == Topic::control) announce<Control>(type);
  if (topic == Topic::progress) announce<PlacedProgress>(type);
  if (topic == Topic::loop) announce<LoopNews>(type);
  if (topic == Topic::cause) announce<CauseFound>(type);
  if (topic == Topic::final_figures) announce<FinalFigures>(type);
}

}  // namespace demecal::inline dds
