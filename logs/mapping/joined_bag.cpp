#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "logs/bags/bag.hpp"
#include "logs/bags/topic_rows.hpp"
#include "logs/mapping/joined_source.hpp"

namespace touchdown::logs {

namespace {

namespace fs = std::filesystem;

/// Errors: `InputError` for a needed signal that a topic never gives.
void check_given(const fs::path& log, const LogMapping& mapping,
                 std::span<const SignalTopic> topics) {
  for (const SourceColumn& column : mapping.columns) {
    const SignalTopic& topic = topics[column.source];
    const auto complain = [&](const char* what, const char* remedy) {
      throw InputError(fmt::format("{}: {} is not given by the messages of {}: {}", log.string(),
                                   what, topic.name, remedy));
    };
    const auto is_of = [&](const std::string& list) {
      return topic.type == joint_state_type &&
             (column.name.ends_with("/" + list) || column.name.starts_with(list + "["));
    };
    if (is_of("velocity") && !topic.has_velocity) {
      complain("velocity", "map a source that has velocities (rad/s)");
    }
    if (is_of("effort") && !topic.has_effort) {
      complain("effort", "estimators need the joints' torques (N·m); map a source that has them");
    }
    if (topic.type == imu_type && column.name.starts_with("orientation.") &&
        !topic.has_orientation) {
      complain(
          "orientation",
          "its covariance begins with -1 or its quaternion is zero (REP 145); map a topic of a "
          "filter that estimates it, such as imu_filter_madgwick");
    }
  }
}

class JoinedBag final : public JoinedSource {
 public:
  JoinedBag(const fs::path& log, const LogSources& sources, LogNotes& notes)
      : JoinedSource(log, sources.stale_after, notes) {
    const auto named = [&](const std::vector<std::string>& topics, const char* type) {
      return topics.empty() ? std::vector{only_topic_of_type(log, type, notes.stop)} : topics;
    };
    add_topics("joints", named(sources.joints, joint_state_type));
    add_topics("imu", named(sources.imu, imu_type));
    add_topics("contact", sources.contact);
    std::vector<std::string> topics;
    for (const SourceNames& one : names_) topics.push_back(one.file);
    topics_ = find_signal_topics(log, topics, notes.stop);
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const bool is_imu = names_[i].section == "imu";
      if (topics_[i].type == (is_imu ? joint_state_type : imu_type)) {
        throw InputError(fmt::format("{}: `sources.{}`: topic {} has the type {}, expected {}",
                                     log.string(), names_[i].section, topics_[i].name,
                                     topics_[i].type, is_imu ? imu_type : joint_state_type));
      }
      names_[i].names = topics_[i].columns();
      names_[i].is_imu = topics_[i].type == imu_type;
      names_[i].has_joint_names = !topics_[i].joints.empty();
    }
  }

  std::string place() const override {
    return fmt::format("{}: message {} of {}", log_.string(), position(), names_[clock()].file);
  }

 private:
  std::vector<std::string> clock_notes() const override {
    std::vector<std::string> notes;
    for (std::size_t i = 0; i < topics_.size() && uses_stamps_; ++i) {
      std::ranges::move(logs::clock_notes(topics_[i], topics_[clock()]), back_inserter(notes));
    }
    return notes;
  }

  void add_topics(const char* section, const std::vector<std::string>& topics) {
    for (const std::string& topic : topics) {
      names_.push_back({.file = topic, .names = {}, .section = section, .is_topic = true});
    }
  }

  std::vector<SourceRows> read(const LogMapping& mapping) override {
    check_given(log_, mapping, topics_);
    const bool uses_log_time = std::ranges::find(mapping.columns, log_time_column,
                                                 &SourceColumn::name) != mapping.columns.end();
    const bool lacks_stamps = std::ranges::any_of(
        topics_, [](const SignalTopic& topic) { return topic.stamp_delays.empty(); });
    uses_stamps_ = !lacks_stamps && !uses_log_time;
    std::vector<TopicRows> topics;
    for (std::size_t i = 0; i < topics_.size(); ++i) {
      std::vector<TopicColumn> wanted;
      for (const std::size_t k : columns()[i]) {
        wanted.push_back({mapping.columns[k].name, mapping.columns[k].is_rest});
      }
      topics.emplace_back(topics_[i], wanted, TopicRows::Config{lacks_stamps, stale_after()});
    }
    const auto is_named = [this](std::string_view topic) {
      return std::ranges::find(names_, topic, &SourceNames::file) != names_.end();
    };
    BagReader reader(log_, is_named, notes().stop);
    std::vector<SourceRows> all(topics.size());
    std::vector<std::uint64_t> messages(topics.size());
    std::vector<double> mapped(mapping.columns.size());
    BagMessage message;
    while (reader.next(message)) {
      const std::string& name = reader.topics()[message.topic].name;
      for (std::size_t i = 0; i < topics.size(); ++i) {
        if (names_[i].file != name) continue;
        ++messages[i];
        if (!topics[i].update(message)) continue;
        const std::span<const double> row = topics[i].row();
        for (std::size_t k = 0; k < row.size(); ++k) mapped[columns()[i][k]] = row[k];
        all[i].add(1e-9 * static_cast<double>(message.time), mapping.clocks[i].at(mapped), row,
                   messages[i]);
      }
    }
    std::ranges::copy(reader.notes(), back_inserter(notes().warnings));
    if (lacks_stamps) {
      notes().warnings.emplace_back(
          "stamps are zero or missing: the times of recording are used instead");
    }
    std::ranges::move(clock_notes(), back_inserter(notes().warnings));
    for (const TopicRows& one : topics) one.add_to(notes());
    return all;
  }

  std::vector<SignalTopic> topics_;
  bool uses_stamps_ = false;  ///< of all topics, as their clock
};

}  // namespace

std::unique_ptr<RowSource> open_rows(const fs::path& log, const LogSources& sources,
                                     LogNotes& notes) {
  if (extension_of(log) == ".mpack" && is_there(log)) {
    throw InputError(fmt::format("{}: a log in Upkie's layout needs no mapping", log.string()));
  }
  if (sources.empty() && !is_bag(log)) return open_file(log, notes);
  if (!is_there(log)) throw InputError(fmt::format("{}: no such file or folder", log.string()));
  if (sources.are_files()) return join_files(log, sources, notes);
  if (is_bag(log)) return std::make_unique<JoinedBag>(log, sources, notes);
  throw InputError(fmt::format(
      "{}: is no ROS 2 bag (a folder with .mcap or .db3 files, or such a file), but the mapping's "
      "`sources` are topics",
      log.string()));
}

}  // namespace touchdown::logs
