// What DATASET.yaml says of the contacts that its poses touch.
#pragma once

#include <string>

#include "data/columns.hpp"
#include "data/data_set.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline config {

/// Reads `contacts:` into the data set, whose poses are read already; null: nothing is said. Throws InputError where a
/// name is of no contact, or where something is said that its kind does not have.
void read_contacts(const YamlNode* node, const ColumnMap& columns, DataSet& data);

/// An entry of `distances`: between which two, mm and sigma_mm.
KnownDistance read_known_distance(const YamlNode& node);

/// The same as YAML, empty where nothing is to be said.
std::string contacts_text(const Contacts& contacts);

}  // namespace demecal::inline config
