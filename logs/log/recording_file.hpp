#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "logs/log/reader.hpp"
#include "logs/recording.hpp"

namespace touchdown::logs {

/// Writes a recording as a log in Upkie's layout, completely or not at all.
/// Errors: `Error` when it cannot be written or its columns differ in length.
void write_recording(const Recording& recording, const std::filesystem::path& path);

/// Reads a whole log into memory; "-" is standard input. Problems that are not fatal are added to
/// `warnings` if given. Errors: as `LogReader`.
Recording read_recording(const std::filesystem::path& path,
                         std::vector<std::string>* warnings = nullptr);
/// Reads the rest of a log.
Recording read_recording(LogReader& reader, std::vector<std::string>* warnings = nullptr);

}  // namespace touchdown::logs
