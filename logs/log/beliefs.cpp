#include "logs/log/beliefs.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/resources.hpp"
#include "core/yaml.hpp"
#include "estimator/npz/npz.hpp"
#include "logs/log/numbers_csv.hpp"
#include "logs/log/packing.hpp"

namespace touchdown::logs {

namespace {

constexpr std::size_t time_name = 0;
constexpr std::size_t first_p = 1;
constexpr std::size_t first_contact = 3;
constexpr std::size_t needed = 3;

const std::vector<std::string>& known_names() {
  static const std::vector<std::string> names = {"time", "p_left", "p_right", "contact_left",
                                                 "contact_right"};
  return names;
}

constexpr const char* expected_names =
    "expected time, p_left, p_right and, for decisions, contact_left and contact_right";

/// The error of a value under one of the known names; empty if the value is valid.
std::string complaint(std::size_t name, double value, double last_time) {
  if (name == time_name) {
    if (!std::isfinite(value)) return fmt::format("{}: expected a time in seconds", value);
    if (value > last_time) return {};
    return fmt::format("{}: expected a time after the one before, {}", value, last_time);
  }
  if (name < first_contact) {
    if (value >= 0.0 && value <= 1.0) return {};
    return fmt::format("{}: expected a probability from 0 to 1", value);
  }
  if (value == 0.0 || value == 1.0) return {};
  return fmt::format("{}: expected 1 for contact or 0 for none", value);
}

/// Throws an error in the names, or in the values of one step, at a column.
using Complain = std::function<void(std::size_t column, const std::string& what)>;

/// Collects beliefs from the columns of a file of any format: `time`, `p_left`, `p_right`, and both
/// or none of `contact_left` and `contact_right`, in any order.
class BeliefColumns {
 public:
  BeliefColumns(const std::filesystem::path& path, Complain complain)
      : complain_(std::move(complain)) {
    beliefs.file = path.string();
  }

  /// Sets the names of the columns in order.
  void set_names(std::span<const std::string> names) {
    const std::vector<std::string>& known = known_names();
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (std::find(known.begin(), known.end(), names[i]) == known.end()) {
        complain_(i, fmt::format("unknown name '{}'{}: {}", names[i], did_you_mean(names[i], known),
                                 expected_names));
      }
      const std::span<const std::string> before = names.first(i);
      if (std::find(before.begin(), before.end(), names[i]) != before.end()) {
        complain_(i, fmt::format("'{}' appears twice", names[i]));
      }
    }
    names_.assign(names.begin(), names.end());
    const auto place_of = [&](std::size_t name) {
      return static_cast<std::size_t>(std::ranges::find(names, known[name]) - names.begin());
    };
    const bool decides =
        place_of(first_contact) < names.size() || place_of(first_contact + 1) < names.size();
    column_.clear();
    for (std::size_t name = 0; name < (decides ? known.size() : needed); ++name) {
      column_.push_back(place_of(name));
      if (column_.back() == names.size()) {
        complain_(names.size(), fmt::format("'{}' is missing: {}", known[name], expected_names));
      }
    }
  }

  /// Adds one step, with values in the order of the names.
  void add(std::span<const double> values) {
    const double last = beliefs.time.empty() ? -HUGE_VAL : beliefs.time.back();
    for (std::size_t name = 0; name < column_.size(); ++name) {
      const std::size_t column = column_[name];
      const std::string what = complaint(name, values[column], last);
      if (!what.empty()) complain_(column, fmt::format("{}: {}", names_[column], what));
    }
    beliefs.time.push_back(values[column_[time_name]]);
    const bool decides = column_.size() > needed;
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      const double p = values[column_[first_p + wheel]];
      const bool contact = decides ? values[column_[first_contact + wheel]] != 0.0 : p >= 0.5;
      beliefs.p_contact[wheel].push_back(p);
      beliefs.contact[wheel].push_back(std::uint8_t{contact});
    }
  }

  /// Errors: `InputError` at a `place` of the file if there are none.
  Beliefs finish(const char* place = "") {
    if (beliefs.size() > 0) return std::move(beliefs);
    throw InputError(fmt::format("{}{}: holds no beliefs", beliefs.file, place));
  }

  /// The beliefs so far.
  Beliefs beliefs;

 private:
  Complain complain_;
  std::vector<std::string> names_;
  std::vector<std::size_t> column_;  ///< of each known name
};

}  // namespace

std::string Beliefs::place(std::size_t index) const {
  if (index < line.size()) return fmt::format("{}:{}", file, line[index]);
  return fmt::format("{}: belief {}", file, index);
}

