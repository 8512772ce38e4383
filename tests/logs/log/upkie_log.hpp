#pragma once

#include <istream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "logs/log/byte_source.hpp"

namespace touchdown::logs::test {

/// A record as a current spine writes it, built from the facts about Upkie's layout and packed by
/// another MessagePack library than the one under test.
nlohmann::json upkie_record(double time);

/// Concatenated MessagePack maps.
std::string pack(const std::vector<nlohmann::json>& records);

/// The records of a log, by the other library.
std::vector<nlohmann::json> unpack(const std::string& log);

/// Any stream as a log; it must outlive the source.
ByteSource stream_source(std::istream& stream);

}  // namespace touchdown::logs::test
