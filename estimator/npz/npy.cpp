#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>

#include "core/error.hpp"
#include "estimator/npz/npz.hpp"

namespace touchdown {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");

/// The first bytes of a `.npy` file.
constexpr std::string_view npy_magic = "\x93NUMPY";

/// Far above any grid. A larger size means a broken header; the product of two cannot overflow.
constexpr std::size_t largest_axis = std::size_t{1} << 28U;

struct Header {
  std::string type;
  bool is_fortran_order = false;
  std::vector<std::size_t> shape;
};

/// The header is a Python dictionary on one line: what follows `'key':` in it.
std::string_view value_of(std::string_view text, std::string_view key) {
  const std::size_t found = text.find(std::string(1, '\'').append(key).append("':"));
  if (found == std::string_view::npos) return {};
  const std::string_view rest = text.substr(found + key.size() + 3);
  return rest.substr(std::min(rest.size(), rest.find_first_not_of(' ')));
}

/// The text between the marks, if it begins with the first one.
std::string_view between(std::string_view text, std::string_view open, std::string_view close) {
  const std::size_t end = text.find(close, open.size());
  if (!text.starts_with(open) || end == std::string_view::npos) return {};
  return text.substr(open.size(), end - open.size());
}

/// Parses "2, 3" or "2,"; empty for anything else.
std::vector<std::size_t> parse_shape(std::string_view text) {
  std::vector<std::size_t> shape;
  while (!text.empty()) {
    std::size_t axis = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), axis);
    if (error != std::errc{}) return {};
    shape.push_back(axis);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    const std::size_t next = text.find_first_not_of(", ");
    text.remove_prefix(std::min(text.size(), next));
  }
  return shape;
}

/// Reads bytes in order. Errors: `InputError` if none are left.
class Bytes {
 public:
  Bytes(const NpyBytes& source, std::size_t size, const std::string& name)
      : source_(source), left_(size), name_(name) {}

  std::size_t left() const { return left_; }

  void fill(std::span<char> bytes) {
    while (!bytes.empty()) {
      const std::size_t size = source_(bytes);
      if (size == 0) throw InputError(name_ + ": is cut off");
      left_ -= std::min(left_, size);
      bytes = bytes.subspan(size);
    }
  }

 private:
  const NpyBytes& source_;
  std::size_t left_;
  const std::string& name_;
};

Header read_header(Bytes& bytes, const std::string& name) {
  // Shorter than any header, and long enough to contain its length.
  constexpr std::size_t known = 12;
  std::string head(known, '\0');
  if (bytes.left() >= known) bytes.fill(head);
  if (!head.starts_with(npy_magic)) throw InputError(name + ": is not a NumPy array");
  const auto byte = [&](std::size_t i) {
    return static_cast<std::size_t>(static_cast<unsigned char>(head[i]));
  };
  const bool is_wide = byte(6) >= 2;
  const std::size_t start = is_wide ? 12 : 10;
  std::size_t length = byte(8) | byte(9) << 8U;
  if (is_wide) length |= byte(10) << 16U | byte(11) << 24U;
  if (start + length < known || bytes.left() < start + length - known || length > 65536) {
    throw InputError(name + ": is cut off within its header");
  }
  head.resize(start + length);
  bytes.fill(std::span(head).subspan(known));
  const std::string_view text = std::string_view(head).substr(start);
  Header header{std::string(between(value_of(text, "descr"), "'", "'")),
                value_of(text, "fortran_order").starts_with("True"),
                parse_shape(between(value_of(text, "shape"), "(", ")"))};
  if (header.type.empty() || header.shape.empty() || header.shape.size() > 2) {
    throw InputError(name +
                     ": expected an array of numbers with one or two axes, found the header " +
                     std::string(text.substr(0, text.find_last_not_of(" \n") + 1)));
  }
  for (const std::size_t axis : header.shape) {
    if (axis > largest_axis) {
      throw InputError(name + ": has an axis of " + std::to_string(axis));
    }
  }
  return header;
}

template <typename T>
std::vector<double> numbers(Bytes& bytes, std::size_t count) {
  std::array<T, 8192> chunk;
  std::vector<double> values;
  values.reserve(count);
  while (values.size() < count) {
    const std::span<T> now = std::span(chunk).first(std::min(chunk.size(), count - values.size()));
    bytes.fill({reinterpret_cast<char*>(now.data()), now.size_bytes()});  // NOLINT
    values.insert(values.end(), now.begin(), now.end());
  }
  return values;
}

/// A type of numbers, by its name in the header.
struct NumberType {
  std::string_view name;
  std::size_t size;
  std::vector<double> (*read)(Bytes& bytes, std::size_t count);
};

