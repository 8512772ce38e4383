#include "recordings/mapping/mapping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/fields.hpp"
#include "core/resources.hpp"
#include "recordings/mapping/mounting.hpp"

namespace touchdown::recordings {

namespace {

struct Unit {
  std::string name;
  double size;
};

/// The options that a mapping file has for a signal.
struct SignalKind {
  std::string what;  ///< its numbers in order, for messages
  std::size_t count = 1;
  std::vector<Unit> units = {};  ///< the first is the unit of touchdown
  bool has_zero = false;
};

constexpr double degree = 3.14159265358979323846 / 180.0;
constexpr double turn = 360.0 * degree;
constexpr double standard_gravity = 9.80665;
constexpr double largest_zero = 1e6;      // rad, of an encoder that counts turns
constexpr double shortest_period = 1e-6;  // s, the unit of recordings
constexpr const char* six_joints = "left hip, knee, wheel, right hip, knee, wheel";
constexpr const char* four_joints = "left knee, wheel, right knee, wheel";

std::vector<Unit> speeds() {
  return {{"rad/s", 1.0}, {"deg/s", degree}, {"rev/s", turn}, {"rpm", turn / 60.0}};
}

std::vector<Unit> accelerations() { return {{"m/s^2", 1.0}, {"g", standard_gravity}}; }

/// Reads a single value or a list.
template <typename T>
KeyNotes one_or_more(Fields& fields, const std::string& key, std::vector<T>& values) {
  const YAML::Node given = fields.node()[key];
  if (given && given.IsSequence()) return fields(key, values);
  values.assign(1, T{});
  return fields(key, values.front());
}

/// Declares all valid keys, so that a misspelt key is reported as such, and not as a missing one.
void expect_keys(Fields& fields, std::initializer_list<const char*> keys) {
  for (const char* key : keys) fields.know(key);
  fields.finish();
}

/// Reads one number per component of a signal; `values` stay empty if the key is absent.
KeyNotes number_for_each(Fields& fields, const std::string& key, std::size_t count,
                         std::vector<double>& values) {
  if (!fields.present(key, false)) return {};
  const KeyNotes notes = one_or_more(fields, key, values);
  if (values.size() == 1) values.resize(count, values.front());
  fields.check(values.size() == count, key, fmt::format("expected a number, or {}", count));
  return notes.type(count == 1 ? "number" : fmt::format("number or list of {}", count));
}

double unit_of(Fields& fields, const std::vector<Unit>& units) {
  if (units.empty()) return 1.0;
  std::vector<std::string> names;
  for (const Unit& unit : units) names.push_back(unit.name);
  std::size_t index = 0;
  fields.choose("unit", names, index).doc("Unit of the log's numbers.");
  return units[index].size;
}

/// Lists the first few names of a log, for messages.
std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t most = 8;
  const auto shown = std::span(names).first(std::min(names.size(), most));
  return fmt::format(" (it has {}{})", fmt::join(shown, ", "), names.size() > most ? ", …" : "");
}

/// Reads signals and collects the columns that they need.
class MappingReader {
 public:
  MappingReader(const SourceNames& names, LogMapping& mapping) : names_(names), mapping_(mapping) {}

  KeyNotes require(Fields& fields, std::string_view key, const SignalKind& kind,
                   MappedSignal& signal) {
    fields.require(key);
    return fields.within(key, [&](Fields& inner) { describe_signal(inner, kind, signal); });
  }

  KeyNotes optional(Fields& fields, std::string_view key, const SignalKind& kind,
                    std::optional<MappedSignal>& signal) {
    if (!fields.present(key, false)) return {};
    MappedSignal& value = signal.emplace();
    return fields.within(key, [&](Fields& inner) { describe_signal(inner, kind, value); })
        .fallback("none");
  }

