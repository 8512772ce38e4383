#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "recordings/mapping/mapping.hpp"
#include "recordings/mapping/source_log.hpp"

namespace touchdown::recordings {

/// Receives the rows of a log with several sources. `mapping` gets the names of their columns.
/// `row` then receives the numbers of `LogMapping::columns`, joined at the joints' clock.
struct JoinedLogSink {
  std::function<const LogMapping&(std::span<const SourceNames> sources)> mapping;
  std::function<void(std::span<const double> row, const SourceLocation& place)> row;
};

/// Reads a log with several sources: files of one folder (`log` is the folder, or one of them), or
/// topics of a ROS 2 bag; without `sources`, the bag's only JointState and its only Imu. Each row
/// of the joints gets the latest values of the other sources. Returns one line for each thing that
/// a user should know, such as the ages of held values. Errors: `InputError` as in
/// `read_source_log`, `BagReader` and `find_signal_topics`, and for sources without a time in
/// common.
std::vector<std::string> read_joined_log(const std::filesystem::path& log,
                                         const LogSources& sources, const JoinedLogSink& sink);

}  // namespace touchdown::recordings
