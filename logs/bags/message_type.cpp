#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "logs/bags/topic_rows.hpp"

namespace touchdown::logs {

/// Reads the values of a message in the order of their definition, from bytes in CDR (XCDR1, OMG
/// DDS-XTypes 7.4.3), of either byte order. Values are aligned to their size, relative to the byte
/// after the four bytes of the header. Errors: `InputError` when the header is another one, or when
/// the bytes end before a value does; no declared size is trusted.
class CdrReader {
 public:
  explicit CdrReader(std::string_view payload) {
    if (payload.size() < header_bytes) throw InputError("a message ends before its CDR header");
    const auto kind = static_cast<unsigned char>(payload[1]);
    if (payload[0] != 0 || kind > 1) {
      throw InputError(
          fmt::format("expected a message in CDR, which begins with 00 00 or 00 01, "
                      "found {:02x} {:02x}",
                      static_cast<unsigned char>(payload[0]), kind));
    }
    const bool is_little = kind == 1;
    is_swapped_ = is_little != (std::endian::native == std::endian::little);
    bytes_ = payload.substr(header_bytes);
  }

  template <typename T>
  T take() {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), skip(sizeof(T), 1), sizeof(T));
    if (is_swapped_) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
  }
  /// Skips values of this size. Returns where they begin.
  const char* skip(std::size_t size, std::size_t count) {
    const std::size_t begin = (at_ + size - 1) / size * size;
    if (begin > bytes_.size() || (bytes_.size() - begin) / size < count) {
      throw InputError(
          fmt::format("a message of {} bytes ends within a value", bytes_.size() + header_bytes));
    }
    at_ = begin + size * count;
    return bytes_.data() + begin;
  }
  /// Without the NUL at its end.
  std::string_view text() {
    const std::uint32_t size = count(1);
    std::string_view text = bytes_.substr(at_, size);
    at_ += size;
    if (text.ends_with('\0')) text.remove_suffix(1);
    return text;
  }
  /// The number of items of a sequence, of which each has at least `bytes`.
  std::uint32_t count(std::size_t bytes) {
    const auto items = take<std::uint32_t>();
    if (items > (bytes_.size() - at_) / bytes) {
      throw InputError(fmt::format("a message of {} bytes declares a sequence of {} items",
                                   bytes_.size() + header_bytes, items));
    }
    return items;
  }

 private:
  static constexpr std::size_t header_bytes = 4;

  std::string_view bytes_;
  std::size_t at_ = 0;
  bool is_swapped_ = false;
};

namespace {

using Read = double (*)(CdrReader& reader);

template <typename T>
double read(CdrReader& reader) {
  return static_cast<double>(reader.take<T>());
}

struct Primitive {
  std::string_view name;
  std::size_t size;  ///< of texts, that of their length
  Read read;         ///< null for texts
};

constexpr std::array<Primitive, 14> primitives = {{{"bool", 1, read<std::uint8_t>},
                                                   {"byte", 1, read<std::uint8_t>},
                                                   {"char", 1, read<std::uint8_t>},
                                                   {"uint8", 1, read<std::uint8_t>},
                                                   {"int8", 1, read<std::int8_t>},
                                                   {"uint16", 2, read<std::uint16_t>},
                                                   {"int16", 2, read<std::int16_t>},
                                                   {"uint32", 4, read<std::uint32_t>},
                                                   {"int32", 4, read<std::int32_t>},
                                                   {"uint64", 8, read<std::uint64_t>},
                                                   {"int64", 8, read<std::int64_t>},
                                                   {"float32", 4, read<float>},
                                                   {"float64", 8, read<double>},
                                                   {"string", 4, nullptr}}};

constexpr const char* stamp_definition = "int32 sec\nuint32 nanosec\n";
constexpr const char* imu_definition = R"(int32 header.stamp.sec
uint32 header.stamp.nanosec
string header.frame_id
float64 orientation.x
float64 orientation.y
float64 orientation.z
float64 orientation.w
float64[9] orientation_covariance
float64 angular_velocity.x
float64 angular_velocity.y
float64 angular_velocity.z
float64[9] angular_velocity_covariance
float64 linear_acceleration.x
float64 linear_acceleration.y
float64 linear_acceleration.z
float64[9] linear_acceleration_covariance
)";
constexpr std::size_t longest_list = 1024;
constexpr std::size_t most_numbers = std::size_t{1} << 16U;
constexpr std::size_t deepest = 32;