  /// Orientations have an order and a reference instead of a unit.
  void describe_orientation(Fields& fields) {
    fields.check(fields.documenting() || fields.present("orientation", false), "",
                 "'orientation' is missing: estimators need the direction of gravity. Map the "
                 "quaternion of an attitude filter, such as Upkie's or imu_filter_madgwick, run "
                 "over the log if it has none");
    fields.require("orientation");
    const auto describe_quaternion = [&](Fields& inner) {
      std::size_t order = 0;
      std::size_t reference = 0;
      inner.choose("order", {"wxyz", "xyzw"}, order).doc("Order of the quaternion's components.");
      inner.choose("reference", {"z_down", "z_up"}, reference)
          .doc("Direction of the reference's z axis.");
      mapping_.is_w_last = order == 1;
      mapping_.reference_is_z_up = reference == 1;
      describe_signal(inner, {"the quaternion's components in the order of 'order'", 4},
                      mapping_.orientation);
    };
    fields.within("orientation", describe_quaternion)
        .doc("Quaternion from the IMU's frame to its reference.");
  }

  void describe_contact(Fields& fields) {
    if (!fields.present("contact", false)) return;
    const auto describe_labels = [&](Fields& inner) {
      inner("above", mapping_.contact_above).doc("A number above this is contact.");
      const YAML::Node from = inner.node()["from"];
      const YAML::Node index = inner.node()["index"];
      const bool is_pair = inner.documenting() || (from && from.size() == 2) ||
                           (index && index.size() == 2) || (from && !index && is_wide(from));
      describe_signal(inner, {"both wheels, or left and right", is_pair ? 2U : 1U},
                      mapping_.contact.emplace());
    };
    fields.within("contact", describe_labels)
        .fallback("none")
        .doc("Contact labels: a flag or a force, one for both wheels or left and right.");
  }

 private:
  /// Whether the name is that of an array with a column for each wheel.
  bool is_wide(const YAML::Node& name) const {
    return names_.width && name.IsScalar() && names_.width(name.Scalar()) == models::wheel_count;
  }

  void describe_signal(Fields& fields, const SignalKind& kind, MappedSignal& signal) {
    if (names_.are_arrays) fields.know("index");
    if (kind.has_zero) fields.know("zero");
    if (!kind.units.empty()) fields.know("unit");
    expect_keys(fields, {"from", "sign", "scale"});
    fields.require("from");
    const std::vector<SourceColumn> columns = columns_of(fields, kind);
    std::vector<double> sign;
    number_for_each(fields, "sign", kind.count, sign)
        .range("1 or -1")
        .fallback("1")
        .doc("Sign of all numbers, or of each.");
    for (const double one : sign) fields.check(std::abs(one) == 1.0, "sign", "expected 1 or -1");
    std::vector<double> scale;
    number_for_each(fields, "scale", kind.count, scale)
        .range("above 0")
        .fallback("1")
        .doc("Factor of all numbers, or of each: a gear ratio, or a torque constant (N·m/A).");
    for (const double one : scale) {
      fields.check(std::isfinite(one) && one > 0.0, "scale",
                   "expected a number above 0; a reversed direction is a 'sign' of -1");
    }
    std::vector<double> zero;
    if (kind.has_zero) {
      number_for_each(fields, "zero", kind.count, zero)
          .doc("rad", "The log's position where touchdown's is zero.");
    }
    for (const double one : zero) {
      fields.check(std::abs(one) <= largest_zero, "zero",
                   fmt::format("expected an angle from -{0} to {0} rad", largest_zero));
    }
    signal.unit = unit_of(fields, kind.units);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      signal.numbers.push_back(
          {take(fields, columns[i]), sign.empty() ? 1.0 : sign[i], zero.empty() ? 0.0 : zero[i]});
      if (!scale.empty()) signal.numbers.back().scale = scale[i];
    }
  }

  std::vector<SourceColumn> columns_of(Fields& fields, const SignalKind& kind) const {
    std::vector<std::string> from;
    one_or_more(fields, "from", from)
        .type(kind.count == 1 ? "text" : "text or list of texts")
        .doc(fmt::format("Columns or arrays: {}.", kind.what));
    for (const std::string& name : from) check_is_there(fields, name);
    if (names_.are_arrays) return columns_of_arrays(fields, kind, from);
    fields.check(from.size() == kind.count, "from",
                 fmt::format("expected {} of the names of columns: {}", kind.count, kind.what));
    std::vector<SourceColumn> columns;
    for (const std::string& name : from) columns.push_back({name});
    return columns;
  }

