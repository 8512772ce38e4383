#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "logs/bags/bag.hpp"
#include "logs/bags/source_join.hpp"
#include "logs/bags/topic_rows.hpp"
#include "logs/mapping/row_source.hpp"

namespace touchdown::logs {

namespace {

namespace fs = std::filesystem;

/// Several sources with clocks of their own, joined at the joints' clock.
class JoinedSource : public RowSource {
 public:
  std::span<const SourceNames> names() const final { return names_; }

  void select(const LogMapping& mapping) final {
    clock_ = mapping.joint_source();
    columns_.resize(names_.size());
    for (std::size_t i = 0; i < mapping.columns.size(); ++i) {
      columns_[mapping.columns[i].source].push_back(i);
    }
    join_.emplace(SourceJoin::Config{columns_, clock_, stale_after_});
    open(mapping);
  }

  bool next(std::vector<double>& row) final {
    while (!join_->pop(row)) {
      if (is_finished_) {
        require_joined();
        return false;
      }
      is_finished_ = !add_next(*join_);
      if (is_finished_) join_->finish();
    }
    return true;
  }

  /// One line for each source that is held, and for rows that are left out.
  std::vector<std::string> notes() const override {
    std::vector<std::string> notes;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (i == clock_) continue;
      const SourceJoin::Report& report = join_->report(i);
      std::string note = fmt::format(
          "{}: held at the rows of {}, ages {:.1f} ms (median) to {:.1f} ms", names_[i].file,
          names_[clock_].file, 1e3 * report.ages.median(), 1e3 * report.ages.largest());
      if (report.stale > 0) {
        note += fmt::format("; missing at {} of {} rows, where it is older than {:.0f} ms",
                            report.stale, join_->rows(), 1e3 * stale_after_);
      }
      notes.push_back(std::move(note));
    }
    if (join_->rows_before() > 0) {
      notes.push_back(fmt::format("{}: {} rows before the first of the other sources are left out",
                                  names_[clock_].file, join_->rows_before()));
    }
    return notes;
  }

 protected:
  JoinedSource(fs::path log, double stale_after)
      : log_(std::move(log)), stale_after_(stale_after) {}

  /// Called once, when the columns of each source are known.
  virtual void open(const LogMapping& mapping) = 0;
  /// Adds what was recorded next. Returns false at the end.
  virtual bool add_next(SourceJoin& join) = 0;

  /// Of each source, where its columns are in the mapping's rows.
  const std::vector<std::vector<std::size_t>>& columns() const { return columns_; }
  double stale_after() const { return stale_after_; }
  std::size_t clock() const { return clock_; }
  /// The number of the joints' row among those of its source, from 1.
  std::uint64_t position() const { return join_->position(); }

  fs::path log_;
  std::vector<SourceNames> names_;

 private:
  /// Errors: `InputError` if no row was joined.
  void require_joined() const {
    if (join_->rows() > 0) return;
    std::vector<std::string> spans;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const SourceJoin::Report& report = join_->report(i);
      spans.push_back(report.rows == 0
                          ? fmt::format("{} has no rows with a time", names_[i].file)
                          : fmt::format("{} has {} rows from {:.3f} to {:.3f} s", names_[i].file,
                                        report.rows, report.first, report.last));
    }
    throw InputError(fmt::format(
        "{}: no row of {} has values of the other sources that are at most {:.0f} ms old: {}. Are "
        "their times of one clock and one unit?{}",
        log_.string(), names_[clock_].file, 1e3 * stale_after_, fmt::join(spans, ", "),
        names_[clock_].is_topic ? " `time: {from: log_time}` takes the times of recording" : ""));
  }

  double stale_after_;
  std::vector<std::vector<std::size_t>> columns_;
  std::size_t clock_ = 0;
  std::optional<SourceJoin> join_;
  bool is_finished_ = false;
};

