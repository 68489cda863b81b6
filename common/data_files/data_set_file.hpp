// DATASET.yaml: what was measured, on which robot, in which columns, with which contacts; and the key `certificate`,
// which jobs and models may have too.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "data/certificate_fields.hpp"
#include "data/columns.hpp"
#include "data/contacts.hpp"
#include "data/data_set.hpp"
#include "yaml/yaml_node.hpp"

namespace demecal::inline data_files {

/// The poses and the robot of a DATASET.yaml; the files it names are taken relative to it. Where neither a set column
/// nor `split` divides the poses, 30 % of them validate, drawn with seed 1. Throws InputError with file, line, value
/// and rule at the first fault in any of the three files.
DataSet load_data_set(const std::filesystem::path& path);

/// The same, with what was found of how its files are written and joined: a sentence each, for people; none of plain
/// CSV.
struct DescribedDataSet {
  DataSet data;
  std::vector<std::string> recognised;
};
DescribedDataSet load_described_data_set(const std::filesystem::path& path);

/// What a map of columns is of: all that there is, or a part of it.
enum class ColumnsOf { all, part };

/// A column by its name or, where that is a whole number, by its place from 1.
ColumnName read_column(const YamlNode& node);

/// What stands under `columns`: names, or numbers of columns. Of all that there is, joints must be among them.
ColumnMap read_column_map(const YamlNode& node, ColumnsOf of = ColumnsOf::all);

/// What stands under `units`; nothing is assumed where the key is missing (null).
AssumedUnits read_units(const YamlNode* node);

/// Writes ROBOT.yaml; `purpose` becomes its first, commented line. Throws InputError where the file cannot be written.
void write_robot(const Robot& robot, const std::filesystem::path& path, const std::string& purpose);

/// Writes dataset.yaml, poses.csv and robot.yaml into the folder, which is made if need be, and returns the path of
/// dataset.yaml. All poses must have the same quantities measured. `purpose` as above.
std::filesystem::path write_data_set(const DataSet& data, const std::filesystem::path& folder,
                                     const std::string& purpose);

/// Reads `contacts:` into the data set, whose poses are read already; null: nothing is said. Throws InputError where a
/// name is of no contact, or where something is said that its kind does not have.
void read_contacts(const YamlNode* node, const ColumnMap& columns, DataSet& data);

/// An entry of `distances`: between which two, mm and sigma_mm.
KnownDistance read_known_distance(const YamlNode& node);

/// The same as YAML, empty where nothing is to be said.
std::string contacts_text(const Contacts& contacts);

/// What the map states; a key without a value states nothing. Throws InputError at an unknown key, a date or country of
/// another form, or an uncertainty that is not positive.
CertificateFields read_certificate(const YamlNode& node);

/// What the DATASET.yaml states; nothing where it has no such key.
CertificateFields load_certificate(const std::filesystem::path& data_set_file);

/// The key and its map, as read_certificate() takes them; empty where nothing is stated.
std::string certificate_text(const CertificateFields& fields);

}  // namespace demecal::inline data_files