  /// The numbers of a signal are columns of one array (the first ones, unless `index` selects
  /// others), or come from one array each.
  static std::vector<SourceColumn> columns_of_arrays(Fields& fields, const SignalKind& kind,
                                                     const std::vector<std::string>& from) {
    const bool is_of_one = from.size() == 1;
    fields.check(
        is_of_one || from.size() == kind.count, "from",
        fmt::format("expected an array with two axes, or {} with one: {}", kind.count, kind.what));
    std::vector<int> index;
    const bool is_given = fields.present("index", false);
    if (is_given) {
      one_or_more(fields, "index", index)
          .type("whole number or list of whole numbers")
          .range("≥ 0")
          .fallback("the first ones")
          .doc("Columns of an array with two axes, from 0; only in `.npz` files.");
      if (fields.documenting()) return {};
      fields.check(index.size() == kind.count, "index",
                   fmt::format("expected {} of the array's columns: {}", kind.count, kind.what));
      fields.check(std::all_of(index.begin(), index.end(), [](int i) { return i >= 0; }), "index",
                   "columns count from 0");
    } else if (is_of_one && kind.count > 1) {
      index.resize(kind.count);
      std::iota(index.begin(), index.end(), 0);
    }
    std::vector<SourceColumn> columns;
    for (std::size_t i = 0; i < kind.count; ++i) {
      SourceColumn& column = columns.emplace_back(SourceColumn{from[is_of_one ? 0 : i]});
      if (!index.empty()) column.index = static_cast<std::size_t>(index[i]);
    }
    return columns;
  }

  void check_is_there(const Fields& fields, const std::string& name) const {
    const auto count = std::count(names_.names.begin(), names_.names.end(), name);
    const char* what = names_.are_arrays ? "array" : "column";
    fields.check(count < 2, "from",
                 fmt::format("{} has {} columns '{}'", names_.file, count, name));
    if (count == 1) return;  // a hint compares the name with every column
    std::string hint = did_you_mean(name, names_.names);
    if (hint.empty()) hint = some_of(names_.names);
    fields.check(count == 1, "from",
                 fmt::format("{} has no {} '{}'{}", names_.file, what, name, hint));
  }

  /// Adds a column to the needed ones and returns its index.
  std::size_t take(const Fields& fields, const SourceColumn& column) {
    std::vector<SourceColumn>& columns = mapping_.columns;
    const bool is_new = std::find(columns.begin(), columns.end(), column) == columns.end();
    fields.check(is_new, "from",
                 fmt::format("'{}'{} is mapped already", column.name,
                             column.index ? fmt::format(" index {}", *column.index) : ""));
    columns.push_back(column);
    return columns.size() - 1;
  }

  const SourceNames& names_;
  LogMapping& mapping_;
};

