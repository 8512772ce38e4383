#include "logs/bags/sensor_messages.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::logs {

namespace {

/// Reads the values of a message in the order of their definition, from bytes in CDR (XCDR1, OMG
/// DDS-XTypes 7.4.3), of either byte order. Values are aligned to their size, relative to the byte
/// after the four bytes of the header. Errors: `InputError` when the header is another one, or when
/// the bytes end before a value does; no declared size is trusted.
class CdrReader {
 public:
  explicit CdrReader(std::string_view payload);

  double number();  ///< a 64-bit floating-point number
  std::int32_t int32();
  std::uint32_t uint32();
  /// Without the NUL at its end.
  std::string_view text();
  void numbers(std::vector<double>& values);
  void texts(std::vector<std::string_view>& values);

 private:
  template <typename T>
  T take();
  /// The number of items of a sequence, of which each has at least `bytes`.
  std::uint32_t count(std::size_t bytes);

  std::string_view bytes_;
  std::size_t at_ = 0;
  bool is_swapped_ = false;
};

constexpr std::size_t header_bytes = 4;

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

MessageStamp read_header(CdrReader& reader) {
  MessageStamp stamp;
  stamp.sec = reader.int32();
  stamp.nanosec = reader.uint32();
  if (stamp.nanosec >= 1'000'000'000) {
    throw InputError(fmt::format("a stamp has {} nanoseconds", stamp.nanosec));
  }
  (void)reader.text();  // frame_id
  return stamp;
}

void check_size(const std::vector<double>& values, const JointState& state, const char* what) {
  if (values.empty() || values.size() == state.name.size()) return;
  throw InputError(
      fmt::format("{} has {} values for {} names", what, values.size(), state.name.size()));
}

/// Numbers with their covariance behind them.
template <std::size_t N>
void read_vector(CdrReader& reader, std::array<double, N>& values) {
  for (double& value : values) value = reader.number();
  const double first = reader.number();
  for (int i = 1; i < 9; ++i) (void)reader.number();
  if (first == -1.0) values.fill(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

void decode(std::string_view payload, JointState& state) {
  CdrReader reader(payload);
  state.stamp = read_header(reader);
  reader.texts(state.name);
  reader.numbers(state.position);
  reader.numbers(state.velocity);
  reader.numbers(state.effort);
  check_size(state.position, state, "position");
  check_size(state.velocity, state, "velocity");
  check_size(state.effort, state, "effort");
}

void decode(std::string_view payload, ImuState& state) {
  CdrReader reader(payload);
  state.stamp = read_header(reader);
  read_vector(reader, state.orientation);
  const auto is_zero = [](double x) { return x == 0.0; };
  if (std::all_of(state.orientation.begin(), state.orientation.end(), is_zero)) {
    state.orientation.fill(std::numeric_limits<double>::quiet_NaN());
  }
  read_vector(reader, state.angular_velocity);
  read_vector(reader, state.linear_acceleration);
}

}  // namespace touchdown::logs
