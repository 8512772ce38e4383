#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numeric>

#include "core/error.hpp"
#include "estimator/npz/npz.hpp"

namespace touchdown {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");

/// The first bytes of a `.npy` file.
constexpr std::string_view npy_magic = "\x93NUMPY";

/// Far above any array. The product of two cannot overflow.
constexpr std::size_t largest_axis = std::size_t{1} << 28U;

/// The header is a Python dictionary on one line: what is between two marks behind `'key': `.
std::string_view value_of(std::string_view header, const std::string& key, char open, char close) {
  const std::string begin = "'" + key + "': " + open;
  const std::size_t at = header.find(begin);
  if (at == std::string_view::npos) return {};
  const std::string_view rest = header.substr(at + begin.size());
  const std::size_t end = rest.find(close);
  return end == std::string_view::npos ? std::string_view() : rest.substr(0, end);
}

/// "2, 3" or "2,"; empty for anything else.
std::vector<std::size_t> shape_of(std::string_view text) {
  std::vector<std::size_t> shape;
  while (!text.empty()) {
    std::size_t axis = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), axis);
    if (error != std::errc{}) return {};
    shape.push_back(axis);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    text.remove_prefix(std::min(text.size(), text.find_first_not_of(", ")));
  }
  return shape;
}

template <typename T>
double rest_of(T number) {
  const long double exact = number;  // 64 bits of mantissa
  return static_cast<double>(exact - static_cast<long double>(static_cast<double>(number)));
}

template <typename T>
void copy_numbers(std::string_view bytes, NpyPart part, std::vector<double>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    T number;
    std::memcpy(&number, bytes.data() + i * sizeof(T), sizeof(T));
    numbers[i] = part == NpyPart::rest ? rest_of(number) : static_cast<double>(number);
  }
}

/// A type of numbers, by its name in the header.
struct NumberType {
  std::string_view name;
  std::size_t size;
  void (*copy)(std::string_view bytes, NpyPart part, std::vector<double>& numbers);
};
template <typename T>
constexpr NumberType number_type(std::string_view name) {
  return {name, sizeof(T), copy_numbers<T>};
}
constexpr std::array number_types = {
    number_type<double>("<f8"),        number_type<float>("<f4"),
    number_type<std::int64_t>("<i8"),  number_type<std::int32_t>("<i4"),
    number_type<std::int16_t>("<i2"),  number_type<std::int8_t>("|i1"),
    number_type<std::uint64_t>("<u8"), number_type<std::uint32_t>("<u4"),
    number_type<std::uint16_t>("<u2"), number_type<std::uint8_t>("|u1"),
    number_type<std::uint8_t>("|b1")};

/// The line of NumPy that makes numbers of a type that is not read.
std::string conversion_of(std::string_view type) {
  if (type.starts_with("<M8")) return "array.astype('M8[ns]').astype(float) / 1e9";
  if (type.starts_with("<m8")) return "array.astype('m8[ns]').astype(float) / 1e9";
  // `astype` takes objects that are numbers, not those that are lists of them.
  if (type == "|O") return "np.array(array.tolist(), float)";
  return "array.astype(float)";
}

std::size_t count_of(const std::vector<std::size_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

}  // namespace

ModelArray from_npy(std::string_view bytes, const std::string& name, NpyPart part) {
  if (!bytes.starts_with(npy_magic)) throw InputError(name + ": is not a NumPy array");
  const auto byte = [&](std::size_t i) {
    return i < bytes.size() ? std::size_t{static_cast<unsigned char>(bytes[i])} : 0;
  };
  const bool is_wide = byte(6) >= 2;
  const std::size_t start = is_wide ? 12 : 10;
  std::size_t length = byte(8) | byte(9) << 8U;
  if (is_wide) length |= byte(10) << 16U | byte(11) << 24U;
  if (bytes.size() < start + length) throw InputError(name + ": is cut off within its header");
  const std::string_view header = bytes.substr(start, length);
  const std::string_view numbers = bytes.substr(start + length);
  const std::string_view type = value_of(header, "descr", '\'', '\'');
  ModelArray array{shape_of(value_of(header, "shape", '(', ')')), {}};
  if (type.empty() || array.shape.empty() || array.shape.size() > 2) {
    throw InputError(name +
                     ": expected an array of numbers with one or two axes, found the header " +
                     std::string(header.substr(0, header.find_last_not_of(" \n") + 1)));
  }
  const auto* const known = std::ranges::find(number_types, type, &NumberType::name);
  if (known == number_types.end()) {
    throw InputError(name + ": expected float64, float32, whole numbers or bool, found '" +
                     std::string(type) + "': " + conversion_of(type) + " makes them");
  }
  if (array.shape.size() == 2 && header.find("'fortran_order': True") != header.npos) {
    throw InputError(name + ": expected rows one after the other, found columns: " +
                     "np.ascontiguousarray(array) makes rows");
  }
  for (const std::size_t axis : array.shape) {
    if (axis > largest_axis) throw InputError(name + ": has an axis of " + std::to_string(axis));
  }
  const std::size_t expected = count_of(array.shape) * known->size;
  if (numbers.size() != expected) {
    throw InputError(name + ": expected " + std::to_string(expected) + " bytes of numbers, found " +
                     std::to_string(numbers.size()));
  }
  array.data.resize(count_of(array.shape));
  known->copy(numbers, part, array.data);
  return array;
}

std::string to_npy(const ModelArray& array) {
  if (array.shape.empty() || array.shape.size() > 2 || count_of(array.shape) != array.data.size()) {
    throw Error("the shape of an array to be written does not match its size");
  }
  std::string header =
      "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(array.shape[0]) + "," +
      (array.shape.size() == 1 ? "" : " " + std::to_string(array.shape[1])) + "), }";
  // NumPy requires the data to begin at a multiple of 64 bytes, after a line break.
  header.append(63 - (npy_magic.size() + 4 + header.size()) % 64, ' ') += '\n';
  std::string bytes(npy_magic);
  bytes.append({'\x01', '\x00', static_cast<char>(header.size() & 0xffU),
                static_cast<char>(header.size() >> 8U)});
  bytes += header;
  return bytes.append(reinterpret_cast<const char*>(array.data.data()),  // NOLINT
                      array.data.size() * sizeof(double));
}

}  // namespace touchdown
