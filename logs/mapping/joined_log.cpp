#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "logs/bags/bag.hpp"
#include "logs/bags/source_join.hpp"
#include "logs/bags/topic_rows.hpp"
#include "logs/mapping/source_log.hpp"

namespace touchdown::logs {

namespace {

namespace fs = std::filesystem;

/// Of a signal's numbers in the order of the sources, the position of each in the mapping's row.
class ColumnOrder {
 public:
  explicit ColumnOrder(const LogMapping& mapping, std::size_t sources) : of_source_(sources) {
    for (std::size_t i = 0; i < mapping.columns.size(); ++i) {
      of_source_[mapping.columns[i].source].push_back(i);
    }
    for (const auto& columns : of_source_)
      order_.insert(order_.end(), columns.begin(), columns.end());
    row_.resize(order_.size());
  }

  /// Positions in the mapping's row of the numbers of one source.
  const std::vector<std::size_t>& of(std::size_t source) const { return of_source_[source]; }
  std::vector<std::size_t> widths() const {
    std::vector<std::size_t> widths;
    for (const auto& columns : of_source_) widths.push_back(columns.size());
    return widths;
  }
  /// The mapping's row of a row that has the sources one after the other.
  std::span<const double> mapped(std::span<const double> joined) {
    for (std::size_t i = 0; i < order_.size(); ++i) row_[order_[i]] = joined[i];
    return row_;
  }

 private:
  std::vector<std::vector<std::size_t>> of_source_;
  std::vector<std::size_t> order_;
  std::vector<double> row_;
};

std::vector<SourceColumn> columns_of(const LogMapping& mapping, std::size_t source) {
  std::vector<SourceColumn> columns;
  for (const SourceColumn& column : mapping.columns) {
    if (column.source == source) columns.push_back(column);
  }
  return columns;
}

/// One line for each source that is held, and for rows that are left out.
std::vector<std::string> notes_of(const SourceJoin& join, const std::vector<SourceNames>& names,
                                  std::size_t clock, double stale_after) {
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i == clock) continue;
    const SourceJoin::Report& report = join.report(i);
    std::string note = fmt::format(
        "{}: held at the rows of {}, ages {:.1f} ms (median) to {:.1f} ms", names[i].file,
        names[clock].file, 1e3 * report.ages.median(), 1e3 * report.ages.largest());
    if (report.stale > 0) {
      note += fmt::format("; missing at {} of {} rows, where it is older than {:.0f} ms",
                          report.stale, join.rows(), 1e3 * stale_after);
    }
    notes.push_back(std::move(note));
  }
  if (join.rows_before() > 0) {
    notes.push_back(fmt::format("{}: {} rows before the first of the other sources are left out",
                                names[clock].file, join.rows_before()));
  }
  return notes;
}

/// Errors: `InputError` if no row was joined.
void check_joined(const SourceJoin& join, const std::vector<SourceNames>& names, std::size_t clock,
                  double stale_after, const fs::path& log) {
  if (join.rows() > 0) return;
  std::vector<std::string> spans;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const SourceJoin::Report& report = join.report(i);
    spans.push_back(report.rows == 0
                        ? fmt::format("{} has no rows with a time", names[i].file)
                        : fmt::format("{} has {} rows from {:.3f} to {:.3f} s", names[i].file,
                                      report.rows, report.first, report.last));
  }
  throw InputError(fmt::format(
      "{}: no row of {} has values of the other sources that are at most {:.0f} ms old: {}. Are "
      "their times of one clock and one unit?{}",
      log.string(), names[clock].file, 1e3 * stale_after, fmt::join(spans, ", "),
      names[clock].is_topic ? " `time: {from: log_time}` takes the times of recording" : ""));
}

// Files ------------------------------------------------------------------------------------------

/// A row of a file in memory.
struct FileRow {
  double arrival = 0.0;
  double time = 0.0;
  std::vector<double> numbers;
};

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

/// The files of the sources, in the folder of the log.
std::vector<SourceNames> named_files(const fs::path& log, const LogSources& sources) {
  const bool is_whole_folder = is_folder(log);
  const fs::path folder = is_whole_folder ? log : log.parent_path();
  std::vector<SourceNames> named;
  std::vector<std::string> all;
  const auto add = [&](const char* section, const std::vector<std::string>& files) {
    for (const std::string& file : files) {
      SourceNames& one = named.emplace_back();
      one.file = (folder / file).string();
      one.section = section;
      all.push_back(file);
    }
  };
  add("joints", sources.joints);
  add("imu", sources.imu);
  add("contact", sources.contact);
  const bool is_one_of_them = std::any_of(all.begin(), all.end(), [&](const std::string& file) {
    return fs::path(file).filename() == log.filename();
  });
  if (!is_whole_folder && !is_one_of_them) {
    throw InputError(
        fmt::format("{}: the mapping's `sources` are {}: give one of them, or their folder",
                    log.string(), fmt::join(all, ", ")));
  }
  return named;
}

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

