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
  std::vector<std::string> names = {};  ///< columns without `from`; empty: `from` is required
  std::vector<double> signs = {};       ///< without `sign`
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
  MappingReader(std::span<const SourceNames> sources, LogMapping& mapping)
      : sources_(sources), mapping_(mapping) {}

  /// The columns that follow are those of this section's sources, or if it has none, the joints'.
  void enter(std::string_view section) {
    const bool has_own = std::any_of(sources_.begin(), sources_.end(),
                                     [&](const auto& source) { return source.section == section; });
    section_ = has_own || section.empty() ? section : "joints";
    first_ = 0;
    while (!is_entered(first_)) ++first_;
  }
  /// The columns that follow are those of one source.
  void enter_source(std::size_t source) { first_ = source, only_ = source; }
  void leave_source() {
    only_.reset();
    enter(section_);
  }

  std::span<const SourceNames> sources() const { return sources_; }
  const SourceNames& names() const { return sources_[first_]; }

  KeyNotes require(Fields& fields, std::string_view key, const SignalKind& kind,
                   MappedSignal& signal) {
    if (!kind.names.empty() && !fields.present(key, false)) {
      take_default(fields, key, kind, signal);
      return {};
    }
    if (kind.names.empty()) fields.require(key);
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
    SignalKind kind{"the quaternion's components in the order of 'order'", 4};
    // sensor_msgs/Imu and REP 103
    std::size_t order = names().is_topic ? 1 : 0;
    std::size_t reference = order;
    if (names().is_topic) {
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
      describe_signal(inner, kind, mapping_.orientation);
    };
    if (fields.present("orientation", false)) {
      fields.within("orientation", describe_quaternion)
          .doc("Quaternion from the IMU's frame to its reference.");
    } else {
      take_default(fields, "orientation", kind, mapping_.orientation);
    }
    mapping_.is_w_last = order == 1;
    mapping_.reference_is_z_up = reference == 1;
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

  /// Takes the columns that a signal has without its key.
  void take_default(const Fields& fields, std::string_view key, const SignalKind& kind,
                    MappedSignal& signal) {
    for (std::size_t i = 0; i < kind.names.size(); ++i) {
      const SourceColumn column{kind.names[i], {}, source_of(fields, key, kind.names[i])};
      signal.numbers.push_back(
          {take(fields, key, column), kind.signs.empty() ? 1.0 : kind.signs[i], 0.0});
    }
  }

  void describe_signal(Fields& fields, const SignalKind& kind, MappedSignal& signal) {
    if (names().are_arrays) fields.know("index");
    if (kind.has_zero) fields.know("zero");
    if (!kind.units.empty()) fields.know("unit");
    expect_keys(fields, {"from", "sign", "scale"});
    const bool has_from = kind.names.empty() || fields.present("from", false);
    if (kind.names.empty()) fields.require("from");
    std::vector<SourceColumn> columns;
    if (has_from) {
      columns = columns_of(fields, kind);
    } else {
      for (const std::string& name : kind.names) {
        columns.push_back({name, {}, source_of(fields, "", name)});
      }
    }
    std::vector<double> sign;
    number_for_each(fields, "sign", kind.count, sign)
        .range("1 or -1")
        .fallback("1")
        .doc("Sign of all numbers, or of each.");
    for (const double one : sign) fields.check(std::abs(one) == 1.0, "sign", "expected 1 or -1");
    if (sign.empty()) sign = kind.signs;
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
      signal.numbers.push_back({take(fields, "from", columns[i]), sign.empty() ? 1.0 : sign[i],
                                zero.empty() ? 0.0 : zero[i]});
      if (!scale.empty()) signal.numbers.back().scale = scale[i];
    }
  }

 private:
  std::vector<SourceColumn> columns_of(Fields& fields, const SignalKind& kind) const {
    std::vector<std::string> from;
    one_or_more(fields, "from", from)
        .type(kind.count == 1 ? "text" : "text or list of texts")
        .doc(fmt::format("Columns or arrays: {}.", kind.what));
    std::vector<std::size_t> source;
    for (const std::string& name : from) source.push_back(source_of(fields, "from", name));
    if (names().are_arrays) {
      std::vector<SourceColumn> columns = columns_of_arrays(fields, kind, from);
      for (std::size_t i = 0; i < columns.size(); ++i) {
        columns[i].source = source[source.size() == 1 ? 0 : i];
      }
      return columns;
    }
    fields.check(from.size() == kind.count, "from",
                 fmt::format("expected {} of the names of columns: {}", kind.count, kind.what));
    std::vector<SourceColumn> columns;
    for (std::size_t i = 0; i < from.size(); ++i) columns.push_back({from[i], {}, source[i]});
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

  /// Whether the name is that of an array with a column for each wheel.
  bool is_wide(const YAML::Node& name) const {
    return names().width && name.IsScalar() && names().width(name.Scalar()) == models::wheel_count;
  }

  bool is_entered(std::size_t source) const {
    if (only_) return source == *only_;
    return section_.empty() || sources_[source].section.empty() ||
           sources_[source].section == section_;
  }

  /// The source with this column; reports an error at `key` if not exactly one column has the name.
  std::size_t source_of(const Fields& fields, std::string_view key, const std::string& name) const {
    const char* what = names().are_arrays ? "array" : "column";
    std::optional<std::size_t> found;
    std::vector<std::string> known;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      if (!is_entered(i)) continue;
      const SourceNames& source = sources_[i];
      const auto count = std::count(source.names.begin(), source.names.end(), name);
      fields.check(count < 2, key, fmt::format("{} has {} columns '{}'", source.file, count, name));
      fields.check(count == 0 || !found, key,
                   fmt::format("{} and {} have a column '{}'", sources_[found.value_or(0)].file,
                               source.file, name));
      if (count == 1) found = i;
      known.insert(known.end(), source.names.begin(), source.names.end());
    }
    if (found) return *found;  // a hint compares the name with every column
    std::string hint = did_you_mean(name, known);
    if (hint.empty()) hint = some_of(known);
    fields.check(false, key, fmt::format("{} has no {} '{}'{}", names().file, what, name, hint));
    return 0;
  }

  /// Adds a column to the needed ones and returns its index.
  std::size_t take(const Fields& fields, std::string_view key, const SourceColumn& column) {
    std::vector<SourceColumn>& columns = mapping_.columns;
    const bool is_new = std::find(columns.begin(), columns.end(), column) == columns.end();
    fields.check(is_new, key,
                 fmt::format("'{}'{} is mapped already", column.name,
                             column.index ? fmt::format(" index {}", *column.index) : ""));
    columns.push_back(column);
    return columns.size() - 1;
  }

  std::span<const SourceNames> sources_;
  std::string_view section_;
  std::size_t first_ = 0;            ///< the first source that is entered
  std::optional<std::size_t> only_;  ///< the source that is entered, if it is a single one
  LogMapping& mapping_;
};

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

