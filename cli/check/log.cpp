#include "cli/check/log.hpp"

#include <optional>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/program/streams.hpp"
#include "core/progress.hpp"
#include "experiments/logs/log_steps.hpp"
#include "recordings/log/byte_source.hpp"
#include "recordings/log/reader.hpp"
#include "recordings/mapping/conversion.hpp"

namespace touchdown::cli {

namespace {

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    print_message(fmt::format("touchdown: {}\n", warning));
  }
}

}  // namespace

std::size_t check_log(const std::string& path, const std::string& mapping,
                      const experiments::LogRobot& robot, const CliSession& session) {
  std::optional<recordings::MappedLog> mapped;
  if (!mapping.empty()) {
    mapped.emplace(path, mapping, [&] {
      if (*session.stop) throw Stopped("stopped");
    });
    print_warnings(mapped->warnings());
  }
  recordings::LogReader reader(
      recordings::file_source(mapped ? mapped->path() : std::filesystem::path(path), session.stop),
      path == "-" ? "standard input" : path);
  experiments::LogSteps log(reader, nullptr, experiments::checked_robot(robot, reader.info()));
  std::int64_t steps = 0;
  double last = 0.0;
  while (const experiments::LogStep* step = log.next()) {
    ++steps;
    last = step->signals.time;
  }
  if (*session.stop) throw Stopped("stopped");
  print_warnings(reader.warnings());
  const std::vector<std::string> findings = log.findings();
  std::string text =
      fmt::format("{}: {} records at {:.6g} Hz, up to {:.3f} s: {}\n", reader.name(), steps,
                  log.sample_rate(), last, findings.empty() ? "plausible" : "check it");
  for (const std::string& finding : findings) text += fmt::format("  {}\n", finding);
  print(text);
  return findings.size();
}

}  // namespace touchdown::cli
