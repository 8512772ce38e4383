#include "recordings/models/npy.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numeric>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::recordings {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");

constexpr std::string_view magic = "\x93NUMPY";
/// Far above any grid; a size beyond it is a broken header, and its product cannot overflow.
constexpr std::size_t largest_axis = std::size_t{1} << 28U;

struct Header {
  std::string type;
  bool is_fortran_order = false;
  std::vector<std::size_t> shape;
  std::size_t data_offset = 0;
};

/// The header is a Python dictionary on one line: what follows `'key':` in it.
std::string_view value_of(std::string_view text, std::string_view key) {
  const std::size_t found = text.find(fmt::format("'{}':", key));
  if (found == std::string_view::npos) return {};
  const std::string_view rest = text.substr(found + key.size() + 3);
  return rest.substr(std::min(rest.size(), rest.find_first_not_of(' ')));
}

/// What stands between the marks, if the text begins with the first one.
std::string_view between(std::string_view text, std::string_view open, std::string_view close) {
  const std::size_t end = text.find(close, open.size());
  if (!text.starts_with(open) || end == std::string_view::npos) return {};
  return text.substr(open.size(), end - open.size());
}

/// "2, 3" or "2,"; empty if it is anything else.
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

Header parse_header(std::string_view bytes, const std::string& name) {
  const auto byte = [&](std::size_t i) {
    return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i]));
  };
  if (bytes.size() < 12 || bytes.substr(0, magic.size()) != magic) {
    throw InputError(fmt::format("{}: is not a NumPy array", name));
  }
  const bool is_wide = byte(6) >= 2;
  const std::size_t start = is_wide ? 12 : 10;
  std::size_t length = byte(8) | byte(9) << 8U;
  if (is_wide) length |= byte(10) << 16U | byte(11) << 24U;
  if (bytes.size() < start + length || length > 65536) {
    throw InputError(fmt::format("{}: is cut off within its header", name));
  }
  const std::string_view text = bytes.substr(start, length);
  Header header{std::string(between(value_of(text, "descr"), "'", "'")),
                value_of(text, "fortran_order").starts_with("True"),
                parse_shape(between(value_of(text, "shape"), "(", ")")), start + length};
  if (header.type.empty() || header.shape.empty() || header.shape.size() > 2) {
    throw InputError(
        fmt::format("{}: expected an array of numbers with one or two axes, found the header {}",
                    name, text.substr(0, text.find_last_not_of(" \n") + 1)));
  }
  for (const std::size_t axis : header.shape) {
    if (axis > largest_axis) throw InputError(fmt::format("{}: has an axis of {}", name, axis));
  }
  return header;
}

template <typename T>
std::vector<double> numbers(std::string_view bytes, std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    T value;
    std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
    values[i] = static_cast<double>(value);
  }
  return values;
}

std::vector<double> transposed(const std::vector<double>& columns, std::size_t rows,
                               std::size_t row_length) {
  std::vector<double> values(columns.size());
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < row_length; ++j) values[i * row_length + j] = columns[j * rows + i];
  }
  return values;
}

}  // namespace

std::string to_npy(const NpyArray& array) {
  const std::size_t count =
      std::accumulate(array.shape.begin(), array.shape.end(), std::size_t{1}, std::multiplies<>());
  if (array.shape.empty() || array.shape.size() > 2 || count != array.data.size()) {
    throw Error("an array to be written has a shape that is not its own");
  }
  std::string header =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}), }}",
                  array.shape.size() == 1 ? fmt::format("{},", array.shape[0])
                                          : fmt::format("{}, {}", array.shape[0], array.shape[1]));
  // NumPy wants the data to begin at a multiple of 64 bytes, after a line break.
  while ((magic.size() + 4 + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';

  std::string bytes(magic);
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

NpyArray from_npy(std::string_view bytes, const std::string& name) {
  const Header header = parse_header(bytes, name);
  const std::size_t count = std::accumulate(header.shape.begin(), header.shape.end(),
                                            std::size_t{1}, std::multiplies<>());
  const bool is_single = header.type == "<f4";
  if (!is_single && header.type != "<f8") {
    throw InputError(fmt::format("{}: expected numbers of type float64 or float32, found '{}'",
                                 name, header.type));
  }
  const std::string_view data = bytes.substr(header.data_offset);
  const std::size_t expected = count * (is_single ? sizeof(float) : sizeof(double));
  if (data.size() != expected) {
    throw InputError(
        fmt::format("{}: expected {} bytes of numbers, found {}", name, expected, data.size()));
  }
  NpyArray array{header.shape,
                 is_single ? numbers<float>(data, count) : numbers<double>(data, count)};
  if (header.is_fortran_order && array.shape.size() == 2) {
    array.data = transposed(array.data, array.shape[0], array.shape[1]);
  }
  return array;
}

}  // namespace touchdown::recordings
