#include "tests/logs/log/upkie_log.hpp"

#include <sstream>

namespace touchdown::logs::test {

using nlohmann::json;

json upkie_record(double time) {
  json record;
  record["time"] = 1.7e9 + time;
  record["spine"] = {{"clock", {{"slack", 1e-4}}}, {"state", {{"cycle_end", 4}}}};
  int number = 1;
  for (const char* side : {"left", "right"}) {
    for (const char* part : {"hip", "knee", "wheel"}) {
      const std::string joint = std::string(side) + "_" + part;
      record["observation"]["servo"][joint] = {{"d_current", 0.0},
                                               {"fault", 0},
                                               {"mode", 10},
                                               {"position", 0.1 * number},
                                               {"q_current", 0.25},
                                               {"temperature", 30.0},
                                               {"torque", 0.2 * number},
                                               {"velocity", 0.3 * number},
                                               {"voltage", 20.0}};
      record["action"]["servo"][joint] = {{"feedforward_torque", 0.0}, {"position", nullptr},
                                          {"velocity", 1.0 * number},  {"kp_scale", 0.5},
                                          {"kd_scale", 1.0},           {"maximum_torque", 1.7}};
      ++number;
    }
  }
  record["observation"]["time"] = 100.0 + time;
  record["observation"]["imu"] = {{"orientation", {0.0, 0.0, 1.0, 0.0}},
                                  {"angular_velocity", {0.1, 0.2, 0.3}},
                                  {"linear_acceleration", {1.0, 2.0, 3.0}},
                                  {"raw_angular_velocity", {0.1, 0.2, 0.3}},
                                  {"raw_linear_acceleration", {1.0, 2.0, -7.0}}};
  record["observation"]["base_orientation"] = {
      {"pitch", 0.05},
      {"angular_velocity", {0.01, 0.02, 0.03}},
      {"rotation_base_to_world", {1, 0, 0, 0, 1, 0, 0, 0, 1}}};
  record["observation"]["floor_contact"] = {{"contact", true}, {"upper_leg_torque", 5.0}};
  record["observation"]["wheel_odometry"] = {{"position", 0.0}, {"velocity", 0.0}};
  return record;
}

std::string pack(const std::vector<json>& records) {
  std::string log;
  for (const json& record : records) {
    const std::vector<std::uint8_t> bytes = json::to_msgpack(record);
    log.append(bytes.begin(), bytes.end());
  }
  return log;
}

std::vector<json> unpack(const std::string& log) {
  std::vector<json> records;
  std::istringstream stream(log);
  while (stream.peek() != std::istringstream::traits_type::eof()) {
    records.push_back(json::from_msgpack(stream, false));
  }
  return records;
}

ByteSource stream_source(std::istream& stream) {
  return [&stream](std::span<char> buffer) -> std::size_t {
    // Wait for one byte only: a live stream has its next record when it has it.
    if (buffer.empty() || !stream.get(buffer[0])) return 0;
    const std::streamsize more =
        stream.readsome(buffer.data() + 1, static_cast<std::streamsize>(buffer.size()) - 1);
    return 1 + static_cast<std::size_t>(more);
  };
}

}  // namespace touchdown::logs::test
