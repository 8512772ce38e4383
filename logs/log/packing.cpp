#include "logs/log/packing.hpp"

#include <type_traits>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/terminal_text.hpp"

namespace touchdown::logs {

namespace {

const msgpack::object* find(const msgpack::object& map, std::string_view key) {
  if (map.type != msgpack::type::MAP) return nullptr;
  for (const msgpack::object_kv& entry : map.via.map) {
    if (entry.key.type == msgpack::type::STR &&
        std::string_view(entry.key.via.str.ptr, entry.key.via.str.size) == key) {
      return &entry.val;
    }
  }
  return nullptr;
}

template <typename T>
void take(const msgpack::object& map, std::string_view key, T& value) {
  const msgpack::object* found = find(map, key);
  if (found == nullptr) return;
  try {
    found->convert(value);
  } catch (const msgpack::type_error&) {
    throw InputError(
        fmt::format("{}: expected {}", key, std::is_integral_v<T> ? "a whole number" : "a text"));
  }
}

/// The same for texts, which must be UTF-8: they are copied to files that allow nothing else.
void take_text(const msgpack::object& map, std::string_view key, std::string& value) {
  take(map, key, value);
  if (const std::size_t size = utf8_size(value); size < value.size()) {
    throw InputError(fmt::format("{}: not UTF-8 from byte {} on", key, size));
  }
}

}  // namespace

void pack_info(LogPacker& packer, const RecordingInfo& info) {
  const auto text = [&](std::string_view value) { pack_text(packer, value); };
  text("config");
  packer.pack_map(1);
  text("touchdown");
  packer.pack_map(6U + (info.outcome ? 1U : 0U) + (info.robot_digest.empty() ? 0U : 1U));
  text("scenario"), text(info.scenario);
  text("simulator"), text(info.simulator);
  text("seed"), packer.pack_uint64(info.seed);
  text("run"), packer.pack_int64(info.run);
  text("control_period_us"), packer.pack_int64(info.control_period_us);
  if (info.outcome) text("outcome"), text(to_text(*info.outcome));
  text("scenario_yaml"), text(info.scenario_yaml);
  if (!info.robot_digest.empty()) text("robot_digest"), text(info.robot_digest);
}

void pack_robot(LogPacker& packer, std::string_view robot) {
  pack_text(packer, "config");
  packer.pack_map(1);
  pack_text(packer, "robot");
  pack_text(packer, robot);
}

std::string unpack_robot(std::string_view record) {
  const msgpack::object_handle handle = msgpack::unpack(record.data(), record.size());
  const msgpack::object* config = find(handle.get(), "config");
  const msgpack::object* robot = config == nullptr ? nullptr : find(*config, "robot");
  if (robot == nullptr || robot->type != msgpack::type::STR) return {};
  const std::string_view name(robot->via.str.ptr, robot->via.str.size);
  return utf8_size(name) == name.size() ? std::string(name) : std::string();
}

std::optional<RecordingInfo> unpack_info(std::string_view record, std::string_view log_name) {
  try {
    const msgpack::object_handle handle = msgpack::unpack(record.data(), record.size());
    const msgpack::object* config = find(handle.get(), "config");
    const msgpack::object* info_map = config == nullptr ? nullptr : find(*config, "touchdown");
    if (info_map == nullptr) return {};
    RecordingInfo info;
    take_text(*info_map, "scenario", info.scenario);
    take_text(*info_map, "simulator", info.simulator);
    take(*info_map, "seed", info.seed);
    take(*info_map, "run", info.run);
    take(*info_map, "control_period_us", info.control_period_us);
    take_text(*info_map, "scenario_yaml", info.scenario_yaml);
    take_text(*info_map, "robot_digest", info.robot_digest);
    std::string outcome;
    take(*info_map, "outcome", outcome);
    if (!outcome.empty()) info.outcome = outcome_from_text(outcome);
    if (info.control_period_us <= 0) throw InputError("control_period_us must be positive");
    return info;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("{}: config.touchdown: {}", log_name, error.what()));
  }
}

}  // namespace touchdown::logs