/// Reads the rotation to Upkie's IMU axes: each is x, y or z of the log's IMU, or its reverse.
void describe_axes(Fields& fields, Eigen::Matrix3d& axes) {
  std::vector<std::string> names = {"x", "y", "z"};
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
  reader
      .optional(fields, "time",
                {"the time of each row", 1, {{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}},
                mapping.time)
      .doc("Clock of the log, instead of `period`.");
  fields.check(!has_period || !mapping.time, "period",
               "'time' already specifies when rows were logged");
  fields.check(has_period || mapping.time, "time", "is missing: expected 'time' or 'period'");
}

/// Puts a number that is 0 before those of each leg.
void add_missing_hips(MappedSignal& signal) {
  if (signal.numbers.empty()) return;  // documenting
  const MappedSignal::Number none{MappedSignal::no_column};
  signal.numbers.insert(signal.numbers.begin() + 2, none);
  signal.numbers.insert(signal.numbers.begin(), none);
}

void describe_joints(Fields& fields, MappingReader& reader, LogMapping& mapping) {
  expect_keys(fields, {"position", "velocity", "torque", "wheel_velocity_target", "hip"});
  std::size_t hip = 0;
  fields.choose("hip", {"joint", "none"}, hip)
      .doc(
          "`none`: the robot has knees and wheels only; four joints are mapped, and the hips are "
          "0.");
  const bool has_hips = hip == 0;
  const std::string joints = has_hips ? six_joints : four_joints;
  const std::size_t count = has_hips ? 6 : 4;
  const SignalKind angle{joints, count, {{"rad", 1.0}, {"deg", degree}, {"rev", turn}}, true};
  reader.require(fields, "position", angle, mapping.position).doc("Joint positions.");
  reader.require(fields, "velocity", {joints, count, speeds()}, mapping.velocity)
      .doc("Joint velocities.");
  reader.require(fields, "torque", {joints, count, {{"Nm", 1.0}, {"mNm", 1e-3}}}, mapping.torque)
      .doc("Joint torques.");
  if (!has_hips) {
    for (MappedSignal* signal : {&mapping.position, &mapping.velocity, &mapping.torque}) {
      add_missing_hips(*signal);
    }
  }
  reader
      .optional(fields, "wheel_velocity_target", {"left wheel, right wheel", 2, speeds()},
                mapping.wheel_velocity_target)
      .doc("Commanded velocities of the wheels; only `nmn` uses them.");
}

void describe_imu(Fields& fields, MappingReader& reader, LogMapping& mapping) {
  expect_keys(fields, {"orientation", "angular_velocity", "linear_acceleration",
                       "proper_acceleration", "axes", "rotation"});
  reader.describe_orientation(fields);
  reader
      .require(fields, "angular_velocity", {"x, y, z", 3, {{"rad/s", 1.0}, {"deg/s", degree}}},
               mapping.angular_velocity)
      .doc("Angular velocity of the IMU.");
  const SignalKind acceleration{"x, y, z", 3, accelerations()};
  reader.optional(fields, "linear_acceleration", acceleration, mapping.linear_acceleration)
      .doc("Acceleration without gravity; this or the next is needed.");
  reader.optional(fields, "proper_acceleration", acceleration, mapping.proper_acceleration)
      .doc("Acceleration as the chip measures it, gravity included.");
  const bool has_rotation = fields.present("rotation", false);
  fields.check(fields.documenting() || !has_rotation || !fields.present("axes", false), "rotation",
               "expected either 'rotation' or 'axes'");
  describe_axes(fields, mapping.axes);
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

void describe_mapping(Fields& fields, MappingReader& reader, LogMapping& mapping) {
  expect_keys(fields, {"robot", "period", "time", "joints", "imu", "contact"});
  fields("robot", mapping.robot)
      .fallback("none")
      .doc("Name of the robot; a model that was fitted to another robot is then refused.");
  describe_time(fields, reader, mapping);
  fields.require("joints");
  fields.within("joints", [&](Fields& inner) { describe_joints(inner, reader, mapping); })
      .doc("Signals of the six servos.");
  fields.require("imu");
  fields.within("imu", [&](Fields& inner) { describe_imu(inner, reader, mapping); })
      .doc("Signals of the IMU.");
  reader.describe_contact(fields);
}

}  // namespace

std::vector<Key> mapping_keys() {
  const SourceNames arrays{.file = "", .are_arrays = true, .names = {}};
  LogMapping mapping;
  MappingReader reader(arrays, mapping);
  KeyCollection keys;
  Fields fields(keys);
  describe_mapping(fields, reader, mapping);
  return keys.keys();
}

LogMapping read_log_mapping(const std::filesystem::path& path, const SourceNames& names) {
  require_file(path);
  const YamlDocument document = YamlDocument::load(path);
  LogMapping mapping;
  MappingReader reader(names, mapping);
  Fields fields(document);
  describe_mapping(fields, reader, mapping);
  return mapping;
}

}  // namespace touchdown::recordings
