#include "logs/bags/cdr.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::logs {

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

const char* CdrReader::skip(std::size_t size, std::size_t count) {
  const std::size_t begin = (at_ + size - 1) / size * size;
  if (begin > bytes_.size() || (bytes_.size() - begin) / size < count) {
    throw InputError(
        fmt::format("a message of {} bytes ends within a value", bytes_.size() + header_bytes));
  }
  at_ = begin + size * count;
  return bytes_.data() + begin;
}

std::uint32_t CdrReader::count(std::size_t bytes) {
  const auto items = take<std::uint32_t>();
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

}  // namespace touchdown::logs
