#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "core/fields.hpp"
#include "logs/mapping/mapping.hpp"

namespace touchdown::logs {

/// A unit that a log may have, and its size in the unit of touchdown.
struct Unit {
  std::string name;
  double size;
};

// The units of a kind of signal. The first is that of touchdown.
std::vector<Unit> angles();
std::vector<Unit> speeds();
std::vector<Unit> turn_rates();  ///< of an IMU
std::vector<Unit> torques();
std::vector<Unit> accelerations();

/// The options that a mapping file has for a signal.
struct SignalKind {
  std::string what;  ///< its numbers in order, for messages
  std::size_t count = 1;
  std::vector<Unit> units = {};  ///< the first is the unit of touchdown
  bool has_zero = false;
  std::vector<std::string> names = {};  ///< columns without `from`; empty: `from` is required
  std::vector<double> signs = {};       ///< without `sign`
};

/// Reads one number per component of a signal; `values` stay empty if the key is absent.
KeyNotes number_for_each(Fields& fields, const std::string& key, std::size_t count,
                         std::vector<double>& values);

/// Reads the signs of a signal's numbers: 1 or -1.
KeyNotes sign_for_each(Fields& fields, std::size_t count, std::vector<double>& signs);

/// Reads signals of a mapping file and collects the columns that they need.
class MappingReader {
 public:
  MappingReader(std::span<const SourceNames> sources, LogMapping& mapping)
      : sources_(sources), mapping_(mapping) {}

  /// The columns that follow are those of this section's sources, or if it has none, the joints'.
  void enter(std::string_view section);
  /// The columns that follow are those of one source.
  void enter_source(std::size_t source) { only_ = source; }
  void leave_source() { only_.reset(); }

  std::span<const SourceNames> sources() const { return sources_; }
  /// The first source that is entered.
  const SourceNames& names() const;

  /// Reads the signal at a key. Without the key, takes the columns that its kind names.
  KeyNotes require(Fields& fields, std::string_view key, const SignalKind& kind,
                   MappedSignal& signal);

  /// Reads the signal at a key, if the file has the key.
  KeyNotes optional(Fields& fields, std::string_view key, const SignalKind& kind,
                    std::optional<MappedSignal>& signal);

  /// Reads the keys of a signal: its columns, signs, scales, zeros and unit.
  void describe_signal(Fields& fields, const SignalKind& kind, MappedSignal& signal);

  /// Takes the columns that a signal has without its key.
  void take_default(const Fields& fields, std::string_view key, const SignalKind& kind,
                    MappedSignal& signal);

 private:
  std::vector<SourceColumn> columns_of(Fields& fields, const SignalKind& kind) const;
  bool is_entered(std::size_t source) const;
  /// Whether a source that is entered has this column.
  bool is_there(const std::string& name) const;

  /// The source with this column; reports an error at `key` if not exactly one column has the name.
  std::size_t source_of(const Fields& fields, std::string_view key, const std::string& name) const;

  /// Adds a column to the needed ones and returns its index.
  std::size_t take(const Fields& fields, std::string_view key, const SourceColumn& column);

  std::span<const SourceNames> sources_;
  std::string_view section_;
  std::optional<std::size_t> only_;  ///< the source that is entered, if it is a single one
  LogMapping& mapping_;
};

/// Reads the section `joints`: signals of hips, knees and wheels, and the commands of the servos.
void describe_joints(Fields& fields, MappingReader& reader, LogMapping& mapping);

/// Reads how an IMU is mounted: the rotation from its axes to the robot's (x forward, y left, z
/// up), as a quaternion w x y z or as roll, pitch and yaw, as in a URDF (a rotation about x, then
/// y, then z). Sets the rotation from the IMU's axes to those of Upkie's IMU (back, left, down).
void describe_mounting(Fields& fields, Eigen::Matrix3d& axes);

}  // namespace touchdown::logs
