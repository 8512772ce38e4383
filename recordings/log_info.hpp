#pragma once

#include <optional>
#include <string_view>

#include <msgpack.hpp>

#include "recordings/recording.hpp"

namespace touchdown {

/// Appends `config: {touchdown: {…}}` to a map that is being packed: where the run comes from.
template <typename Stream>
void pack_info(msgpack::packer<Stream>& packer, const RecordingInfo& info);

/// What `config.touchdown` of a record says; nothing if it was not written by us.
/// Errors: `InputError` when it says something that we do not understand.
std::optional<RecordingInfo> unpack_info(std::string_view record, std::string_view log_name);

template <typename Stream>
void pack_info(msgpack::packer<Stream>& packer, const RecordingInfo& info) {
  const auto text = [&](std::string_view value) {
    packer.pack_str(static_cast<std::uint32_t>(value.size()));
    packer.pack_str_body(value.data(), static_cast<std::uint32_t>(value.size()));
  };
  text("config");
  packer.pack_map(1);
  text("touchdown");
  packer.pack_map(info.outcome ? 7 : 6);
  text("scenario"), text(info.scenario);
  text("simulator"), text(info.simulator);
  text("seed"), packer.pack_uint64(info.seed);
  text("run"), packer.pack_int64(info.run);
  text("control_period_us"), packer.pack_int64(info.control_period_us);
  if (info.outcome) text("outcome"), text(to_text(*info.outcome));
  text("scenario_yaml"), text(info.scenario_yaml);
}

}  // namespace touchdown