/// The names of the file's columns.
SourceNames read_names(const SourceNames& named) {
  SourceNames result = named;
  read_source_log(named.file,
                  {.wanted = [&](const SourceNames& names) -> std::vector<SourceColumn> {
                     result.are_arrays = names.are_arrays;
                     result.names = names.names;
                     result.has_joint_names = names.has_joint_names;
                     return {};
                   },
                   .row = [](std::span<const double>, const SourceLocation&) {}});
  return result;
}

/// Reads the rows of one source of files, with their times.
void read_rows(const SourceNames& named, const LogMapping& mapping, std::size_t source,
               const ColumnOrder& order, const std::function<void(FileRow&&)>& use) {
  const std::vector<std::size_t>& positions = order.of(source);
  const SourceClock& clock = mapping.clocks[source];
  std::vector<double> mapped(mapping.columns.size());
  Arrival arrival;
  read_source_log(named.file,
                  {.wanted = [&](const SourceNames&) { return columns_of(mapping, source); },
                   .row =
                       [&](std::span<const double> row, const SourceLocation&) {
                         for (std::size_t i = 0; i < row.size(); ++i) mapped[positions[i]] = row[i];
                         const double time = clock.at(mapped);
                         if (!std::isfinite(time) || !has_numbers(row, clock, positions)) return;
                         use({arrival.next(time), time, {row.begin(), row.end()}});
                       }});
}

std::vector<std::string> read_joined_files(const fs::path& log, const LogSources& sources,
                                           const JoinedLogSink& sink) {
  std::vector<SourceNames> names = named_files(log, sources);
  for (SourceNames& one : names) one = read_names(one);
  const LogMapping& mapping = sink.mapping(names);
  const std::size_t clock = mapping.joint_source();
  ColumnOrder order(mapping, names.size());
  SourceJoin join({order.widths(), clock, sources.stale_after},
                  [&](std::span<const double> row, std::uint64_t position) {
                    sink.row(order.mapped(row), [&, position] {
                      return fmt::format("{}: row {}", names[clock].file, position);
                    });
                  });
  // The rows of the joints are streamed; those of the other files are numbers in memory.
  struct HeldFile {
    std::size_t source = 0;
    std::vector<FileRow> rows;
    std::size_t next = 0;
  };
  std::vector<HeldFile> held;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i == clock) continue;
    HeldFile& file = held.emplace_back(HeldFile{i, {}, 0});
    read_rows(names[i], mapping, i, order,
              [&](FileRow&& row) { file.rows.push_back(std::move(row)); });
  }
  const auto add_until = [&](double arrival) {
    while (true) {
      HeldFile* first = nullptr;
      for (HeldFile& file : held) {
        if (file.next == file.rows.size() || file.rows[file.next].arrival > arrival) continue;
        if (first == nullptr || file.rows[file.next].arrival < first->rows[first->next].arrival) {
          first = &file;
        }
      }
      if (first == nullptr) return;
      const FileRow& row = first->rows[first->next++];
      join.add(first->source, row.arrival, row.time, row.numbers, 0);
    }
  };
  std::uint64_t position = 0;
  read_rows(names[clock], mapping, clock, order, [&](FileRow&& row) {
    add_until(row.arrival);
    join.add(clock, row.arrival, row.time, row.numbers, ++position);
  });
  add_until(1e300);
  join.finish();
  check_joined(join, names, clock, sources.stale_after, log);
  return notes_of(join, names, clock, sources.stale_after);
}

// Bags -------------------------------------------------------------------------------------------

/// Topics in the order of their sections.
struct BagSources {
  std::vector<SourceNames> names;
  std::vector<SignalTopic> topics;
};

