#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "logs/mapping/joined_source.hpp"

namespace touchdown::logs {

namespace {

namespace fs = std::filesystem;

/// Whether a row has any number besides its time. In the outer join of two topics, others belong
/// to the other one.
bool has_numbers(std::span<const double> row, const SourceClock& clock,
                 const std::vector<std::size_t>& columns) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    const bool is_time = columns[i] == clock.time.numbers.front().column ||
                         columns[i] == clock.rest ||
                         (clock.nanosec && columns[i] == clock.nanosec->numbers.front().column);
    if (!is_time && std::isfinite(row[i])) return true;
  }
  return false;
}

/// `columns`: where the file's numbers are in the mapping's rows.
SourceRows rows_of(RowSource& file, const LogMapping& mapping, const SourceClock& clock,
                   const std::vector<std::size_t>& columns) {
  SourceRows rows;
  std::vector<double> mapped(mapping.columns.size());
  std::vector<double> row;
  std::uint64_t position = 0;
  LogMapping own;
  for (const std::size_t column : columns) own.columns.push_back(mapping.columns[column]);
  file.select(own);
  while (file.next(row)) {
    ++position;
    if (!has_numbers(row, clock, columns)) continue;
    for (std::size_t i = 0; i < row.size(); ++i) mapped[columns[i]] = row[i];
    rows.add(0.0, clock.at(mapped), row, position);
  }
  return rows;
}

/// The folder of the sources of a log, which is this folder or one of them.
fs::path folder_of(const fs::path& log, const LogSources& sources) {
  if (is_folder(log)) return log;
  const std::vector<std::string> all = sources.all();
  const bool is_one_of_them = std::ranges::any_of(
      all, [&](const std::string& file) { return fs::path(file).filename() == log.filename(); });
  if (is_one_of_them) return log.parent_path();
  throw InputError(
      fmt::format("{}: the mapping's `sources` are {}: give one of them, or their folder",
                  log.string(), fmt::join(all, ", ")));
}

class JoinedFiles final : public JoinedSource {
 public:
  JoinedFiles(const fs::path& log, const LogSources& sources, LogNotes& notes)
      : JoinedSource(log, sources.stale_after, notes) {
    const fs::path folder = folder_of(log, sources);
    for (const auto& [section, files] : {std::pair("joints", &sources.joints),
                                         {"imu", &sources.imu},
                                         {"contact", &sources.contact}}) {
      for (const std::string& file : *files) {
        files_.push_back(open_file(folder / file, notes));
        names_.push_back(files_.back()->names().front());
        names_.back().section = section;
      }
    }
  }

  std::string place() const override {
    return fmt::format("{}: row {}", names_[clock()].file, position());
  }

 private:
  std::vector<SourceRows> read(const LogMapping& mapping) override {
    std::vector<SourceRows> rows(files_.size());
    for (std::size_t i = 0; i < files_.size(); ++i) {
      rows[i] = rows_of(*files_[i], mapping, mapping.clocks[i], columns()[i]);
      files_[i].reset();  // and its arrays
    }
    return rows;
  }

  std::vector<std::unique_ptr<RowSource>> files_;  ///< until they are read
};

}  // namespace

std::unique_ptr<RowSource> join_files(const fs::path& log, const LogSources& sources,
                                      LogNotes& notes) {
  return std::make_unique<JoinedFiles>(log, sources, notes);
}

}  // namespace touchdown::logs
