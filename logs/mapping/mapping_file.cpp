#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "core/files.hpp"
#include "core/resources.hpp"
#include "logs/mapping/mapping_reader.hpp"

namespace touchdown::logs {

namespace {

/// A text, or a list of them.
void describe_names(Fields& fields, const char* key, std::vector<std::string>& names,
                    const char* meaning) {
  const YAML::Node given = fields.node()[key];
  if (fields.documenting() || (given && given.IsSequence())) {
    fields(key, names).type("text or list of texts").fallback("none").doc(meaning);
  } else if (given) {
    fields(key, names.emplace_back());
  }
  for (const std::string& name : names) fields.check(!name.empty(), key, "expected a name");
}

bool is_file_name(const std::string& name) {
  const std::string extension = extension_of(name);
  return extension == ".csv" || extension == ".npz" || extension == ".tsv" || extension == ".txt";
}

void describe_sources(Fields& fields, LogSources& sources) {
  describe_names(
      fields, "joints", sources.joints,
      "Files of one folder, or topics of a bag, with the joints. Their clock is the log's. Without "
      "it: the only topic of JointState.");
  describe_names(fields, "imu", sources.imu,
                 "File or topic with the IMU. Without it: the only topic of Imu.");
  describe_names(fields, "contact", sources.contact,
                 "File with the contact labels, if they are not among the joints.");
  fields.check(!sources.empty() || fields.documenting(), "", "expected 'joints', 'imu', or both");
  if (sources.are_files() && sources.joints.empty()) fields.require("joints");
  if (sources.are_files() && sources.imu.empty()) fields.require("imu");
  fields("stale_after", sources.stale_after, 1e-3, 10.0)
      .doc("s", "A value is held until the next one, but is missing when it is older than this.");
}

constexpr double shortest_period = 1e-6;  // s, the unit of recordings

/// One column, or whole seconds and nanoseconds as in the headers of ROS 2.
void describe_clock(Fields& fields, MappingReader& reader, SourceClock& clock) {
  const SignalKind time{
      "the time of each row", 1, {{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}};
  const bool has_parts = fields.present("sec", false) || fields.present("nanosec", false);
  if (!has_parts || fields.documenting()) reader.describe_signal(fields, time, clock.time);
  if (!has_parts) return;
  std::string sec;
  std::string nanosec;
  fields.require("sec", sec).fallback("none").doc("Column of whole seconds, instead of `from`.");
  fields.require("nanosec", nanosec).fallback("none").doc("Column of nanoseconds beside `sec`.");
  SignalKind part = time;
  part.names = {sec};
  reader.take_default(fields, "sec", part, clock.time);
  part.names = {nanosec};
  reader.take_default(fields, "nanosec", part, clock.nanosec.emplace());
}

/// The clock of each source: that of `time`, of its own section, or of a topic's messages.
void describe_clocks(Fields& fields, MappingReader& reader, LogMapping& mapping) {
  const YAML::Node imu = fields.node()["imu"];
  const bool imu_has_own = imu && imu.IsMap() && imu["time"];
  for (std::size_t i = 0; i < reader.sources().size(); ++i) {
    const SourceNames& source = reader.sources()[i];
    SourceClock& clock = mapping.clocks.emplace_back();
    if (source.section == "imu" && imu_has_own) continue;
    reader.enter_source(i);
    if (fields.present("time", false)) {
      fields.within("time", [&](Fields& inner) { describe_clock(inner, reader, clock); });
    } else {
      fields.check(source.is_topic, "time", "is missing: each source needs the time of its rows");
      SignalKind stamp{"the time of each message"};
      stamp.names = {"header.stamp"};
      reader.take_default(fields, "", stamp, clock.time);
    }
    reader.leave_source();
  }
}

/// Reads the IMU's own clock, if its columns have other names than those of the joints.
void describe_imu_clock(Fields& fields, MappingReader& reader, LogMapping& mapping) {
  if (!fields.present("time", false)) return;
  SourceClock unused;
  for (std::size_t i = 0; i < reader.sources().size(); ++i) {
    const bool is_imu = reader.sources()[i].section == "imu";
    fields.check(is_imu || reader.sources().size() > 1, "time",
                 "expected `sources`: rows of one file have one clock");
    if (!is_imu && !fields.documenting()) continue;
    reader.enter_source(i);
    fields
        .within("time",
                [&](Fields& inner) {
                  describe_clock(inner, reader, is_imu ? mapping.clocks[i] : unused);
                })
        .fallback("none")
        .doc("Clock of the IMU's source, if its columns differ from those of `time`.");
    reader.leave_source();
  }
}

/// Reads when the rows of a log were logged: `time` or `period`, or a clock for each source.
void describe_time(Fields& fields, MappingReader& reader, LogMapping& mapping) {
  fields("period", mapping.period)
      .range(fmt::format("{} to {}", shortest_period, longest_period))
      .fallback("none")
      .doc("s", "Time between two rows, instead of `time`.");
  const bool has_period = fields.present("period", false);
  fields.check(
      !has_period || (mapping.period >= shortest_period && mapping.period <= longest_period),
      "period",
      fmt::format("expected the time between two rows (s), at most {} and at least {}",
                  longest_period, shortest_period));
  if (!reader.sources().front().section.empty()) {
    fields.check(!has_period, "period", "sources are joined by their times: expected 'time'");
    return describe_clocks(fields, reader, mapping);
  }
  if (fields.present("time", false)) {
    fields
        .within("time",
                [&](Fields& inner) { describe_clock(inner, reader, mapping.time.emplace()); })
        .fallback("none")
        .doc("Clock of the log, instead of `period`.");
  }
  fields.check(!has_period || !mapping.time, "period",
               "'time' already specifies when rows were logged");
  fields.check(has_period || mapping.time, "time", "is missing: expected 'time' or 'period'");
}

/// Orientations have an order and a reference instead of a unit.
void describe_orientation(Fields& fields, MappingReader& reader, LogMapping& mapping) {
  SignalKind kind{"the quaternion's components in the order of 'order'", 4};
  // sensor_msgs/Imu and REP 103
  std::size_t order = reader.names().is_imu ? 1 : 0;
  std::size_t reference = order;
  if (reader.names().is_imu) {
    kind.names = {"orientation.x", "orientation.y", "orientation.z", "orientation.w"};
  } else {
    fields.check(fields.documenting() || fields.present("orientation", false), "",
                 "'orientation' is missing: estimators need the direction of gravity. Map the "
                 "quaternion of an attitude filter, such as Upkie's or imu_filter_madgwick, run "
                 "over the log if it has none");
    fields.require("orientation");
  }
  const auto describe_quaternion = [&](Fields& inner) {
    inner.choose("order", {"wxyz", "xyzw"}, order).doc("Order of the quaternion's components.");
    inner.choose("reference", {"z_down", "z_up"}, reference)
        .doc("Direction of the reference's z axis.");
    reader.describe_signal(inner, kind, mapping.orientation);
  };
  if (fields.present("orientation", false)) {
    fields.within("orientation", describe_quaternion)
        .doc("Quaternion from the IMU's frame to its reference.");
  } else {
    reader.take_default(fields, "orientation", kind, mapping.orientation);
  }
  mapping.is_w_last = order == 1;
  mapping.conventions.reference_is_z_up = reference == 1;
}

/// Reads the rotation to Upkie's IMU axes: each is x, y or z of the log's IMU, or its reverse.
void describe_axes(Fields& fields, bool is_imu, Eigen::Matrix3d& axes) {
  // REP 103: x forward, y left, z up
  std::vector<std::string> names =
      is_imu ? std::vector<std::string>{"-x", "y", "-z"} : std::vector<std::string>{"x", "y", "z"};
  fields("axes", names)
      .range("x, y, z, each with or without a minus")
      .doc("Axes of the log's IMU that point back, left and down.");
  constexpr const char* expected =
      "expected the log's axes that point back, left and down, such as [-x, y, -z]: a right-handed "
      "order of x, y and z, each with or without a minus";
  fields.check(names.size() == 3, "axes", expected);
  axes = signed_axes({names[0], names[1], names[2]});
  fields.check(!axes.isZero(), "axes", expected);
}

void describe_imu(Fields& fields, MappingReader& reader, LogMapping& mapping) {
  const bool is_imu = reader.names().is_imu;
  const auto kind = [&](const char* signal, const std::vector<Unit>& units) {
    SignalKind one{"x, y, z", 3, units};
    for (const char* axis : {".x", ".y", ".z"}) {
      if (is_imu) one.names.push_back(std::string(signal) + axis);
    }
    return one;
  };
  describe_imu_clock(fields, reader, mapping);
  describe_orientation(fields, reader, mapping);
  reader
      .require(fields, "angular_velocity", kind("angular_velocity", turn_rates()),
               mapping.angular_velocity)
      .doc("Angular velocity of the IMU.");
  const SignalKind acceleration = kind("linear_acceleration", accelerations());
  reader.optional(fields, "linear_acceleration", acceleration, mapping.linear_acceleration)
      .doc("Acceleration without gravity; this or the next is needed.");
  reader.optional(fields, "proper_acceleration", acceleration, mapping.proper_acceleration)
      .doc("Acceleration as the chip measures it, gravity included.");
  if (is_imu && !mapping.linear_acceleration && !mapping.proper_acceleration) {
    reader.take_default(fields, "", acceleration, mapping.proper_acceleration.emplace());
  }
  const bool has_rotation = fields.present("rotation", false);
  fields.check(fields.documenting() || !has_rotation || !fields.present("axes", false), "rotation",
               "expected either 'rotation' or 'axes'");
  describe_axes(fields, is_imu, mapping.conventions.axes);
  if (has_rotation) {
    fields
        .within("rotation",
                [&](Fields& inner) { describe_mounting(inner, mapping.conventions.axes); })
        .fallback("none")
        .doc(
            "Mounting of the log's IMU, from its axes to the robot's (forward, left, up), instead "
            "of `axes`.");
  }
  fields.check(mapping.linear_acceleration || mapping.proper_acceleration, "",
               "expected 'linear_acceleration', without gravity, or 'proper_acceleration', as the "
               "chip measures it");
  mapping.conventions.acceleration = mapping.linear_acceleration
                                         ? AccelerationSource::without_gravity
                                         : AccelerationSource::proper;
}

/// Whether the name is that of an array with a column for each wheel.
bool is_wide(const SourceNames& names, const YAML::Node& name) {
  return names.shape && name.IsScalar() && names.shape(name.Scalar())[1] == models::wheel_count;
}

void describe_contact(Fields& fields, MappingReader& reader, LogMapping& mapping) {
  if (!fields.present("contact", false)) return;
  const auto describe_labels = [&](Fields& inner) {
    inner("above", mapping.contact_above).doc("A number above this is contact.");
    const YAML::Node from = inner.node()["from"];
    const YAML::Node index = inner.node()["index"];
    const bool is_pair = inner.documenting() || (from && from.size() == 2) ||
                         (index && index.size() == 2) ||
                         (from && !index && is_wide(reader.names(), from));
    reader.describe_signal(inner, {"both wheels, or left and right", is_pair ? 2U : 1U},
                           mapping.contact.emplace());
  };
  fields.within("contact", describe_labels)
      .fallback("none")
      .doc("Contact labels: a flag or a force, one for both wheels or left and right.");
}

void describe_mapping(Fields& fields, MappingReader& reader, LogMapping& mapping,
                      bool with_labels) {
  fields("robot", mapping.robot)
      .fallback("none")
      .doc("Name of the robot; a model that was fitted to another robot is then refused.");
  if (fields.present("sources", false)) {
    fields.within("sources", [&](Fields& inner) { describe_sources(inner, mapping.sources); })
        .fallback("none")
        .doc("Sources with clocks of their own: files, or topics of a ROS 2 bag.");
  }
  reader.enter("joints");
  describe_time(fields, reader, mapping);
  fields.require("joints");
  fields.within("joints", [&](Fields& inner) { describe_joints(inner, reader, mapping); })
      .doc("Signals of the six servos.");
  reader.enter("imu");
  if (!reader.names().is_imu) fields.require("imu");
  if (fields.present("imu", false)) {
    fields.within("imu", [&](Fields& inner) { describe_imu(inner, reader, mapping); })
        .doc("Signals of the IMU.");
  } else {  // that of a topic needs no keys
    Fields none(YamlDocument::parse("{}", ""));
    describe_imu(none, reader, mapping);
  }
  reader.enter("contact");
  if (with_labels) describe_contact(fields, reader, mapping);
  const bool has_clocks = !mapping.clocks.empty();
  if (has_clocks) mapping.time = mapping.clocks[mapping.joint_source()];
  if (mapping.time) {
    SourceColumn rest = mapping.columns[mapping.time->time.numbers.front().column];
    rest.is_rest = true;
    mapping.time->rest = mapping.columns.size();
    mapping.columns.push_back(std::move(rest));
    if (has_clocks) mapping.clocks[mapping.joint_source()] = *mapping.time;
  }
}

/// Errors: `InputError` also for unknown keys, and for a robot's file, which `--robot` takes.
YamlDocument load_mapping(const std::filesystem::path& path) {
  require_file(path);
  YamlDocument document = YamlDocument::load(path);
  if (document.root()["mjcf"]) {
    throw InputError(fmt::format(
        "{}: is a robot's file, which --robot takes: expected a mapping file, with joints and imu",
        path.string()));
  }
  Fields(document).refuse_undocumented(mapping_keys());
  return document;
}

}  // namespace

bool LogSources::are_files() const {
  return std::ranges::any_of(joints, is_file_name) || std::ranges::any_of(imu, is_file_name);
}

std::vector<std::string> LogSources::all() const {
  std::vector<std::string> names = joints;
  names.insert(names.end(), imu.begin(), imu.end());
  names.insert(names.end(), contact.begin(), contact.end());
  return names;
}

LogSources read_log_sources(const std::filesystem::path& mapping) {
  const YamlDocument document = load_mapping(mapping);
  LogSources sources;
  Fields fields(document);
  if (fields.present("sources", false))
    fields.within("sources", [&](Fields& inner) { describe_sources(inner, sources); });
  return sources;
}

std::size_t LogMapping::joint_source() const {
  for (const MappedSignal::Number& number : position.numbers) {
    if (number.column < columns.size()) return columns[number.column].source;
  }
  return 0;
}

std::vector<Key> mapping_keys() {
  const SourceNames arrays{.file = "", .are_arrays = true, .names = {}};
  LogMapping mapping;
  MappingReader reader(std::span(&arrays, 1), mapping);
  KeyCollection keys;
  Fields fields(keys);
  describe_mapping(fields, reader, mapping, true);
  return keys.keys();
}

LogMapping read_log_mapping(const std::filesystem::path& path, std::span<const SourceNames> sources,
                            bool with_labels) {
  const YamlDocument document = load_mapping(path);
  LogMapping mapping;
  mapping.folder = path.parent_path();
  MappingReader reader(sources, mapping);
  Fields fields(document);
  describe_mapping(fields, reader, mapping, with_labels);
  return mapping;
}

}  // namespace touchdown::logs
