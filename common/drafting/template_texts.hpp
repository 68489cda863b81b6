// The texts of templates, with the places that given files fill.
#pragma once

#include <string_view>

namespace demecal::inline drafting {

inline constexpr std::string_view kRobotTemplate =
    R"yaml(# The arm as its maker specifies it. A URDF makes this file by itself: demecal robot import FILE.urdf --out ROBOT.yaml
demecal_robot: 1
name: My arm
convention: standard_dh    # standard_dh: Rz(theta) Tz(d) Tx(a) Rx(alpha); modified_dh (Craig): Rx(alpha) Tx(a) Rz(theta) Tz(d)
joints:                    # from the base on; the figures below are an example: replace them by those of your arm
@JOINTS@tool_mm: [0, 0, 0]         # the measured point, in the frame of the last link
# Optional:
# links:                   # one a joint: masses for effects of gravity, centres of mass in each link's own frame
#   - {mass_kg: 20, com_mm: [0, 0, 100]}
# gravity_mps2: [0, 0, -9.81]   # in the base frame: other for a wall, a ceiling or a tilted base
# repeatability_mm: 0.05   # the maker's
# home_deg: [0, -90, 90, 0, 90, 0]   # where programs start that do not say it
# balancers:                          # springs that relieve joints: pivots from the axis, and where it is shortest
#   - {joint: 2, fixed_mm: 250, moving_mm: 400, shortest_deg: 90}
)yaml";

inline constexpr std::string_view kDataSetTemplate =
    R"yaml(# What was measured, and in which columns of which files. Units stand in names (_deg _rad _mm _m) or in headings ("X [mm]").
demecal_dataset: 1
name: my measurement
robot: @ROBOT@
poses: poses.csv           # CSV, or text with semicolons, tabs or blanks; decimal commas and lines before the table are recognised
columns:                   # by name, or by number from 1
  joints: @JOINTS@   # commanded, one a joint
  position: [x_mm, y_mm, z_mm]   # measured tool point
  # orientation: [qw, qx, qy, qz]    # measured, unit quaternion
  # approach: [s1, s2, s3, s4, s5, s6]   # sign of each joint's last motion: shows backlash
  # torque: [torque1_nm, torque2_nm, torque3_nm, torque4_nm, torque5_nm, torque6_nm]   # as the controller logged them
  # payload: payload_kg
  # temperature: temperature_celsius
  # time: time_s
  # set: set                         # calibration, validation or accept
  # pose: pose_id                    # equal names are repeats of one pose
# Two files, as a controller's log and a tracker's:
# poses:
#   - {file: joints.csv, columns: {joints: [q1, q2, q3, q4, q5, q6], time: stamp}}
#   - {file: tracker.txt, decimal: comma, columns: {position: [X, Y, Z], time: 1}}
# join: {by: time, within_s: 0.5, offset_s: auto}   # or {by: name}, {by: order}
# units: {angle: deg, length: mm}    # of columns whose names and headings state none
frame: sensor              # sensor: positions are in the instrument's frame; base: in the robot's
split: {validation_fraction: 0.3, seed: 1}   # used where there is no column `set`
# exclude: [P7]            # poses to leave out of everything
)yaml";

inline constexpr std::string_view kJobTemplate = R"yaml(# A calibration: demecal calibrate THIS-FILE --out DIR
demecal_job: 1
data: @DATA@
method: direct             # direct, distal, diagnose (no correction is evolved) or structural
seed: 1                    # the same seed gives the same model
model:
  # What the model contains from the start. registration: where the base is in the instrument's frame; tool: the measured
  # point; joint_offset: zero positions; geometry: lengths and angles of the links; joint_corrections: evolved formulas
  declared: [registration, tool, joint_offset, geometry, joint_corrections]
closed_loop:
  max_effects: 150         # 0: nothing is looked for beyond what is declared
  family_error: 0.05       # chance of adding anything to a model that lacks nothing
  # candidates: [backlash, compliance, gear_harmonic]   # all kinds, unless named
# How formulas are evolved; the defaults serve most arms:
# gp: {population_size: 300, number_generations: 200}
# islands: {per_joint: 2, topology: ring, migration_interval: 10, migrants: 3}
)yaml";

inline constexpr std::string_view kScenarioTemplate =
    R"yaml(# A simulated measurement: demecal simulate THIS-FILE --out DIR
demecal_scenario: 1
name: my simulation
robot: @ROBOT@
seed: 1
poses: {calibration: 60, validation: 30, accept: 30, repeats: 1}
joint_ranges: {}           # joints anywhere within their limits; or {q1_deg: [-90, 90]}, or a cuboid for the tool
measurement:
  sensor_from_base: {translation_mm: [1500, -500, 300], rotation_deg: [0, 0, 90]}   # where the instrument sees the base
  noise_mm: 0.05           # standard deviation of a coordinate
  approach_recorded: true
errors:                    # what the real arm does otherwise; every kind is listed in docs/FORMATS.md
  geometry: [{joint: 1, a_mm: 0.4, alpha_deg: 0.02}]
  joint_errors: [{joint: 1, formula: "0.001 * SIN(theta)"}]   # rad
  backlash: [{joint: 2, width_deg: 0.02}]
)yaml";

inline constexpr std::string_view kPreparationTemplate =
    R"yaml(# Raw measurements to a data set: demecal prepare THIS-FILE --out DIR
demecal_preparation: 1
name: my measurement
robot: @ROBOT@
instrument: points         # it gives coordinates; a map `cords` describes three draw wires, see docs/FORMATS.md
repeats: keep              # every reading a row; average: one row a pose
sets:
  # joints: a robot program or table with the joints of each pose; readings: a table with pose, x_mm, y_mm, z_mm
  - {set: calibration, joints: @PROGRAM@, readings: @READINGS@}
  # - {set: validation, joints: validation.csv, readings: validation-readings.csv}
# local_frame: {robot: frame.csv, instrument: frame-readings.csv, tolerance_mm: 5}   # three points that both know
# In place of instrument, repeats and sets: recordings of the joints while the arm touched points and stood still there
# log:
#   files: recording.csv     # or a list; columns of joints and times are found by their headings
#   still_s: 0.5             # how long it stood at a touch, at least
#   names: [left, right]     # in the order in which they were first touched; without it A, B, ...
#   distances: [{between: [left, right], mm: 50, sigma_mm: 0.05}]   # known lengths give the scale
)yaml";

}  // namespace demecal::inline drafting
