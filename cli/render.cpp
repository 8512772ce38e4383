#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "cli/belief_track.hpp"
#include "cli/verbs.hpp"
#include "experiments/progress.hpp"
#include "experiments/stopped.hpp"
#include "recordings/recording_file.hpp"

namespace touchdown {

namespace {

struct RenderFlags {
  std::string log;
  std::string output;
  VideoOptions video;
  std::string quality = "draft";
};

void render(const RenderFlags& flags, const Session& session) {
  std::vector<std::string> warnings;
  const Recording recording = read_recording(flags.log, &warnings);
  for (const std::string& warning : warnings) fmt::print(stderr, "touchdown: {}\n", warning);

  VideoOptions options = flags.video;
  options.quality = flags.quality == "page" ? VideoQuality::page : VideoQuality::draft;
  const double end = static_cast<double>(recording.steps()) * recording.period();
  const double shown = std::max(0.0, std::min(options.to, end) - options.from) / options.speed;
  VideoStatistics statistics;
  {
    Progress progress("filming", "frames", static_cast<std::int64_t>(shown * options.fps));
    options.progress = [&](int /*done*/, int /*of*/) {
      progress.advance();
      if (*session.stop) throw Stopped();
    };
    statistics = render_video(robot_of(recording), recording, {}, options, flags.output);
  }
  fmt::print("{}: {} frames, {:.1f} frames/s\n", flags.output, statistics.frames, statistics.fps());
}

}  // namespace

void add_render(CLI::App& program, Session& session) {
  CLI::App* verb = program.add_subcommand(
      "render",
      "touchdown render stairs.mpack -o stairs.mp4\n\n"
      "Films a simulated run: the robot on its terrain, contact and torques below it.");
  const auto flags = std::make_shared<RenderFlags>();
  verb->add_option("log", flags->log, "Recording of a simulated run")->required();
  verb->add_option("-o,--output", flags->output, "Video to write")
      ->type_name("FILE.mp4")
      ->required();
  verb->add_option("--from", flags->video.from, "Begin at this time of the run (s)");
  verb->add_option("--to", flags->video.to, "End at this time of the run (s)");
  verb->add_option("--speed", flags->video.speed, "0.1 is ten times slower than life")
      ->capture_default_str();
  verb->add_option("--fps", flags->video.fps, "Frames per second")->capture_default_str();
  verb->add_option("--width", flags->video.width, "Pixels")->capture_default_str();
  verb->add_option("--height", flags->video.height, "Pixels")->capture_default_str();
  verb->add_option("--quality", flags->quality, "draft, or page: anti-aliased and slower")
      ->check(CLI::IsMember({"draft", "page"}))
      ->capture_default_str();
  verb->add_option("--workers", flags->video.workers, "Processes that draw; 0: one per core");
  verb->callback(
      [flags, &session] { session.action = [flags, &session] { render(*flags, session); }; });
}

}  // namespace touchdown
