#include "cli/export/log.hpp"

#include <optional>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program/outputs.hpp"
#include "core/program/streams.hpp"
#include "core/progress.hpp"
#include "core/resources.hpp"
#include "experiments/logs/log_steps.hpp"
#include "experiments/logs/robot.hpp"
#include "recordings/log/mcap.hpp"
#include "recordings/log/recording_file.hpp"
#include "recordings/mapping/conversion.hpp"
#include "render/mcap/scene.hpp"
#include "render/pictures/filmed_run.hpp"

namespace touchdown::cli {

namespace {

void check_files(const ExportedLog& files) {
  require_extension(files.output, {".mpack"}, "a log");
  std::vector<std::filesystem::path> outputs = {files.output};
  if (!files.labels.empty()) outputs.emplace_back(files.labels);
  check_outputs({{files.log, "log"}, {files.mapping, "mapping"}}, outputs);
}

void check_stop(const CliSession& session) {
  if (*session.stop) throw Stopped("stopped; nothing was written");
}

/// Prints what is implausible about the signals of the written log, one line each. Returns their
/// number.
std::size_t report_findings(const ExportedLog& files, const CliSession& session) {
  recordings::LogReader reader(files.output, session.stop);
  std::vector<std::string> findings;
  try {
    experiments::LogSteps log(reader, nullptr, experiments::checked_robot({}, reader.info()));
    while (log.next() != nullptr) check_stop(session);
    findings = log.findings();
  } catch (const InputError& error) {
    findings = {error.what()};  // no estimator can read the log
  }
  for (const std::string& finding : findings) {
    print_message(fmt::format("touchdown: {}: {}\n", files.log, finding));
  }
  return findings.size();
}

/// Errors: `InputError` for a log without contact labels.
std::string labels_text(const ExportedLog& files, const recordings::ConvertedLog& log) {
  if (log.contact.intervals.empty()) {
    throw InputError(fmt::format(
        "--labels: {} has no contact labels: expected a section 'contact' in {}, and numbers",
        files.log, files.mapping));
  }
  return recordings::to_csv(log.contact);
}

/// A log with the robot to draw: the one of a recording, or the named one on flat ground. Nothing
/// for a log without either, and for a live stream.
std::optional<render::FilmedRun> drawable(const std::string& log, const std::string& robot,
                                          const recordings::RecordingInfo& info,
                                          const CliSession& session) {
  if (log == "-") return std::nullopt;
  std::vector<std::string> warnings;  // the reader of the log prints them
  if (!robot.empty()) {
    recordings::LogReader reader(log, session.stop);
    return render::FilmedRun{models::compile_robot_model(find_resource(robot), {}),
                             recordings::read_recording(reader, &warnings),
                             {},
                             {}};
  }
  if (info.scenario_yaml.empty()) return std::nullopt;
  return render::filmed_recording(log, warnings, session.stop);
}

}  // namespace

void export_log(const ExportedLog& files, const CliSession& session) {
  check_files(files);
  recordings::ConvertedLog log;
  write_stream_atomically(files.output, [&](std::ostream& stream) {
    log = recordings::convert_log(
        files.log, files.mapping, stream, [&] { check_stop(session); }, !files.labels.empty());
    stream.flush();  // labels only beside a whole log
    if (!stream) return;
    if (!files.labels.empty()) write_atomically(files.labels, labels_text(files, log));
  });
  for (const std::string& warning : recordings::warnings_of(log, files.log)) {
    print_message(fmt::format("touchdown: {}\n", warning));
  }
  const std::size_t findings = report_findings(files, session);
  print("log       {}, {} records, from {:.3f} to {:.3f} s of {}\n", files.output, log.rows,
        log.start, log.end, files.log);
  if (!files.labels.empty()) {
    print("labels    {}, {} intervals\n", files.labels, log.contact.intervals.size());
  }
  print("next      touchdown estimate {}{}\n", files.output,
        files.labels.empty() ? "" : fmt::format(" --labels {}", files.labels));
  if (files.is_strict && findings > 0) {
    throw Error(fmt::format("--strict: {} finding{} about the signals", findings,
                            findings == 1 ? "" : "s"));
  }
}

void export_mcap(const std::string& log, const std::string& robot, const std::string& output,
                 const CliSession& session) {
  check_outputs({{log, "log"}}, {output});
  recordings::LogReader reader(log, session.stop);
  std::uint64_t rows = 0;
  const std::optional<render::FilmedRun> run = drawable(log, robot, reader.info(), session);
  check_stop(session);
  write_stream_atomically(output, [&](std::ostream& stream) {
    rows = run ? render::write_mcap_with_scene(reader, stream, run->robot, run->recording)
               : recordings::write_mcap(reader, stream);
    check_stop(session);
  });
  for (const std::string& warning : reader.warnings())
    print_message(fmt::format("touchdown: {}\n", warning));
  print("log       {}, {} records, {:.1f} MB\n", output, rows,
        1e-6 * static_cast<double>(size_of_file(output)));
}

}  // namespace touchdown::cli
