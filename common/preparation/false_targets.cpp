#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/csv.hpp"
#include "data/data_set.hpp"
#include "kinematics/units.hpp"
#include "parsed_programs/orientation.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"
#include "preparation/named_points.hpp"
#include "preparation/prepared.hpp"
#include "preparation/readings.hpp"
#include "preparation/results.hpp"
#include "programs/correct_program.hpp"
#include "programs/target_correction.hpp"

namespace demecal::inline preparation {
namespace {

/// Decimals of tables for people: a hundredth of what any instrument sees.
constexpr int kDecimals = 5;

std::string mm_text(double length_m) {
  const auto cell = rewritten({.unit = 1e-3, .decimals = kDecimals}, length_m);
  return cell ? *cell : "0";
}

void add_mm(std::vector<std::string>& fields, const Eigen::Vector3d& lengths_m) {
  for (const double length_m : lengths_m) fields.push_back(mm_text(length_m));
}

/// Whether the pose stands in a VAL II file: of all languages only that one writes axes.
bool has_axes(const RawMeasurements& raw, const PreparedPose& pose) {
  return pose.pose_target &&
         file_of_poses(raw.sets[pose.entry]).program.targets[*pose.pose_target].form == OrientationForm::columns;
}

/// One VAL II file with the false targets of every set that has its poses there.
struct CorrectedFile {
  const PointFile* source;
  std::size_t entry;  ///< the first set
  std::vector<CorrectedTarget> targets;
};

CorrectedFile& program_for(std::vector<CorrectedFile>& texts, const RawMeasurements& raw, std::size_t entry) {
  const PointFile& source = file_of_poses(raw.sets[entry]);
  const auto known = std::find_if(texts.begin(), texts.end(), [&](const CorrectedFile& text) {
    return text.source->program.file == source.program.file;
  });
  if (known != texts.end()) return *known;
  texts.push_back({&source, entry, std::vector<CorrectedTarget>(source.program.targets.size())});
  return texts.back();
}

/// A name that no file before has.
std::string free_name(const std::vector<WrittenFile>& files, const std::string& set) {
  if (files.empty()) return "corrected.v2";
  for (std::size_t number = 1;; ++number) {
    const std::string name = "corrected-" + set + (number == 1 ? "" : "-" + std::to_string(number)) + ".v2";
    if (std::none_of(files.begin(), files.end(), [&](const WrittenFile& file) { return file.name == name; })) {
      return name;
    }
  }
}

}  // namespace

std::vector<WrittenFile> false_targets(const RawMeasurements& raw, const Prepared& prepared, FrameKind kind) {
  const std::vector<Eigen::Vector3d> errors_m = differences(prepared, kind);
  CsvTable table{"", 0, {"set", "pose", "x_mm", "y_mm", "z_mm"}, {}};
  std::vector<CorrectedFile> texts;
  for (std::size_t i = 0; i < prepared.poses.size(); ++i) {
    const PreparedPose& pose = prepared.poses[i];
    const Eigen::Vector3d false_m = pose.nominal_m - errors_m[i];
    if (!has_axes(raw, pose)) {
      table.rows.push_back({0, {std::string(to_string(pose.commanded.set)), pose.id}});
      add_mm(table.rows.back().fields, false_m);
      continue;
    }
    CorrectedFile& text = program_for(texts, raw, pose.entry);
    const Target& target = text.source->program.targets[*pose.pose_target];
    std::vector<std::string>& cells = text.targets[*pose.pose_target].texts;
    cells.clear();
    const Eigen::Vector3d in_frame_m = target.frames.base_from_frame.inverse() * false_m;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      cells.push_back(rewritten(target.position[static_cast<std::size_t>(axis)], in_frame_m[axis]).value_or(""));
    }
  }
  std::vector<WrittenFile> files;
  for (const CorrectedFile& text : texts) {
    files.push_back({free_name(files, std::string(to_string(raw.sets[text.entry].set))),
                     replaced(text.source->text, text.source->program, text.targets)});
  }
  if (!table.rows.empty()) files.push_back({"corrected.csv", csv_text(table)});
  return files;
}

WrittenFile errors_file(const Prepared& prepared, FrameKind kind) {
  CsvTable table{"",
                 0,
                 {"set", "pose", "nominal_x_mm", "nominal_y_mm", "nominal_z_mm", "measured_x_mm", "measured_y_mm",
                  "measured_z_mm", "error_x_mm", "error_y_mm", "error_z_mm", "error_mm", "readings", "spread_mm"},
                 {}};
  const bool stated = std::all_of(prepared.poses.begin(), prepared.poses.end(),
                                  [](const PreparedPose& pose) { return pose.measured.standard_error_m.has_value(); });
  for (const char* name : {"standard_error_x_mm", "standard_error_y_mm", "standard_error_z_mm"}) {
    if (stated) table.columns.emplace_back(name);
  }
  const std::vector<Eigen::Vector3d> errors_m = differences(prepared, kind);
  for (std::size_t i = 0; i < prepared.poses.size(); ++i) {
    const PreparedPose& pose = prepared.poses[i];
    std::vector<std::string> fields{std::string(to_string(pose.commanded.set)), pose.id};
    add_mm(fields, pose.nominal_m);
    add_mm(fields, pose.nominal_m + errors_m[i]);
    add_mm(fields, errors_m[i]);
    fields.push_back(mm_text(errors_m[i].norm()));
    fields.push_back(std::to_string(pose.measured.rows.size()));
    fields.push_back(pose.measured.spread_m() ? mm_text(*pose.measured.spread_m()) : "");
    if (stated) add_mm(fields, *pose.measured.standard_error_m);
    table.rows.push_back({0, std::move(fields)});
  }
  return {"errors.csv", csv_text(table)};
}

}  // namespace demecal::inline preparation