template <typename T>
constexpr NumberType number_type(std::string_view name) {
  return {name, sizeof(T), numbers<T>};
}

/// Times of NumPy in seconds, from the number of their units per second.
template <std::int64_t per_second>
std::vector<double> times(Bytes& bytes, std::size_t count) {
  std::vector<double> values = numbers<std::int64_t>(bytes, count);
  constexpr auto not_a_time = static_cast<double>(std::numeric_limits<std::int64_t>::min());
  for (double& value : values) {
    value = value == not_a_time ? std::numeric_limits<double>::quiet_NaN()
                                : value / static_cast<double>(per_second);
  }
  return values;
}

template <std::int64_t per_second>
constexpr NumberType time_type(std::string_view name) {
  return {name, sizeof(std::int64_t), times<per_second>};
}

constexpr std::array<NumberType, 19> number_types = {
    number_type<double>("<f8"),          number_type<float>("<f4"),
    number_type<std::int64_t>("<i8"),    number_type<std::int32_t>("<i4"),
    number_type<std::int16_t>("<i2"),    number_type<std::int8_t>("|i1"),
    number_type<std::uint64_t>("<u8"),   number_type<std::uint32_t>("<u4"),
    number_type<std::uint16_t>("<u2"),   number_type<std::uint8_t>("|u1"),
    number_type<std::uint8_t>("|b1"),    time_type<1>("<M8[s]"),
    time_type<1000>("<M8[ms]"),          time_type<1'000'000>("<M8[us]"),
    time_type<1'000'000'000>("<M8[ns]"), time_type<1>("<m8[s]"),
    time_type<1000>("<m8[ms]"),          time_type<1'000'000>("<m8[us]"),
    time_type<1'000'000'000>("<m8[ns]"),
};

std::vector<double> transposed(const std::vector<double>& columns, std::size_t rows,
                               std::size_t row_length) {
  std::vector<double> values(columns.size());
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < row_length; ++j) values[i * row_length + j] = columns[j * rows + i];
  }
  return values;
}

}  // namespace

ModelArray from_npy(std::string_view bytes, const std::string& name) {
  std::string_view rest = bytes;
  const NpyBytes source = [&](std::span<char> buffer) {
    const std::size_t size = rest.copy(buffer.data(), buffer.size());
    rest.remove_prefix(size);
    return size;
  };
  return read_npy(source, bytes.size(), name, std::numeric_limits<std::size_t>::max());
}

ModelArray read_npy(const NpyBytes& source, std::size_t size, const std::string& name,
                    std::size_t most) {
  Bytes bytes(source, size, name);
  const Header header = read_header(bytes, name);
  const std::size_t count = std::accumulate(header.shape.begin(), header.shape.end(),
                                            std::size_t{1}, std::multiplies<>());
  const auto* const type = std::find_if(number_types.begin(), number_types.end(),
                                        [&](const NumberType& t) { return t.name == header.type; });
  if (type == number_types.end()) {
    throw InputError(name +
                     ": expected float64, float32, whole numbers, bool or datetime64, found '" +
                     header.type + "'");
  }
  const std::size_t expected = count * type->size;
  if (bytes.left() != expected) {
    throw InputError(name + ": expected " + std::to_string(expected) + " bytes of numbers, found " +
                     std::to_string(bytes.left()));
  }
  if (count > most) {
    throw InputError(name + ": expected " + std::to_string(most) + " numbers at most, found " +
                     std::to_string(count));
  }
  ModelArray array{header.shape, type->read(bytes, count)};
  if (header.is_fortran_order && array.shape.size() == 2) {
    array.data = transposed(array.data, array.shape[0], array.shape[1]);
  }
  return array;
}

std::string to_npy(const ModelArray& array) {
  const std::size_t count =
      std::accumulate(array.shape.begin(), array.shape.end(), std::size_t{1}, std::multiplies<>());
  if (array.shape.empty() || array.shape.size() > 2 || count != array.data.size()) {
    throw Error("the shape of an array to be written does not match its size");
  }
  std::string header =
      "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(array.shape[0]) + "," +
      (array.shape.size() == 1 ? "" : " " + std::to_string(array.shape[1])) + "), }";
  // NumPy requires the data to begin at a multiple of 64 bytes, after a line break.
  while ((npy_magic.size() + 4 + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';

  std::string bytes(npy_magic);
  bytes += '\x01';
  bytes += '\x00';
  bytes += static_cast<char>(header.size() & 0xffU);
  bytes += static_cast<char>(header.size() >> 8U);
  bytes += header;
  const std::size_t start = bytes.size();
  bytes.resize(start + count * sizeof(double));
  if (count > 0) std::memcpy(bytes.data() + start, array.data.data(), count * sizeof(double));
  return bytes;
}

}  // namespace touchdown
