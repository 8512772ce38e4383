#include "recordings/mapping/clock_keys.hpp"

#include <string>

#include <fmt/format.h>

namespace touchdown::recordings {

namespace {

constexpr double shortest_period = 1e-6;  // s, the unit of recordings

/// One column, or whole seconds and nanoseconds as in the headers of ROS 2.
void describe_clock(Fields& fields, MappingReader& reader, SourceClock& clock) {
  const SignalKind time{
      "the time of each row", 1, {{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}};
  const bool has_parts = fields.present("sec", false) || fields.present("nanosec", false);
  if (!has_parts) {
    fields.know("sec");
    fields.know("nanosec");
  }
  if (!has_parts || fields.documenting()) reader.describe_signal(fields, time, clock.time);
  if (!has_parts) return;
  std::string sec;
  std::string nanosec;
  fields.require("sec", sec).fallback("none").doc("Column of whole seconds, instead of `from`.");
  fields.require("nanosec", nanosec).fallback("none").doc("Column of nanoseconds beside `sec`.");
  fields.finish();
  SignalKind part = time;
  part.names = {sec};
  reader.take_default(fields, "sec", part, clock.time);
  part.names = {nanosec};
  reader.take_default(fields, "nanosec", part, clock.nanosec.emplace());
}

/// The clock of each source: that of `time`, of its own section, or of a topic's messages.
void describe_clocks(Fields& fields, MappingReader& reader, LogMapping& mapping) {
  const YAML::Node imu = fields.node()["imu"];
  const bool imu_has_own = imu && imu.IsMap() && imu["time"];
  for (std::size_t i = 0; i < reader.sources().size(); ++i) {
    const SourceNames& source = reader.sources()[i];
    SourceClock& clock = mapping.clocks.emplace_back();
    if (source.section == "imu" && imu_has_own) continue;
    reader.enter_source(i);
    if (fields.present("time", false)) {
      fields.within("time", [&](Fields& inner) { describe_clock(inner, reader, clock); });
    } else {
      fields.check(source.is_topic, "time", "is missing: each source needs the time of its rows");
      SignalKind stamp{"the time of each message"};
      stamp.names = {"header.stamp"};
      reader.take_default(fields, "", stamp, clock.time);
    }
    reader.leave_source();
  }
}

}  // namespace

void describe_imu_clock(Fields& fields, MappingReader& reader, LogMapping& mapping) {
  if (!fields.present("time", false)) return;
  SourceClock unused;
  for (std::size_t i = 0; i < reader.sources().size(); ++i) {
    const bool is_imu = reader.sources()[i].section == "imu";
    fields.check(is_imu || reader.sources().size() > 1, "time",
                 "expected `sources`: rows of one file have one clock");
    if (!is_imu && !fields.documenting()) continue;
    reader.enter_source(i);
    fields
        .within("time",
                [&](Fields& inner) {
                  describe_clock(inner, reader, is_imu ? mapping.clocks[i] : unused);
                })
        .fallback("none")
        .doc("Clock of the IMU's source, if its columns differ from those of `time`.");
    reader.leave_source();
  }
}

void describe_time(Fields& fields, MappingReader& reader, LogMapping& mapping) {
  fields("period", mapping.period)
      .range(fmt::format("{} to {}", shortest_period, longest_period))
      .fallback("none")
      .doc("s", "Time between two rows, instead of `time`.");
  const bool has_period = fields.present("period", false);
  fields.check(
      !has_period || (mapping.period >= shortest_period && mapping.period <= longest_period),
      "period",
      fmt::format("expected the time between two rows (s), at most {} and at least {}",
                  longest_period, shortest_period));
  if (!reader.sources().front().section.empty()) {
    fields.check(!has_period, "period", "sources are joined by their times: expected 'time'");
    return describe_clocks(fields, reader, mapping);
  }
  if (fields.present("time", false)) {
    fields
        .within("time",
                [&](Fields& inner) { describe_clock(inner, reader, mapping.time.emplace()); })
        .fallback("none")
        .doc("Clock of the log, instead of `period`.");
  }
  fields.check(!has_period || !mapping.time, "period",
               "'time' already specifies when rows were logged");
  fields.check(has_period || mapping.time, "time", "is missing: expected 'time' or 'period'");
}

}  // namespace touchdown::recordings
