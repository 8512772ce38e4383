#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "logs/log/reader.hpp"
#include "logs/mapping/conversion.hpp"
#include "tests/complaint.hpp"
#include "tests/logs/log/upkie_log.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::logs::test {

/// Reads other robots' logs by mappings, in a folder of its own.
class MappedLogs : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

  /// The rows of a log. A caller that pulls them gets the same bits as the reader of an exported
  /// log.
  std::vector<LogRow> convert(const std::filesystem::path& log, const std::string& mapping) {
    const std::filesystem::path map = write("map.yaml", mapping);
    std::stringstream stream;
    converted_ = convert_log(log, map, stream, {.with_labels = true});
    LogReader exported(stream_source(stream), "log");
    LogReader pulled(mapped_records(log, map), "log");
    std::vector<LogRow> rows;
    while (const std::optional<LogRow> row = exported.next()) {
      const std::optional<LogRow> other = pulled.next();
      if (!other) ADD_FAILURE() << "fewer rows are pulled than exported";
      if (other) expect_same(*row, *other);
      rows.push_back(*row);
    }
    EXPECT_FALSE(pulled.next()) << "more rows are pulled than exported";
    start_ = exported.start_time();
    EXPECT_EQ(pulled.start_time(), start_);
    EXPECT_EQ(pulled.warnings().size(), converted_.warnings.size() + exported.warnings().size());
    return rows;
  }

  std::string complaint(const std::filesystem::path& log, const std::string& mapping) {
    return complaint_of([&] { (void)convert(log, mapping); });
  }

  ScratchFolder folder_;
  ConvertedLog converted_;
  double start_ = 0.0;

 private:
  static void expect_same(const LogRow& a, const LogRow& b) {
    const LogValues values = to_values(a.observation, a.action, nullptr);
    const LogValues others = to_values(b.observation, b.action, nullptr);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const bool are_missing = std::isnan(values[i]) && std::isnan(others[i]);
      ASSERT_TRUE(are_missing || values[i] == others[i]) << "value " << i;
    }
  }
};

}  // namespace touchdown::logs::test
