#include "recordings/mapping/mapping.hpp"

#include <cmath>
#include <string_view>

#include "core/fields.hpp"
#include "core/resources.hpp"
#include "recordings/mapping/clock_keys.hpp"
#include "recordings/mapping/joint_keys.hpp"
#include "recordings/mapping/mapping_reader.hpp"
#include "recordings/mapping/mounting.hpp"

namespace touchdown::recordings {

namespace {

/// Orientations have an order and a reference instead of a unit.
void describe_orientation(Fields& fields, MappingReader& reader, LogMapping& mapping) {
  SignalKind kind{"the quaternion's components in the order of 'order'", 4};
  // sensor_msgs/Imu and REP 103
  std::size_t order = reader.names().is_topic ? 1 : 0;
  std::size_t reference = order;
  if (reader.names().is_topic) {
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
  mapping.reference_is_z_up = reference == 1;
}

/// Reads the rotation to Upkie's IMU axes: each is x, y or z of the log's IMU, or its reverse.
void describe_axes(Fields& fields, bool is_topic, Eigen::Matrix3d& axes) {
  // REP 103: x forward, y left, z up
  std::vector<std::string> names = is_topic ? std::vector<std::string>{"-x", "y", "-z"}
                                            : std::vector<std::string>{"x", "y", "z"};
  fields("axes", names)
      .range("x, y, z, each with or without a minus")
      .doc("Axes of the log's IMU that point back, left and down.");
  constexpr const char* expected =
      "expected the log's axes that point back, left and down, such as [-x, y, -z]: a right-handed "
      "order of x, y and z, each with or without a minus";
  fields.check(names.size() == 3, "axes", expected);
  axes.setZero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    std::string_view axis = names[static_cast<std::size_t>(i)];
    const double sign = axis.starts_with('-') ? -1.0 : 1.0;
    if (sign < 0.0) axis.remove_prefix(1);
    const std::size_t j = axis.size() == 1 ? std::string_view("xyz").find(axis) : 3;
    fields.check(j < 3, "axes", expected);
    axes(i, static_cast<Eigen::Index>(j)) = sign;
  }
  fields.check(axes.determinant() == 1.0, "axes", expected);
}

void describe_imu(Fields& fields, MappingReader& reader, LogMapping& mapping) {
  expect_keys(fields, {"time", "orientation", "angular_velocity", "linear_acceleration",
                       "proper_acceleration", "axes", "rotation"});
  const bool is_topic = reader.names().is_topic;
  const auto kind = [&](const char* signal, const std::vector<Unit>& units) {
    SignalKind one{"x, y, z", 3, units};
    for (const char* axis : {".x", ".y", ".z"}) {
      if (is_topic) one.names.push_back(std::string(signal) + axis);
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
  if (is_topic && !mapping.linear_acceleration && !mapping.proper_acceleration) {
    reader.take_default(fields, "", acceleration, mapping.proper_acceleration.emplace());
  }
  const bool has_rotation = fields.present("rotation", false);
  fields.check(fields.documenting() || !has_rotation || !fields.present("axes", false), "rotation",
               "expected either 'rotation' or 'axes'");
  describe_axes(fields, is_topic, mapping.axes);
  if (has_rotation) {
    fields.within("rotation", [&](Fields& inner) { describe_mounting(inner, mapping.axes); })
        .fallback("none")
        .doc(
            "Mounting of the log's IMU, from its axes to the robot's (forward, left, up), instead "
            "of `axes`.");
  }
  fields.check(mapping.linear_acceleration || mapping.proper_acceleration, "",
               "expected 'linear_acceleration', without gravity, or 'proper_acceleration', as the "
               "chip measures it");
}

/// Whether the name is that of an array with a column for each wheel.
bool is_wide(const SourceNames& names, const YAML::Node& name) {
  return names.width && name.IsScalar() && names.width(name.Scalar()) == models::wheel_count;
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

void describe_mapping(Fields& fields, MappingReader& reader, LogMapping& mapping) {
  expect_keys(fields, {"robot", "sources", "period", "time", "joints", "imu", "contact"});
  fields("robot", mapping.robot)
      .fallback("none")
      .doc("Name of the robot; a model that was fitted to another robot is then refused.");
  if (fields.present("sources", false)) {
    fields.section("sources", mapping.sources)
        .fallback("none")
        .doc("Sources with clocks of their own: files, or topics of a ROS 2 bag.");
  }
  reader.enter("joints");
  describe_time(fields, reader, mapping);
  fields.require("joints");
  fields.within("joints", [&](Fields& inner) { describe_joints(inner, reader, mapping); })
      .doc("Signals of the six servos.");
  reader.enter("imu");
  if (!reader.names().is_topic) fields.require("imu");
  if (fields.present("imu", false)) {
    fields.within("imu", [&](Fields& inner) { describe_imu(inner, reader, mapping); })
        .doc("Signals of the IMU.");
  } else {  // that of a topic needs no keys
    Fields none(YamlDocument::parse("{}", ""));
    describe_imu(none, reader, mapping);
  }
  reader.enter("contact");
  describe_contact(fields, reader, mapping);
  if (!mapping.clocks.empty()) mapping.time = mapping.clocks[mapping.joint_source()];
}

}  // namespace

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
  describe_mapping(fields, reader, mapping);
  return keys.keys();
}

LogMapping read_log_mapping(const std::filesystem::path& path,
                            std::span<const SourceNames> sources) {
  require_file(path);
  const YamlDocument document = YamlDocument::load(path);
  LogMapping mapping;
  MappingReader reader(sources, mapping);
  Fields fields(document);
  describe_mapping(fields, reader, mapping);
  return mapping;
}

}  // namespace touchdown::recordings