// Files ------------------------------------------------------------------------------------------

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
  for (std::size_t i = 0; i < all.size(); ++i) {
    const char* const section = i < sources.joints.size()                        ? "joints"
                                : i < sources.joints.size() + sources.imu.size() ? "imu"
                                                                                 : "contact";
    opened.emplace_back(open_file(folder / all[i], section, i));
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
    for (const TimedFile& file : files_) {
      for (std::string& note : file.notes()) notes.push_back(std::move(note));
    }
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

// Bags -------------------------------------------------------------------------------------------

/// Errors: `InputError` for a needed signal that a topic never gives.
void check_given(const fs::path& log, const LogMapping& mapping,
                 std::span<const SignalTopic> topics) {
  for (const SourceColumn& column : mapping.columns) {
    const SignalTopic& topic = topics[column.source];
    const auto complain = [&](const char* what, const char* remedy) {
      throw InputError(fmt::format("{}: {} is not given by the messages of {}: {}", log.string(),
                                   what, topic.name, remedy));
    };
    if (column.name.ends_with("/velocity") && !topic.has_velocity) {
      complain("velocity", "map a source that has velocities (rad/s)");
    }
    if (column.name.ends_with("/effort") && !topic.has_effort) {
      complain("effort", "estimators need the joints' torques (N·m); map a source that has them");
    }
    if (column.name.starts_with("orientation.") && !topic.has_orientation) {
      complain(
          "orientation",
          "its covariance begins with -1 or its quaternion is zero (REP 145); map a topic of a "
          "filter that estimates it, such as imu_filter_madgwick");
    }
  }
}

class JoinedBag final : public JoinedSource {
 public:
  JoinedBag(const fs::path& log, const LogSources& sources, const std::atomic<bool>* stop)
      : JoinedSource(log, sources.stale_after), stop_(stop) {
    if (sources.empty()) {
      add_topics("joints", {only_topic_of_type(log, joint_state_type, stop)});
      add_topics("imu", {only_topic_of_type(log, imu_type, stop)});
    } else {
      add_topics("joints", sources.joints);
      add_topics("imu", sources.imu);
      add_topics("contact", sources.contact);
    }
    std::vector<std::string> topics;
    for (const SourceNames& one : names_) topics.push_back(one.file);
    topics_ = find_signal_topics(log, topics, stop);
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const bool is_imu = names_[i].section == "imu";
      if ((topics_[i].type == imu_type) != is_imu) {
        throw InputError(fmt::format("{}: `sources.{}`: topic {} has the type {}, expected {}",
                                     log.string(), names_[i].section, topics_[i].name,
                                     topics_[i].type, is_imu ? imu_type : joint_state_type));
      }
      names_[i].names = topics_[i].columns();
    }
  }

  std::string place() const override {
    return fmt::format("{}: message {} of {}", log_.string(), position(), names_[clock()].file);
  }

  std::vector<std::string> notes() const override {
    std::vector<std::string> notes = reader_->notes();
    if (lacks_stamps_) {
      notes.emplace_back("stamps are zero: the times of recording are used instead");
    }
    for (std::size_t i = 0; i < topics_.size() && !lacks_stamps_ && !uses_log_time_; ++i) {
      for (std::string& note : clock_notes(topics_[i], topics_[clock()])) {
        notes.push_back(std::move(note));
      }
    }
    for (const TopicRows& one : rows_) {
      for (std::string& note : one.notes()) notes.push_back(std::move(note));
    }
    for (std::string& note : JoinedSource::notes()) notes.push_back(std::move(note));
    return notes;
  }

 private:
  void add_topics(const char* section, const std::vector<std::string>& topics) {
    for (const std::string& topic : topics) {
      names_.push_back({topic, false, {}, section, true, true});
    }
  }

  void open(const LogMapping& mapping) override {
    check_given(log_, mapping, topics_);
    uses_log_time_ = std::any_of(mapping.columns.begin(), mapping.columns.end(),
                                 [](const auto& one) { return one.name == log_time_column; });
    lacks_stamps_ = std::any_of(topics_.begin(), topics_.end(),
                                [](const SignalTopic& topic) { return !topic.has_stamps; });
    for (std::size_t i = 0; i < topics_.size(); ++i) {
      std::vector<std::string> wanted;
      for (const std::size_t column : columns()[i]) wanted.push_back(mapping.columns[column].name);
      rows_.emplace_back(topics_[i], wanted, TopicRows::Config{lacks_stamps_, stale_after()});
    }
    messages_.resize(rows_.size());
    const auto is_named = [this](std::string_view topic) {
      return std::ranges::any_of(names_, [&](const SourceNames& one) { return one.file == topic; });
    };
    reader_.emplace(log_, is_named, stop_);
  }

  bool add_next(SourceJoin& join) override {
    BagMessage message;
    if (!reader_->next(message)) return false;
    const std::string& name = reader_->topics()[message.topic].name;
    arrival_ = std::max(arrival_, 1e-9 * static_cast<double>(message.time));
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (names_[i].file != name) continue;
      ++messages_[i];
      if (rows_[i].update(message)) {
        join.add(i, arrival_, rows_[i].time(), rows_[i].row(), messages_[i]);
      }
    }
    return true;
  }

  const std::atomic<bool>* stop_;
  std::vector<SignalTopic> topics_;
  bool uses_log_time_ = false;
  bool lacks_stamps_ = false;
  std::vector<TopicRows> rows_;
  std::vector<std::uint64_t> messages_;  ///< of each topic so far
  std::optional<BagReader> reader_;
  double arrival_ = -1e300;
};

}  // namespace

std::unique_ptr<RowSource> open_rows(const fs::path& log, const LogSources& sources,
                                     const std::atomic<bool>* stop) {
  if (sources.empty() && !is_bag(log)) return open_file(log);
  if (!is_there(log)) throw InputError(fmt::format("{}: no such file or folder", log.string()));
  if (sources.are_files()) return std::make_unique<JoinedFiles>(log, sources);
  if (is_bag(log)) return std::make_unique<JoinedBag>(log, sources, stop);
  throw InputError(fmt::format(
      "{}: is no ROS 2 bag (a folder with .mcap or .db3 files, or such a file), but the mapping's "
      "`sources` are topics",
      log.string()));
}

}  // namespace touchdown::logs
