#include "recordings/mcap/log.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include <fmt/format.h>

#include "core/error.hpp"
#include "recordings/log/outline.hpp"
#include "recordings/mcap/writer.hpp"

namespace touchdown::recordings {

namespace {

using Json = nlohmann::ordered_json;

/// The JSON Schema of messages like this one.
Json schema_of(const Json& value) {
  if (value.is_object()) {
    Json properties = Json::object();
    for (const auto& [key, of_key] : value.items()) properties[key] = schema_of(of_key);
    return {{"type", "object"}, {"properties", properties}};
  }
  if (value.is_array()) {
    return {{"type", "array"}, {"items", value.empty() ? Json::object() : schema_of(value[0])}};
  }
  if (value.is_boolean()) return {{"type", "boolean"}};
  if (value.is_string()) return {{"type", "string"}};
  return {{"type", "number"}};  // null, too: a number that is not known yet
}

/// Formats JSON. NaN becomes null; invalid UTF-8 is replaced.
std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json observation_in(std::string_view record, std::string_view log) {
  try {
    return Json::from_msgpack(record).at("observation");
  } catch (const Json::exception& error) {
    const std::string_view reason = error.what();  // begins with the library's "[json.exception…] "
    throw InputError(fmt::format("{}: a record cannot be written as JSON: {}", log,
                                 reason.substr(std::min(reason.find("] ") + 2, reason.size()))));
  }
}

/// Moves the beliefs out of an observation.
Json beliefs_of(Json& observation) {
  Json beliefs = Json::object();
  for (const std::string_view group : belief_groups) {
    const auto found = observation.find(std::string(group));
    if (found == observation.end()) continue;
    beliefs[std::string(group)] = std::move(*found);
    observation.erase(found);
  }
  return beliefs;
}

}  // namespace

std::string json_schema_of(std::string_view message) {
  return text_of(schema_of(Json::parse(message)));
}

std::uint64_t write_mcap(LogReader& reader, std::ostream& stream, const AddMessages& add) {
  McapWriter writer(stream);
  std::uint16_t of_observation = 0;
  std::uint16_t of_beliefs = 0;
  std::uint64_t rows = 0;
  std::uint64_t time = 0;  // a row without a time gets that of the previous row
  for (; const std::optional<LogRow> row = reader.next(); ++rows) {
    const double nanoseconds = 1e9 * (reader.start_time() + row->observation.time);
    if (nanoseconds >= 0.0 && nanoseconds < 0x1p63) {
      time = static_cast<std::uint64_t>(std::llround(nanoseconds));
    }
    Json observation = observation_in(reader.record(), reader.name());
    const Json beliefs = beliefs_of(observation);
    if (rows == 0) {
      of_observation = writer.add_topic(mcap_observation_topic, mcap_observation_topic + 1,
                                        text_of(schema_of(observation)));
      if (!beliefs.empty()) {
        of_beliefs =
            writer.add_topic(mcap_belief_topic, mcap_belief_topic + 1, text_of(schema_of(beliefs)));
      }
    }
    writer.write(of_observation, time, text_of(observation));
    if (of_beliefs != 0 && !beliefs.empty()) writer.write(of_beliefs, time, text_of(beliefs));
    if (add) add(writer, rows, time);
  }
  writer.finish();
  return rows;
}

}  // namespace touchdown::recordings
