#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>

#include <fmt/format.h>

#include "apps/cli/verb.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "experiments/results/result_files.hpp"
#include "experiments/run_directory/lock.hpp"
#include "render/film/video.hpp"
#include "render/report/filmed_run.hpp"

namespace touchdown::cli {

namespace {

struct RenderFlags {
  std::vector<std::string> inputs;
  std::string output;
  render::VideoOptions video;
  std::string quality = "draft";
  std::string layout;
  bool poster = false;
  bool scene = false;
};

/// The recordings, and the input files of films in run directories.
std::vector<InputFile> files_of(const std::vector<std::string>& inputs) {
  std::vector<InputFile> files;
  for (const std::string& input : inputs) {
    files.push_back({input, "recording"});
    const std::filesystem::path directory = input;
    files.push_back({directory / "config.yaml", "run's config.yaml"});
    for (const char* const folder : {"recordings", "models"}) {
      for (const std::filesystem::path& entry : entries_in(directory / folder)) {
        files.push_back({entry, "run's own file"});
      }
    }
  }
  return files;
}

/// The runs to show: one, or two side by side.
std::vector<render::FilmedRun> runs_of(const RenderFlags& flags, const CliSession& session) {
  std::vector<render::FilmedRun> runs;
  std::vector<std::string> warnings;
  for (const std::string& input : flags.inputs) {
    if (!is_folder(input)) {
      runs.push_back(render::filmed_recording(input, warnings, session.stop));
      continue;
    }
    const auto lock = experiments::DirectoryLock::for_reading(input, session.command);
    std::ranges::move(experiments::config_warnings(input), std::back_inserter(warnings));
    std::vector<render::FilmedRun> filmed = render::filmed_runs(render::read_subject(input));
    if (filmed.empty()) {
      throw InputError(fmt::format("{}: has no recording of the run that it films", input));
    }
    const bool beside = flags.layout == "side-by-side" && flags.inputs.size() == 1;
    for (std::size_t i = 0; i < (beside ? filmed.size() : 1); ++i) {
      runs.push_back(std::move(filmed[i]));
    }
  }
  print_warnings(warnings);
  const std::size_t wanted = flags.layout == "side-by-side" || flags.inputs.size() > 1 ? 2 : 1;
  if (runs.size() != wanted || (flags.layout == "single" && wanted != 1)) {
    throw InputError(fmt::format("render: layout '{}' shows {}, not {}",
                                 flags.layout.empty() ? "side-by-side" : flags.layout,
                                 flags.layout == "single" ? "one run" : "two runs", runs.size()));
  }
  return runs;
}

void draw(const RenderFlags& flags, const CliSession& session) {
  check_outputs(files_of(flags.inputs), {flags.output});
  if (flags.scene || flags.poster) {
    require_extension(flags.output, {".png", ".jpg"}, "a picture");
  } else {
    require_extension(flags.output, {".mp4"}, "a film");
  }
  const std::vector<render::FilmedRun> runs = runs_of(flags, session);
  render::VideoOptions options = flags.video;
  options.quality =
      flags.quality == "page" ? render::VideoQuality::page : render::VideoQuality::draft;
  options.labels = runs.front().labels;
  std::vector<render::VideoSource> sources;
  for (const render::FilmedRun& run : runs) sources.push_back(run.source());
  const double moment = options.from != 0.0 ? options.from : NAN;
  if (flags.scene) {
    render::render_scene(runs[0].robot, runs[0].recording, options, moment, flags.output);
  } else if (flags.poster) {
    render::render_poster(sources, options, moment, flags.output);
  }
  if (flags.scene || flags.poster) return print("{}\n", flags.output);
  options.progress = render::film_progress("filming", session.stop);
  const render::VideoStatistics statistics = render::render_video(sources, options, flags.output);
  print("{}: {} frames, {:.1f} frames/s\n", flags.output, statistics.frames, statistics.fps());
}

void render(const RenderFlags& flags, const CliSession& session) {
  try {
    draw(flags, session);
  } catch (const Stopped&) {
    throw Stopped("stopped; nothing was written");
  }
}

}  // namespace

void add_render(CLI::App& program, const CliSession& session) {
  Verb verb(
      program, "render",
      "touchdown render stairs.mpack -o stairs.mp4\n\n"
      "Renders a video of a simulated run: the robot on its terrain, contact and torques below.\n"
      "For a run directory it renders the run that the experiment films, with the beliefs of\n"
      "its estimators.");
  const auto flags = std::make_shared<RenderFlags>();
  verb.option(
          "input", &flags->inputs,
          "Recording of a simulated run, or an experiment's run directory. Two inputs are shown "
          "side by side")
      .required()
      .takes(1, 2);
  verb.option("-o,--output", &flags->output, "Video to write, or picture with --poster or --scene")
      .value_name("FILE.mp4")
      .required();
  verb.option("--layout", &flags->layout,
              "single, or side-by-side for two runs or both engines of a run directory")
      .one_of({"single", "side-by-side"});
  verb.option("--from", &flags->video.from, "Start time within the run (s)");
  verb.option("--to", &flags->video.to, "End time within the run (s)");
  verb.option("--speed", &flags->video.speed,
              "Playback speed: 0.1 is ten times slower than real time")
      .shows_default();
  verb.option("--fps", &flags->video.fps, "Frames per second").shows_default();
  verb.option("--width", &flags->video.width, "Width (pixels)").shows_default();
  verb.option("--height", &flags->video.height, "Height (pixels)").shows_default();
  verb.option("--quality", &flags->quality, "draft, or page, which is anti-aliased and slower")
      .one_of({"draft", "page"})
      .shows_default();
  verb.flag("--poster", &flags->poster,
            "One picture (.png or .jpg) at --from, or in the first flight without --from");
  verb.flag("--scene", &flags->scene, "Like --poster for one run, but without labels and plots");
  verb.option("--workers", &flags->video.workers,
              "Number of rendering processes; 0 means one per core");
  verb.action([flags, &session] { render(*flags, session); });
}

}  // namespace touchdown::cli