BagSources bag_sources(const fs::path& log, const LogSources& sources) {
  BagSources result;
  std::vector<std::string> names;
  const auto add = [&](const char* section, const std::vector<std::string>& topics) {
    for (const std::string& topic : topics) {
      names.push_back(topic);
      result.names.push_back({topic, false, {}, section, true, true});
    }
  };
  if (sources.empty()) {
    add("joints", {only_topic_of_type(log, joint_state_type)});
    add("imu", {only_topic_of_type(log, imu_type)});
  } else {
    add("joints", sources.joints);
    add("imu", sources.imu);
    add("contact", sources.contact);
  }
  result.topics = find_signal_topics(log, names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const SignalTopic& topic = result.topics[i];
    const bool is_imu = result.names[i].section == "imu";
    if ((topic.type == imu_type) != is_imu) {
      throw InputError(fmt::format("{}: `sources.{}`: topic {} has the type {}, expected {}",
                                   log.string(), result.names[i].section, topic.name, topic.type,
                                   is_imu ? imu_type : joint_state_type));
    }
    result.names[i].names = topic.columns();
  }
  return result;
}

/// Errors: `InputError` for a needed signal that a topic never gives.
void check_given(const fs::path& log, const LogMapping& mapping, const BagSources& bag) {
  for (const SourceColumn& column : mapping.columns) {
    const SignalTopic& topic = bag.topics[column.source];
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

std::vector<std::string> read_joined_bag(const fs::path& log, const LogSources& sources,
                                         const JoinedLogSink& sink) {
  BagSources bag = bag_sources(log, sources);
  const LogMapping& mapping = sink.mapping(bag.names);
  check_given(log, mapping, bag);
  const std::size_t clock = mapping.joint_source();
  ColumnOrder order(mapping, bag.names.size());
  SourceJoin join({order.widths(), clock, sources.stale_after}, [&](std::span<const double> row,
                                                                    std::uint64_t position) {
    sink.row(order.mapped(row), [&, position] {
      return fmt::format("{}: message {} of {}", log.string(), position, bag.names[clock].file);
    });
  });
  const bool lacks_stamps = std::any_of(bag.topics.begin(), bag.topics.end(),
                                        [](const SignalTopic& topic) { return !topic.has_stamps; });
  std::vector<TopicRows> rows;
  for (std::size_t i = 0; i < bag.topics.size(); ++i) {
    std::vector<std::string> columns;
    for (const SourceColumn& column : columns_of(mapping, i)) columns.push_back(column.name);
    rows.emplace_back(bag.topics[i], columns, TopicRows::Config{lacks_stamps, sources.stale_after});
  }
  BagReader reader(log, [&](std::string_view topic) {
    return std::any_of(bag.names.begin(), bag.names.end(),
                       [&](const SourceNames& one) { return one.file == topic; });
  });
  BagMessage message;
  double arrival = -1e300;
  std::vector<std::uint64_t> positions(rows.size());
  while (reader.next(message)) {
    const std::string& name = reader.topics()[message.topic].name;
    arrival = std::max(arrival, 1e-9 * static_cast<double>(message.time));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (bag.names[i].file != name) continue;
      ++positions[i];
      if (rows[i].update(message)) {
        join.add(i, arrival, rows[i].time(), rows[i].row(), positions[i]);
      }
    }
  }
  join.finish();
  check_joined(join, bag.names, clock, sources.stale_after, log);
  std::vector<std::string> notes = reader.notes();
  if (lacks_stamps) notes.emplace_back("stamps are zero: the times of recording are used instead");
  for (const TopicRows& one : rows) {
    if (one.malformed() > 0) {
      notes.push_back(fmt::format("{}: {} messages are left out, the first because {}",
                                  one.topic().name, one.malformed(), one.first_malformed()));
    }
    if (one.ages().count() > 0) {
      notes.push_back(
          fmt::format("{}: {} values that a message lacks are held from an earlier one, ages "
                      "{:.1f} ms (median) "
                      "to {:.1f} ms",
                      one.topic().name, one.ages().count(), 1e3 * one.ages().median(),
                      1e3 * one.ages().largest()));
    }
  }
  for (std::string& note : notes_of(join, bag.names, clock, sources.stale_after)) {
    notes.push_back(std::move(note));
  }
  return notes;
}

}  // namespace

std::vector<std::string> read_joined_log(const fs::path& log, const LogSources& sources,
                                         const JoinedLogSink& sink) {
  if (!is_there(log)) throw InputError(fmt::format("{}: no such file or folder", log.string()));
  if (sources.are_files()) return read_joined_files(log, sources, sink);
  if (is_bag(log)) return read_joined_bag(log, sources, sink);
  throw InputError(fmt::format(
      "{}: is no ROS 2 bag (a folder with .mcap or .db3 files, or such a file), but the mapping's "
      "`sources` are topics",
      log.string()));
}

}  // namespace touchdown::logs
