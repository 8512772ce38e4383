#include "recordings/bags/sensor_messages.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include <fmt/format.h>

#include "core/error.hpp"
#include "recordings/bags/cdr.hpp"

namespace touchdown::recordings {

namespace {

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

}  // namespace touchdown::recordings
