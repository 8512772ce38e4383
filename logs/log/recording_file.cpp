#include "logs/log/recording_file.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "logs/log/writer.hpp"

namespace touchdown::logs {

void write_recording(const Recording& recording, const std::filesystem::path& path) {
  const bool with_truth = !recording.truth.empty();
  if (recording.action.size() != recording.steps() ||
      (with_truth && recording.truth.size() != recording.steps())) {
    throw Error(fmt::format(
        "{}: the recording's columns differ in length: {} observations, {} "
        "actions, {} true states",
        path.string(), recording.steps(), recording.action.size(), recording.truth.size()));
  }
  write_stream_atomically(path, [&](std::ostream& file) {
    LogWriter writer(file, recording.info, truth_of(recording));
    for (std::size_t step = 0; step < recording.steps(); ++step) {
      writer.write(recording.observation[step], recording.action[step],
                   with_truth ? &recording.truth[step] : nullptr);
    }
    writer.finish();
  });
}

Recording read_recording(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  LogReader reader(path);
  return read_recording(reader, warnings);
}

Recording read_recording(LogReader& reader, std::vector<std::string>* warnings) {
  Recording recording;
  recording.info = reader.info();
  while (std::optional<LogRow> row = reader.next()) {
    recording.observation.push_back(row->observation);
    recording.action.push_back(row->action);
    if (row->truth) recording.truth.push_back(*row->truth);
  }
  if (recording.truth.size() != recording.steps()) recording.truth.clear();
  if (warnings != nullptr) {
    warnings->insert(warnings->end(), reader.warnings().begin(), reader.warnings().end());
  }
  return recording;
}

}  // namespace touchdown::logs