std::string_view trimmed(std::string_view text) {
  constexpr const char* blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// The next word, which is removed from the text.
std::string_view take_word(std::string_view& text) {
  text = trimmed(text);
  const std::string_view word = text.substr(0, text.find_first_of(" \t"));
  text.remove_prefix(word.size());
  return word;
}

/// "package/msg/Type" and "package/Type" are the same; a bare name is of this package.
std::string whole_name(std::string_view type, std::string_view package) {
  if (type == "Header") return "std_msgs/Header";
  const std::size_t slash = type.find('/');
  if (slash == std::string_view::npos) return fmt::format("{}/{}", package, type);
  return fmt::format("{}/{}", type.substr(0, slash), type.substr(type.rfind('/') + 1));
}

}  // namespace

/// Reads definitions; each type once.
class TypeParser {
 public:
  TypeParser(MessageType& type, const std::string& name, std::string_view definition)
      : type_(type) {
    definitions_["builtin_interfaces/Time"] = definitions_["builtin_interfaces/Duration"] =
        stamp_definition;
    std::string current = whole_name(name, "");
    bool begins = true;
    while (!definition.empty()) {
      std::string_view line = definition.substr(0, definition.find('\n'));
      definition.remove_prefix(std::min(definition.size(), line.size() + 1));
      line = trimmed(line);
      constexpr std::string_view head = "MSG:";
      if (line.starts_with("=====")) {
        current.clear();
      } else if (current.empty() && line.starts_with(head)) {
        current = whole_name(trimmed(line.substr(head.size())), "");
        begins = true;
      } else if (!current.empty()) {
        std::string& text = definitions_[current];
        if (std::exchange(begins, false)) text.clear();
        text.append(line) += '\n';
      }
    }
    (void)structure(whole_name(name, ""));
  }

 private:
  using Field = MessageType::Field;

  /// The index of a type in `structs_`.
  std::size_t structure(const std::string& name) {
    if (const auto known = known_.find(name); known != known_.end()) return known->second;
    const auto found = definitions_.find(name);
    if (found == definitions_.end()) {
      throw InputError(fmt::format("the bag has no definition of {}", name));
    }
    if (depth_ == deepest) throw InputError(fmt::format("{} contains itself", name));
    ++depth_;
    MessageType::Struct fields;
    std::string_view rest = found->second;
    while (!rest.empty()) {
      std::string_view line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(line.size() + 1);
      line = trimmed(line.substr(0, line.find('#')));
      if (!line.empty()) add(line, name, fields);
    }
    if (fields.empty() && depth_ == 1) throw InputError(name + " has no fields");
    // ROS 2 adds a byte to a type without fields.
    if (fields.empty()) fields.push_back({"structure_needs_at_least_one_member", 3});
    --depth_;
    // The outermost type is the last one.
    type_.structs_.push_back(std::move(fields));
    return known_[name] = type_.structs_.size() - 1;
  }

  void add(std::string_view line, const std::string& of, MessageType::Struct& fields) {
    std::string_view rest = line;
    std::string_view type = take_word(rest);
    const std::string_view name = take_word(rest);
    // A constant has a value behind "=".
    if (name.find('=') != std::string_view::npos || trimmed(rest).starts_with('=')) return;
    const auto complain = [&] {
      throw InputError(
          fmt::format("expected `type name` in the definition of {}, found '{}'", of, line));
    };
    Field field;
    field.name = name;
    if (type.ends_with(']')) {
      const std::size_t open = type.rfind('[');
      if (open == std::string_view::npos) complain();
      const std::string_view length = type.substr(open + 1, type.size() - open - 2);
      type = type.substr(0, open);
      field.array = MessageType::Array::sequence;
      if (!length.empty() && !length.starts_with("<=")) {
        field.array = MessageType::Array::fixed;
        const auto [end, error] =
            std::from_chars(length.data(), length.data() + length.size(), field.length);
        if (error != std::errc() || end != length.data() + length.size()) complain();
        if (field.length == 0) return;  // has no byte in a message
      }
    }
    type = type.substr(0, type.find("<="));
    if (type.empty() || name.empty()) complain();
    const auto* const primitive = std::ranges::find(primitives, type, &Primitive::name);
    field.type = static_cast<std::size_t>(primitive - primitives.begin());
    if (primitive == primitives.end()) {
      field.type += structure(whole_name(type, of.substr(0, of.find('/'))));
    }
    fields.push_back(std::move(field));
  }

  MessageType& type_;
  std::map<std::string, std::string> definitions_;
  std::map<std::string, std::size_t> known_;
  std::size_t depth_ = 0;
};

/// Reads one message.
class NumberReader {
 public:
  NumberReader(const MessageType& type, std::string_view payload, MessageNumbers& numbers)
      : type_(type), reader_(payload), numbers_(numbers) {}

