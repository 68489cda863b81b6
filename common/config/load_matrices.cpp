#include "config/load_matrices.hpp"

#include "config/yaml_node.hpp"
#include "errors/input_error.hpp"
#include "kinematics/chain.hpp"

namespace demecal {
namespace {

SymbolNames read_names(Algebra& algebra, const YamlNode& file, std::vector<Expression>& joints) {
  SymbolNames names;
  const YamlNode& list = file.at("joints");
  for (const YamlNode& name : list.list()) {
    joints.push_back(algebra.symbol(commanded_joint(static_cast<int>(joints.size()) + 1)));
    if (!names.emplace(name.text(), joints.back()).second) name.fail("is named twice");
  }
  if (joints.empty() || joints.size() > static_cast<std::size_t>(kMaxJoints)) {
    list.fail("", "must name 1 to " + std::to_string(kMaxJoints) + " joints");
  }
  if (const YamlNode* values = file.find("values")) {
    if (values->kind != YamlNode::Kind::map) values->fail("must be a map of names and numbers");
    for (const YamlNode& value : values->children) {
      if (!names.emplace(value.name, algebra.constant(value.number())).second) value.fail("is a joint as well");
    }
  }
  return names;
}

MatrixText read_matrix(const YamlNode& node) {
  MatrixText text;
  const std::vector<YamlNode>& rows = node.list(3);
  for (std::size_t row = 0; row < 3; ++row) {
    const std::vector<YamlNode>& elements = rows[row].list(4);
    for (std::size_t column = 0; column < 4; ++column) text[row][column] = elements[column].text();
  }
  return text;
}

}  // namespace

Listing load_matrices(Algebra& algebra, const std::filesystem::path& path) {
  const YamlNode file = read_yaml(path).with_version("matrices", 1);
  file.with_keys({"demecal_matrices", "name", "joints", "values", "matrices"});
  Listing listing{{file.at("name").text()}, {}, {}};
  const SymbolNames names = read_names(algebra, file, listing.actual);
  std::string joints;
  for (const YamlNode& name : file.at("joints").list()) joints += (joints.empty() ? "" : ", ") + name.text();
  listing.remarks.push_back(
      "q1 .. qn are " + joints +
      " of the matrices, in rad or the unit of their lengths; the pose is their product, row by row.");
  listing.pose = parse_product(algebra, {});
  for (const YamlNode& node : file.at("matrices").list()) {
    try {
      listing.pose = product(listing.pose, parse_matrix(algebra, read_matrix(node), names));
    } catch (const InputError& error) {
      if (!error.where().file.empty()) throw;
      node.fail(error.value(), error.rule());
    }
  }
  return listing;
}

}  // namespace demecal
