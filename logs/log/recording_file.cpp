#include "logs/log/recording_file.hpp"

#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "logs/log/writer.hpp"

namespace touchdown::logs {

namespace {

class RecordedRows final : public RecordSource {
 public:
  RecordedRows(std::shared_ptr<const Recording> recording, const std::atomic<bool>* stop)
      : RecordSource(stop),
        recording_(std::move(recording)),
        present_(written_values(truth_of(*recording_))) {}

  bool next() override {
    const bool is_stopped = notes().stop != nullptr && *notes().stop;
    if (next_ == recording_->steps() || is_stopped) return false;
    values_ = to_values(recording_->observation[next_], recording_->action[next_],
                        recording_->truth.empty() ? nullptr : &recording_->truth[next_]);
    ++next_;
    return true;
  }
  const LogValues& values() const override { return values_; }
  const LogPresence& present() const override { return present_; }
  std::string_view bytes() const override { return {}; }
  void read_origin(std::optional<RecordingInfo>& info, std::string& /*robot*/) const override {
    info = recording_->info;
  }

 private:
  std::shared_ptr<const Recording> recording_;
  LogPresence present_;
  LogValues values_{};
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<RecordSource> records_of(std::shared_ptr<const Recording> recording,
                                         const std::atomic<bool>* stop) {
  return std::make_unique<RecordedRows>(std::move(recording), stop);
}

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
    for (std::string& warning : reader.warnings()) warnings->push_back(std::move(warning));
  }
  return recording;
}

}  // namespace touchdown::logs
