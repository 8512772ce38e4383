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

void pack_origin(LogPacker& packer, const RecordingInfo& info) {
  const auto text = [&](std::string_view value) { pack_text(packer, value); };
  text("config");
  packer.pack_map(1);
  if (!info.robot.empty()) {
    text("robot"), text(info.robot);
    return;
  }
  text("touchdown");
  packer.pack_map(6U + (info.outcome ? 1U : 0U) + (info.robot_digest.empty() ? 0U : 1U) +
                  (info.robot_mass > 0.0 ? 1U : 0U));
  text("scenario"), text(info.scenario);
  text("simulator"), text(info.simulator);
  text("seed"), packer.pack_uint64(info.seed);
  text("run"), packer.pack_int64(info.run);
  text("control_period_us"), packer.pack_int64(info.control_period_us);
  if (info.outcome) text("outcome"), text(to_text(*info.outcome));
  text("scenario_yaml"), text(info.scenario_yaml);
  if (!info.robot_digest.empty()) text("robot_digest"), text(info.robot_digest);
  if (info.robot_mass > 0.0) text("robot_mass"), packer.pack_double(info.robot_mass);
}

void unpack_origin(std::string_view record, std::string_view log_name,
                   std::optional<RecordingInfo>& info, std::string& robot) {
  try {
    const msgpack::object_handle handle = msgpack::unpack(record.data(), record.size());
    const msgpack::object* const config = find(handle.get(), "config");
    if (config == nullptr) return;
    const msgpack::object* const origin = find(*config, "touchdown");
    const msgpack::object* const named = find(*config, "robot");
    if (origin == nullptr && named != nullptr && named->type == msgpack::type::STR) {
      const std::string_view name(named->via.str.ptr, named->via.str.size);
      if (utf8_size(name) == name.size()) robot = name;
    }
    if (origin == nullptr) return;
    RecordingInfo read;
    take_text(*origin, "scenario", read.scenario);
    take_text(*origin, "simulator", read.simulator);
    take(*origin, "seed", read.seed);
    take(*origin, "run", read.run);
    take(*origin, "control_period_us", read.control_period_us);
    take_text(*origin, "scenario_yaml", read.scenario_yaml);
    take_text(*origin, "robot_digest", read.robot_digest);
    take(*origin, "robot_mass", read.robot_mass);
    std::string outcome;
    take(*origin, "outcome", outcome);
    if (!outcome.empty()) read.outcome = outcome_from_text(outcome);
    if (read.control_period_us <= 0) throw InputError("control_period_us must be positive");
    if (!(read.robot_mass >= 0.0 && read.robot_mass < 1e6)) {
      throw InputError("robot_mass must be positive");
    }
    info = std::move(read);
  } catch (const std::exception& error) {
    throw InputError(fmt::format("{}: config.touchdown: {}", log_name, error.what()));
  }
}

}  // namespace touchdown::logs