  /// Reads the fields of a type. Paths are built only if `path` is there.
  void read(const MessageType::Struct& fields, std::string* path) {
    for (const MessageType::Field& field : fields) {
      const std::size_t begin = path == nullptr ? 0 : path->size();
      if (path != nullptr) path->append(path->empty() ? "" : ".").append(field.name);
      read(field, path);
      if (path != nullptr) path->resize(begin);
    }
  }

 private:
  void read(const MessageType::Field& field, std::string* path) {
    if (field.array == MessageType::Array::none) return read_one(field.type, path);
    std::size_t length = field.length;
    const bool is_primitive = field.type < primitives.size();
    if (field.array == MessageType::Array::sequence) {
      length = reader_.count(is_primitive ? primitives.at(field.type).size : 1);
    }
    if (is_primitive && primitives.at(field.type).read != nullptr && length > longest_list) {
      reader_.skip(primitives.at(field.type).size, length);
      return;
    }
    if (field.array == MessageType::Array::sequence) {
      numbers_.lengths.push_back(static_cast<std::uint32_t>(length));
    }
    const std::size_t begin = path == nullptr ? 0 : path->size();
    for (std::size_t i = 0; i < length; ++i) {
      if (path != nullptr) fmt::format_to(std::back_inserter(*path), "[{}]", i);
      read_one(field.type, path);
      if (path != nullptr) path->resize(begin);
    }
  }

  void read_one(std::size_t type, std::string* path) {
    if (type >= primitives.size()) {
      return read(type_.structs_.at(type - primitives.size()), path);
    }
    if (primitives.at(type).read == nullptr) {
      numbers_.texts.push_back(reader_.text());
      return;
    }
    const double value = primitives.at(type).read(reader_);
    if (numbers_.values.size() == most_numbers) return;
    numbers_.values.push_back(value);
    if (path != nullptr) numbers_.paths.push_back(*path);
  }

  const MessageType& type_;
  CdrReader reader_;
  MessageNumbers& numbers_;
};

namespace {

/// Errors: `InputError` for lists of joints of different lengths.
void check_joints(const MessageNumbers& numbers) {
  const std::vector<std::uint32_t>& lengths = numbers.lengths;
  for (std::size_t i = 1; i < lengths.size(); ++i) {
    if (lengths[0] == 0 || lengths[i] == 0 || lengths[i] == lengths[0]) continue;
    throw InputError(fmt::format("{} has {} values for {} names", joint_fields.at(i - 1),
                                 lengths[i], lengths[0]));
  }
}

/// Makes the signals of an Imu that are not given NaN.
void mark_missing(std::vector<double>& values) {
  constexpr std::size_t orientation = 2;
  for (const auto& [begin, size] :
       std::array<std::array<std::size_t, 2>, 3>{{{orientation, 4}, {15, 3}, {27, 3}}}) {
    const std::span signal = std::span(values).subspan(begin, size);
    const bool is_zero = std::ranges::all_of(signal, [](double x) { return x == 0.0; });
    if (values.at(begin + size) == -1.0 || (begin == orientation && is_zero)) {
      std::ranges::fill(signal, std::numeric_limits<double>::quiet_NaN());
    }
  }
}

}  // namespace

std::int64_t MessageNumbers::stamp() const {
  const auto is_named = [&](std::size_t i, const char* end) {
    return i < paths.size() && paths[i].ends_with(end);
  };
  if (!is_named(0, "stamp.sec") || !is_named(1, "stamp.nanosec")) return 0;
  return std::int64_t{1'000'000'000} * static_cast<std::int32_t>(values[0]) +
         static_cast<std::uint32_t>(values[1]);
}

MessageType::MessageType(const std::string& name, std::string_view definition) : name_(name) {
  if (name == joint_state_type) definition = joint_state_definition;
  if (name == imu_type) definition = imu_definition;
  (void)TypeParser(*this, name, definition);
}

bool MessageType::decode(std::string_view payload, MessageNumbers& numbers) const {
  MessageNumbers read;
  NumberReader(*this, payload, read).read(structs_.back(), nullptr);
  const bool are_joints = name_ == joint_state_type;
  if ((are_joints || name_ == imu_type) && read.values.at(1) >= 1e9) {
    throw InputError(fmt::format("a stamp has {} nanoseconds", read.values[1]));
  }
  if (are_joints) check_joints(read);
  if (name_ == imu_type) mark_missing(read.values);
  const bool is_other =
      read.lengths != numbers.lengths || read.values.size() != numbers.paths.size();
  if (is_other) {
    MessageNumbers named;
    std::string path;
    NumberReader(*this, payload, named).read(structs_.back(), &path);
    numbers.paths = std::move(named.paths);
  }
  read.paths = std::move(numbers.paths);
  numbers = std::move(read);
  return is_other;
}

}  // namespace touchdown::logs