/// One column, or whole seconds and nanoseconds as in the headers of ROS 2.
void describe_clock(Fields& fields, MappingReader& reader, SourceClock& clock) {
  const SignalKind time{
      "the time of each row", 1, {{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}};
  const bool has_parts = fields.present("sec", false) || fields.present("nanosec", false);
  if (!has_parts) {
    fields.know("sec");
    fields.know("nanosec");
  }
  if (!has_parts || fields.documenting()) reader.describe_signal(fields, time, clock.time);
  if (!has_parts) return;
  std::string sec;
  std::string nanosec;
  fields.require("sec", sec).fallback("none").doc("Column of whole seconds, instead of `from`.");
  fields.require("nanosec", nanosec).fallback("none").doc("Column of nanoseconds beside `sec`.");
  fields.finish();
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

/// The IMU's own clock, if its columns have other names than those of the joints.
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

/// Puts a number that is 0 before those of each leg.
void add_missing_hips(MappedSignal& signal) {
  if (signal.numbers.empty()) return;  // documenting
  const MappedSignal::Number none{MappedSignal::no_column};
  signal.numbers.insert(signal.numbers.begin() + 2, none);
  signal.numbers.insert(signal.numbers.begin(), none);
}

/// The names of the joints, of which a topic's columns follow, and their signs.
SignalKind describe_joint_names(Fields& fields, MappingReader& reader, bool has_hips) {
  SignalKind kind{has_hips ? six_joints : four_joints, has_hips ? 6U : 4U};
  if (fields.present("names", false)) {
    fields("names", kind.names)
        .fallback("none")
        .doc(
            "Names of the left hip, knee, wheel, right hip, knee, wheel. Joints are then found by "
            "name in each message of a topic and in each row of a CSV file with the columns "
            "name[0], position[0], …; other files need columns NAME/position, NAME/velocity and "
            "NAME/effort.");
    fields.check(kind.names.size() == kind.count, "names",
                 fmt::format("expected {}: {}", kind.count, kind.what));
    const std::vector<std::string>& columns = reader.names().names;
    const bool has_names =
        reader.names().has_joint_names ||
        std::any_of(columns.begin(), columns.end(),
                    [](const std::string& column) { return column.ends_with("/position"); });
    fields.check(has_names || fields.documenting() || fields.present("position", false), "names",
                 fmt::format("{} has neither columns NAME/position nor the joints' names in its "
                             "rows (name[0], …): map its columns by hand, position: {{from: [{} "
                             "columns]}}, and velocity and torque alike",
                             reader.names().file, kind.count));
  }
  std::string known;
  for (const std::string& name : reader.names().names) {
    if (name.ends_with("/position")) known += ", " + name.substr(0, name.rfind('/'));
  }
  const bool is_needed = reader.names().has_joint_names && !fields.present("position", false);
  fields.check(
      !is_needed || !kind.names.empty(), "",
      fmt::format("'names' is missing: expected the joints' names, {}; {} has {}", kind.what,
                  reader.names().file, known.substr(std::min<std::size_t>(2, known.size()))));
  number_for_each(fields, "sign", kind.count, kind.signs)
      .range("1 or -1")
      .fallback("1")
      .doc("Sign of all joints, or of each, where a signal has none of its own.");
  for (const double one : kind.signs)
    fields.check(std::abs(one) == 1.0, "sign", "expected 1 or -1");
  if (fields.documenting()) kind.names.clear();
  return kind;
}

/// Inserts the hips that the robot lacks before the numbers of its two knees.
void add_missing_leg_hips(MappedSignal& signal) {
  if (signal.numbers.empty()) return;  // documenting
  for (const std::ptrdiff_t hip : {0, 2}) {
    signal.numbers.insert(signal.numbers.begin() + hip, {MappedSignal::no_column});
  }
}

/// Reads gains of hips and knees. A joint without a hip has none.
void describe_gains(Fields& fields, const std::string& key, bool has_hips, const char* unit,
                    const char* doc, std::array<double, 4>& gains) {
  std::vector<double> given;
  number_for_each(fields, key, has_hips ? 4 : 2, given).range("≥ 0").doc(unit, doc);
  if (given.empty()) return;
  for (const double gain : given) {
    fields.check(std::isfinite(gain) && gain >= 0.0, key, "expected gains that are not negative");
  }
  gains = has_hips ? std::array{given[0], given[1], given[2], given[3]}
                   : std::array{given[0], given[0], given[1], given[1]};
}

void describe_leg_targets(Fields& fields, MappingReader& reader, bool has_hips,
                          LogMapping& mapping) {
  if (!fields.present("leg_targets", false)) return;
  MappedLegTargets& targets = mapping.leg_targets.emplace();
  const SignalKind joints{has_hips ? "left hip, knee, right hip, knee" : "left knee, right knee",
                          has_hips ? 4U : 2U};
  const auto kind = [&](const std::vector<Unit>& units, bool has_zero = false) {
    SignalKind one = joints;
    one.units = units;
    one.has_zero = has_zero;
    return one;
  };
  const auto describe_targets = [&](Fields& inner) {
    expect_keys(inner, {"position", "velocity", "torque", "kp", "kd"});
    reader
        .require(inner, "position", kind({{"rad", 1.0}, {"deg", degree}, {"rev", turn}}, true),
                 targets.position)
        .doc("Commanded positions, with the signs and zeros of the joints.");
    reader.optional(inner, "velocity", kind(speeds()), targets.velocity)
        .doc("Commanded velocities; 0 without this key.");
    reader.optional(inner, "torque", kind({{"Nm", 1.0}, {"mNm", 1e-3}}), targets.torque)
        .doc("Feed-forward torques; 0 without this key.");
    inner.require("kp");
    describe_gains(inner, "kp", has_hips, "N·m/rad", "Position gains of the servos.", targets.kp);
    describe_gains(inner, "kd", has_hips, "N·m·s/rad", "Velocity gains of the servos.", targets.kd);
    if (has_hips) return;
    add_missing_leg_hips(targets.position);
    if (targets.velocity) add_missing_leg_hips(*targets.velocity);
    if (targets.torque) add_missing_leg_hips(*targets.torque);
  };
  fields.within("leg_targets", describe_targets)
      .fallback("none")
      .doc("Commands of the servos of hips and knees, for the load by the servos' laws.");
}

void describe_joints(Fields& fields, MappingReader& reader, LogMapping& mapping) {
  expect_keys(fields, {"names", "sign", "position", "velocity", "torque", "wheel_velocity_target",
                       "leg_targets", "hip"});
  std::size_t hip = 0;
  fields.choose("hip", {"joint", "none"}, hip)
      .doc(
          "`none`: the robot has knees and wheels only; four joints are mapped, and the hips are "
          "0.");
  const bool has_hips = hip == 0;
  const SignalKind joints = describe_joint_names(fields, reader, has_hips);
  const auto kind = [&](const char* field, const std::vector<Unit>& units, bool has_zero = false) {
    SignalKind one = joints;
    one.units = units;
    one.has_zero = has_zero;
    for (std::string& name : one.names) name += field;
    return one;
  };
  reader
      .require(fields, "position",
               kind("/position", {{"rad", 1.0}, {"deg", degree}, {"rev", turn}}, true),
               mapping.position)
      .doc("Joint positions.");
  reader.require(fields, "velocity", kind("/velocity", speeds()), mapping.velocity)
      .doc("Joint velocities.");
  reader.require(fields, "torque", kind("/effort", {{"Nm", 1.0}, {"mNm", 1e-3}}), mapping.torque)
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
  describe_leg_targets(fields, reader, has_hips, mapping);
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
  reader.describe_orientation(fields);
  reader
      .require(fields, "angular_velocity",
               kind("angular_velocity", {{"rad/s", 1.0}, {"deg/s", degree}}),
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
  reader.describe_contact(fields);
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
