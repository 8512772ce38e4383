#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
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

/// The rows of a recording in memory, as the records of a log. They end once `stop` is true; it may
/// be null.
std::unique_ptr<RecordSource> records_of(std::shared_ptr<const Recording> recording,
                                         const std::atomic<bool>* stop = nullptr);

}  // namespace touchdown::logs
