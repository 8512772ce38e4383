#include "recordings/bags/cdr.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::recordings {

namespace {

constexpr std::size_t header_bytes = 4;

}  // namespace

CdrReader::CdrReader(std::string_view payload) {
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
T CdrReader::take() {
  const std::size_t begin = (at_ + sizeof(T) - 1) / sizeof(T) * sizeof(T);
  if (begin > bytes_.size() || bytes_.size() - begin < sizeof(T)) {
    throw InputError(
        fmt::format("a message of {} bytes ends within a value", bytes_.size() + header_bytes));
  }
  std::array<char, sizeof(T)> raw{};
  std::memcpy(raw.data(), bytes_.data() + begin, sizeof(T));
  if (is_swapped_) std::reverse(raw.begin(), raw.end());
  at_ = begin + sizeof(T);
  return std::bit_cast<T>(raw);
}

double CdrReader::number() { return take<double>(); }
std::int32_t CdrReader::int32() { return take<std::int32_t>(); }
std::uint32_t CdrReader::uint32() { return take<std::uint32_t>(); }

std::uint32_t CdrReader::count(std::size_t bytes) {
  const std::uint32_t items = uint32();
  if (items > (bytes_.size() - at_) / bytes) {
    throw InputError(fmt::format("a message of {} bytes declares a sequence of {} items",
                                 bytes_.size() + header_bytes, items));
  }
  return items;
}

std::string_view CdrReader::text() {
  const std::uint32_t size = count(1);
  std::string_view text = bytes_.substr(at_, size);
  at_ += size;
  if (text.ends_with('\0')) text.remove_suffix(1);
  return text;
}

void CdrReader::numbers(std::vector<double>& values) {
  values.resize(count(sizeof(double)));
  for (double& value : values) value = number();
}

void CdrReader::texts(std::vector<std::string_view>& values) {
  values.resize(count(sizeof(std::uint32_t)));
  for (std::string_view& value : values) value = text();
}

}  // namespace touchdown::recordings
