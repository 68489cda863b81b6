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
# base: {xyz_mm: [0, 0, 0], rpy_deg: [0, 0, 0]}     # where the first link begins in the base frame
# flange: {xyz_mm: [0, 0, 0], rpy_deg: [0, 0, 0]}   # the flange in the frame of the last link
# couplings:               # joints whose drives the controller also turns by another's command, as joint 3 of a FANUC
#   - {joint: 3, from: 2, factor: 1}
# links:                   # one a joint: masses for effects of gravity, centres of mass in each link's own frame
#   - {mass_kg: 20, com_mm: [0, 0, 100]}   # and, where known, inertia_kgm2: [ixx, ixy, ixz, iyy, iyz, izz] about it
# gravity_mps2: [0, 0, -9.81]   # in the base frame: other for a wall, a ceiling or a tilted base
# repeatability_mm: 0.05   # the maker's
# payload_kg: 10           # the most that the arm carries: data and programs with more are named
# home_deg: [0, -90, 90, 0, 90, 0]   # where programs start that do not say it
# pulses_per_deg: [1024, 1024, 1024, 900, 900, 450]   # of the positions in pulses of a Yaskawa's jobs
# balancers:                          # springs that relieve joints: pivots from the axis, and where it is shortest
#   - {joint: 2, fixed_mm: 250, moving_mm: 400, shortest_deg: 90}
# urdf: {file: arm.urdf, base: base_link, tip: tool0}   # which export --format urdf writes anew
# Of joints, where the pendant's angles or the arm's build ask for it:
# joints:
#   - {name: elbow, type: revolute, alpha_deg: 0, a_mm: 0, d_mm: 0, beta_deg: 0, direction: -1, offset_deg: 90,
#      limits_deg: [-90, 90], gear: {kind: strain_wave, ratio: 100}}
#   - {type: prismatic, alpha_deg: 0, a_mm: 0, d_mm: 0, offset_mm: 0, limits_mm: [0, 3000]}   # first: a rail
# With convention: urdf joints stand by origins and axes:
# joints:
#   - {type: continuous, xyz_mm: [0, 0, 333], rpy_deg: [0, 0, 0], axis: [0, 0, 1]}   # turns without limits
# and a positioner may carry the workpiece, from which positions then count; its joints come first, the last of them before all, as in
#   positioner: [{name: tilt, type: revolute, xyz_mm: [1200, 0, 700], axis: [0, 1, 0], limits_deg: [-90, 90]}]
# which may hold it aside by workpiece: {xyz_mm: [0, 0, 100], rpy_deg: [0, 0, 0]}
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
  # sigma: [sx_mm, sy_mm, sz_mm]     # standard uncertainty of each position; or of range and angles
  # distances: [l1_mm]               # from anchors_mm, in place of a position
  # target: target_id                # which of tools_mm was measured
  # contact: contact_id              # what the tool touches, in place of an instrument
# Two files, as a controller's log and a tracker's:
# poses:
#   - {file: joints.csv, columns: {joints: [q1, q2, q3, q4, q5, q6], time: stamp}}
#   - {file: tracker.txt, delimiter: semicolon, decimal: comma, header_line: 3, columns: {position: [X, Y, Z], time: 1}}
# join: {by: time, within_s: 0.5, offset_s: auto, unmatched: leave_out}   # or {by: name}, {by: order}
# units: {angle: deg, length: mm}    # of columns whose names and headings state none
frame: sensor              # sensor: positions are in the instrument's frame; base: in the robot's
split: {validation_fraction: 0.3, accept_fraction: 0, seed: 1}   # used where there is no column `set`
# exclude: [P7]            # poses to leave out of everything
# anchors_mm: [[1000, 0, 0]]         # of distances, in the frame of the data; or unknown
# tools_mm: {A: [0, 0, 50], B: [0, 30, 50]}   # the tool points that a column `target` names
# contacts:                # what is known of what the tool touched, by its name in the column `contact`
#   kinds: {ball: sphere, plate: plane, edge: line, socket: point}
#   radii_mm: {ball: 12.7}
#   radii_sigma_mm: {ball: 0.05}
#   flatness_mm: {plate: 0.05}
#   distances: [{between: [ball, socket], mm: 50, sigma_mm: 0.05}]
#   grids: [{places_mm: {ball: [0, 0], socket: [50, 0]}, sigma_mm: 0.02}]   # where holes are on a plate
#   parallel: [{between: [plate, edge], sigma_deg: 0.01}]
#   square: [{between: [plate, edge], sigma_deg: 0.01}]
@CERTIFICATE@)yaml";

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
  # highest_ratio: 200     # of the scan for gear harmonics, periods a turn
  # ratios: [375.5]        # and further ones
