#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "logs/mapping/joined_source.hpp"

namespace touchdown::logs {

namespace {

namespace fs = std::filesystem;

/// Times that never decrease: a step back of the clock, as of a simulation that starts again, is
/// left out, so that the rows of all files before it come before those behind it.
class Arrival {
 public:
  double next(double time) {
    if (time + shift_ < latest_ - SourceJoin::largest_disorder) shift_ = latest_ - time;
    latest_ = std::max(latest_, time + shift_);
    return latest_;
  }

 private:
  double shift_ = 0.0;
  double latest_ = -1e300;
};

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

/// The rows of one file, with their times.
class TimedFile {
 public:
  explicit TimedFile(std::unique_ptr<RowSource> rows) : rows_(std::move(rows)) {}

  const SourceNames& names() const { return rows_->names().front(); }
  std::vector<std::string> notes() const { return rows_->notes(); }

  void open(const LogMapping& mapping, const SourceClock& clock,
            const std::vector<std::size_t>& columns) {
    rows_->select(mapping);
    clock_ = clock;
    columns_ = columns;
    mapped_.resize(mapping.columns.size());
    proceed();
  }
  bool is_at_end() const { return is_at_end_; }
  double arrival() const { return arrival_; }
  std::uint64_t position() const { return position_; }

  /// Adds the present row, and proceeds to the next one.
  void add_to(SourceJoin& join, std::size_t source) {
    join.add(source, arrival_, time_, row_, position_);
    proceed();
  }

 private:
  void proceed() {
    while (rows_->next(row_)) {
      for (std::size_t i = 0; i < row_.size(); ++i) mapped_[columns_[i]] = row_[i];
      time_ = clock_.at(mapped_);
      if (!std::isfinite(time_) || !has_numbers(row_, clock_, columns_)) continue;
      arrival_ = arrivals_.next(time_);
      ++position_;
      return;
    }
    is_at_end_ = true;
  }

  std::unique_ptr<RowSource> rows_;
  SourceClock clock_;
  std::vector<std::size_t> columns_;
  std::vector<double> mapped_;
  std::vector<double> row_;
  Arrival arrivals_;
  double arrival_ = 0.0;
  double time_ = 0.0;
  std::uint64_t position_ = 0;
  bool is_at_end_ = false;
};

/// The files of the sources, in the folder of the log.
std::vector<TimedFile> files_of(const fs::path& log, const LogSources& sources) {
  const bool is_whole_folder = is_folder(log);
  const fs::path folder = is_whole_folder ? log : log.parent_path();
  std::vector<std::string> all = sources.joints;
  all.insert(all.end(), sources.imu.begin(), sources.imu.end());
  all.insert(all.end(), sources.contact.begin(), sources.contact.end());
  const bool is_one_of_them = std::ranges::any_of(
      all, [&](const std::string& file) { return fs::path(file).filename() == log.filename(); });
  if (!is_whole_folder && !is_one_of_them) {
    throw InputError(
        fmt::format("{}: the mapping's `sources` are {}: give one of them, or their folder",
                    log.string(), fmt::join(all, ", ")));
  }
  std::vector<TimedFile> opened;
  for (const auto& [section, files] : {std::pair("joints", &sources.joints),
                                       {"imu", &sources.imu},
                                       {"contact", &sources.contact}}) {
    for (const std::string& file : *files) {
      opened.emplace_back(open_file(folder / file, section, opened.size()));
    }
  }
  return opened;
}

class JoinedFiles final : public JoinedSource {
 public:
  JoinedFiles(const fs::path& log, const LogSources& sources)
      : JoinedSource(log, sources.stale_after), files_(files_of(log, sources)) {
    for (const TimedFile& file : files_) names_.push_back(file.names());
  }

  std::string place() const override {
    return fmt::format("{}: row {}", names_[clock()].file, position());
  }
  std::vector<std::string> notes() const override {
    std::vector<std::string> notes = JoinedSource::notes();
    for (const TimedFile& file : files_) std::ranges::move(file.notes(), back_inserter(notes));
    return notes;
  }

 private:
  void open(const LogMapping& mapping) override {
    for (std::size_t i = 0; i < files_.size(); ++i) {
      files_[i].open(mapping, mapping.clocks[i], columns()[i]);
    }
  }

  /// Adds the earliest row of all files; of several, that of the joints comes last.
  bool add_next(SourceJoin& join) override {
    std::size_t earliest = clock();
    for (std::size_t i = 0; i < files_.size(); ++i) {
      if (files_[i].is_at_end() || i == clock()) continue;
      const TimedFile& before = files_[earliest];
      const bool is_earlier = earliest == clock() ? files_[i].arrival() <= before.arrival()
                                                  : files_[i].arrival() < before.arrival();
      if (before.is_at_end() || is_earlier) earliest = i;
    }
    if (files_[earliest].is_at_end()) return false;
    files_[earliest].add_to(join, earliest);
    return true;
  }

  std::vector<TimedFile> files_;
};

}  // namespace

std::unique_ptr<RowSource> join_files(const fs::path& log, const LogSources& sources) {
  return std::make_unique<JoinedFiles>(log, sources);
}

}  // namespace touchdown::logs