Beliefs read_belief_csv(const std::filesystem::path& path) {
  NumbersCsv csv(path);
  BeliefColumns columns(
      path, [&](std::size_t column, const std::string& what) { csv.complain(column, what); });
  columns.set_names(csv.names());
  while (csv.next()) {
    columns.add(csv.values());
    columns.beliefs.line.push_back(csv.line());
  }
  return columns.finish(":1:1");
}

Beliefs read_belief_npz(const std::filesystem::path& path) {
  const std::vector<std::string> names = npz_names(path);
  std::optional<std::size_t> step;  // without one, the names are wrong
  BeliefColumns columns(path, [&](std::size_t /*column*/, const std::string& what) {
    throw InputError(
        fmt::format("{}: {}{}", path.string(), step ? fmt::format("index {}: ", *step) : "", what));
  });
  columns.set_names(names);
  const ModelArrays arrays = read_npz(path);
  const std::size_t steps = arrays.at("time").data.size();
  for (const auto& [name, array] : arrays) {
    if (array.shape.size() == 1 && array.data.size() == steps) continue;
    throw InputError(fmt::format("{}: {}: expected one axis of {}, the steps of 'time'",
                                 path.string(), name, steps));
  }
  std::vector<double> values(names.size());
  for (step = 0; *step < steps; ++*step) {
    for (std::size_t i = 0; i < names.size(); ++i) values[i] = arrays.at(names[i]).data[*step];
    columns.add(values);
  }
  return columns.finish();
}

namespace {

/// Far more than beliefs need. A header that announces more is rejected.
const msgpack::unpack_limit limits(64, 64, 1024, 1024, 1024, 4);

std::optional<double> number_of(const msgpack::object& value) {
  if (value.type == msgpack::type::BOOLEAN) return value.via.boolean ? 1.0 : 0.0;
  try {
    return value.as<double>();
  } catch (const msgpack::type_error&) {
    return std::nullopt;
  }
}

/// Reads one dictionary after the other. All must have the names of the first.
class DictionaryReader {
 public:
  explicit DictionaryReader(const std::filesystem::path& path)
      : columns_(path,
                 [this](std::size_t /*column*/, const std::string& what) { complain(what); }) {}

  [[noreturn]] void complain(const std::string& what) const {
    throw InputError(
        fmt::format("{}: dictionary {}: {}", columns_.beliefs.file, columns_.beliefs.size(), what));
  }

  void take(const msgpack::object& object) {
    if (object.type != msgpack::type::MAP) complain("expected a dictionary");
    const std::span entries(object.via.map.ptr, object.via.map.size);
    std::vector<std::string> names;
    for (const msgpack::object_kv& entry : entries) {
      if (entry.key.type != msgpack::type::STR) complain("expected names for keys");
      names.emplace_back(entry.key.via.str.ptr, entry.key.via.str.size);
    }
    if (names_.empty() || names != names_) {
      if (!names_.empty() && sorted(names) != sorted(names_)) {
        complain(fmt::format("expected the names of the first: {}", fmt::join(names_, ", ")));
      }
      columns_.set_names(names);
      names_ = names;
    }
    std::vector<double> values;
    for (const msgpack::object_kv& entry : entries) {
      const std::optional<double> number = number_of(entry.val);
      if (!number) complain(names[values.size()] + ": expected a number");
      values.push_back(*number);
    }
    columns_.add(values);
  }

  Beliefs finish() { return columns_.finish(); }

 private:
  static std::vector<std::string> sorted(std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    return names;
  }

  BeliefColumns columns_;
  std::vector<std::string> names_;
};

}  // namespace

Beliefs read_belief_mpack(const std::filesystem::path& path) {
  require_file(path);
  const std::string bytes = read_file(path);
  DictionaryReader reader(path);
  std::size_t offset = 0;
  while (offset < bytes.size()) {
    msgpack::object_handle handle;
    try {
      handle = msgpack::unpack(bytes.data(), bytes.size(), offset, nullptr, nullptr, limits);
    } catch (const msgpack::insufficient_bytes&) {
      reader.complain("is cut off");
    } catch (const msgpack::unpack_error&) {
      reader.complain(fmt::format("is not a MessagePack dictionary of beliefs (byte {})", offset));
    }
    reader.take(handle.get());
  }
  return reader.finish();
}

Beliefs read_beliefs(const std::filesystem::path& path) {
  const std::filesystem::path extension = path.extension();
  if (extension == ".csv") return read_belief_csv(path);
  if (extension == ".npz") return read_belief_npz(path);
  if (extension == ".mpack") return read_belief_mpack(path);
  throw InputError(fmt::format("{}: expected the extension .csv, .npz or .mpack", path.string()));
}

}  // namespace touchdown::logs