# The defaults below serve most arms:
# station_tools: own       # or shared: of several stations (data: a list) the tools were the same
# targets: posterior       # or exact: what joints learn at a pose
# joint_error_mrad: 1      # standard deviation of a joint's error
# explanations: {variations: 10000, max_causes: 24}
# distal: {form: parallel, rounds: 8, amplitudes: fitted}
# gp:                      # how formulas are evolved
#   population_size: 300
#   number_generations: 200
#   tournament_size: 5
#   initial_max_tree_depth1: 3
#   initial_max_tree_depth2: 5
#   max_tree_depth: 9
#   max_tree_nodes: 0
#   min_tree_depth: 3
#   invalid_attempts: 21
#   crossover_rate: 0.8
#   mutation_rate: 0.2
#   terminal_crossover_rate: 0.2
#   terminal_mutation_rate: 0.3
#   shrink_mutation_rate: 0.2
#   functions: ["+", "-", "*", "%", SIN, COS, SIGN, SQRTp]
#   function_weights: []
#   constants_range: [0, 1]
#   constants: none        # or lamarckian, baldwin
#   constant_steps: 10
#   constant_share: 1
#   linear_scaling: false
#   no_duplicates: false
#   restart_after: 0
#   largest_correction_mrad: 3
#   seed_formulas: [{joint: 1, expression: "0.001 * SIN(theta)"}]
#   seed_models: []
#   shared_functions: 0
#   function_stages: 4
#   shared_function_weight: 1
# islands:
#   per_joint: 2
#   topology: ring         # or none, full
#   migration_interval: 10
#   migrants: 3
#   between_joints: false
#   replacement: worst     # or random
#   spread: 0
@CERTIFICATE@)yaml";

/// What a certificate says beside figures, of data sets and jobs.
inline constexpr std::string_view kCertificateKeys =
    R"yaml(# certificate:             # what a certificate says beside figures, each as far as it is known
#   certificate_number: "K-2026-17"
#   customer: "Foundry Ltd"
#   customer_address: "1 Mill Lane, Leeds"
#   laboratory: "Robot Metrology"
#   laboratory_address: "2 Mill Lane, Leeds"
#   country: GB            # of the laboratory
#   robot: "PUMA 761"
#   manufacturer: "Unimation"
#   serial_number: "761-0042"
#   instrument: "laser tracker"
#   instrument_serial_number: "LT-3"
#   instrument_calibration: "C-881, 2026-01-08"
#   instrument_uncertainty_mm: 0.02   # expanded (k = 2), of a position
#   operator: "A. Person"
#   date: "2026-01-31"     # of the measurement
#   place: "cell 7"
#   environment: "20.5 to 21.0 deg C"
#   remarks: "after the gripper was changed"
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
  # A robot program or table with the joints of each pose, and a table with pose, x_mm, y_mm, z_mm of what was read
  - {set: calibration, joints: @PROGRAM@, readings: @READINGS@}
  # - {set: validation, joints: program.v2, points: vp, poses: poses.v2, pose_points: vm, readings: validation.csv}
# local_frame: {robot: frame.csv, points: lf, instrument: frame-readings.csv, tolerance_mm: 5}   # three points of both
# instrument:              # three draw wires in place of coordinates: outlets, lengths that are not measured, encoders
#   cords:
#     triangle_mm: {ab: 1420, bc: 1385.5, ca: 1310.25}
#     top_cords_mm: [0, 0, 0]
#     encoders: {bar_mm: 500, bar_counts: [9937, 9956, 9926], zero_counts: [0, 0, 0]}   # or counts_per_mm: [20, 20, 20]
#     side: above
#     standard_error_mm: 0.2
# In place of instrument, repeats and sets: recordings of the joints while the arm touched points and stood still there
# log:
#   files:                   # or one path: columns of joints and times are found by their headings
#     - recording.csv
#     - {file: another.csv, set: calibration, columns: {joints: [2, 3, 4, 5, 6, 7], time: 1, nanoseconds: 8},
#        units: {angle: deg, length: mm}, delimiter: comma, decimal: point, header_line: 1}
#   still_s: 0.5             # how long it stood at a touch, at least
#   still_deg_per_s: 0.057   # what is slower stands
#   still_mm_per_s: 1        # the same of joints that slide
#   gap_mm: 5                # between tool points of one contact and of another
#   names: [left, right]     # in the order in which they were first touched; without it A, B, ...
#   distances: [{between: [left, right], mm: 50, sigma_mm: 0.05}]   # known lengths give the scale
)yaml";

}  // namespace demecal::inline drafting
