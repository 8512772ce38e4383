#include "render/film/video.hpp"

#include <cstring>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/film/painter.hpp"
#include "tests/render/staged_run.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class Video : public ::testing::Test {
 protected:
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::recursive_directory_iterator(folder_), {}));
  }

  /// A hash of every frame that the encoder would receive.
  std::vector<std::size_t> frame_hashes(int workers, VideoQuality quality) const {
    const VideoSource source{robot_, run_, beliefs_};
    VideoOptions options = {{.width = 320, .height = 180}};
    options.quality = quality;
    std::vector<std::size_t> hashes;
    constexpr std::size_t bytes = std::size_t{320} * 180 * 3;
    paint_in_order(
        9, bytes, workers,
        [&]() -> PaintFrame {
          auto painter = std::make_shared<FramePainter>(std::vector<VideoSource>{source}, options);
          return [painter](int frame, std::uint8_t* pixels) {
            std::memcpy(pixels, painter->paint(1.9 + frame / 15.0).data, bytes);
          };
        },
        [&](int, const std::uint8_t* pixels) {
          hashes.push_back(
              std::hash<std::string_view>{}({reinterpret_cast<const char*>(pixels), bytes}));
        });
    return hashes;
  }

  const models::RobotModel robot_ = models::compile_robot_model(upkie_mjcf, staged_terrain());
  const logs::Recording run_ = staged_run(3.0);
  const std::vector<BeliefTrack> beliefs_ = {staged_beliefs(run_, "robust"),
                                             staged_beliefs(run_, "paper", 2, 0.01f)};
  const VideoOptions small_ = {{.width = 320, .height = 180}, VideoQuality::draft, 1.9, 2.3};
  const ScratchFolder scratch_;
  const std::filesystem::path folder_ = scratch_.path();
};

TEST_F(Video, FramesDoNotDependOnTheNumberOfWorkers) {
  for (const VideoQuality quality : {VideoQuality::draft, VideoQuality::page}) {
    const auto one = frame_hashes(1, quality);
    EXPECT_EQ(one.size(), 9u);
    EXPECT_NE(one.front(), one.back());
    EXPECT_EQ(frame_hashes(2, quality), one);
    EXPECT_EQ(frame_hashes(4, quality), one);
  }
}

TEST_F(Video, IsAnMp4WithItsIndexInFrontAndTheSameBytesEveryTime) {
  const VideoStatistics statistics =
      render_video({{robot_, run_, beliefs_}}, small_, folder_ / "a.mp4");
  EXPECT_EQ(statistics.frames, 13);
  render_video({{robot_, run_, beliefs_}}, small_, folder_ / "deep/b.mp4");
  const std::string a = read_file(folder_ / "a.mp4");
  EXPECT_TRUE(a == read_file(folder_ / "deep/b.mp4"));
  EXPECT_EQ(a.substr(4, 4), "ftyp");
  EXPECT_LT(a.find("moov"), a.find("mdat"));
  EXPECT_NE(a.find("avc1"), std::string::npos);
  EXPECT_EQ(files(), 3u);  // a.mp4, deep, deep/b.mp4
}

TEST_F(Video, SlowMotionHasMoreFrames) {
  VideoOptions slow = small_;
  slow.speed = 0.25;
  EXPECT_EQ(render_video({{robot_, run_, beliefs_}}, slow, folder_ / "slow.mp4").frames, 49);
}

TEST_F(Video, SideBySideLastsAsLongAsTheLongerRun) {
  const logs::Recording shorter = staged_run(1.0, "bullet");
  const std::vector<BeliefTrack> beliefs = {staged_beliefs(shorter, "robust")};
  VideoOptions options = small_;
  options.from = 0.5;
  options.to = std::numeric_limits<double>::infinity();
  options.fps = 10;
  EXPECT_EQ(render_video({{robot_, run_, beliefs_}, {robot_, shorter, beliefs}}, options,
                         folder_ / "both.mp4")
                .frames,
            26);
}

TEST_F(Video, FourRunsStandInRowsOfTwo) {
  const VideoSource source{robot_, run_, beliefs_};
  const logs::Recording later = staged_run(2.0);  // waits at its end
  const std::vector<BeliefTrack> no_beliefs;
  const VideoSource waiting{robot_, later, no_beliefs};
  FramePainter painter({source, waiting, source, source}, {{.width = 320, .height = 180}}, false);
  const cv::Mat picture = painter.paint(2.6).clone();
  const auto quarter = [&](int column, int row) {
    return picture(cv::Rect(4 + 160 * column, 4 + 90 * row, 150, 80)).clone();  // not the lines
  };
  EXPECT_LE(cv::norm(quarter(0, 0), quarter(0, 1), cv::NORM_INF), 2.0);
  EXPECT_LE(cv::norm(quarter(0, 0), quarter(1, 1), cv::NORM_INF), 2.0);
  EXPECT_GT(cv::norm(quarter(0, 0), quarter(1, 0), cv::NORM_INF), 50.0);
}

TEST_F(Video, ARobotsLogWithoutGroundTruthCanBeFilmed) {
  logs::Recording log = run_;
  log.truth.clear();
  log.info.simulator.clear();
  EXPECT_GT(render_video({{robot_, log, {}}}, small_, folder_ / "log.mp4").frames, 0);
}

TEST_F(Video, ADivergedRunCanBeFilmed) {
  logs::Recording diverged = run_;
  for (std::size_t k = 2000; k < diverged.steps(); ++k) {
    diverged.truth[k].base_position.x() = std::numeric_limits<double>::quiet_NaN();
    diverged.truth[k].base_orientation.coeffs().setConstant(std::nan(""));
    for (models::ServoReading& servo : diverged.observation[k].servo) servo.position = std::nan("");
  }
  diverged.info.outcome = logs::Outcome::diverged;
  EXPECT_GT(render_video({{robot_, diverged, {}}}, small_, folder_ / "nan.mp4").frames, 0);
}

TEST_F(Video, UnwritablePathsAreRefusedBeforeAnythingIsPainted) {
  std::ofstream(folder_ / "file") << "in the way";
  EXPECT_THAT(
      [&] {
        render_video({{robot_, run_, {}}}, small_, folder_ / "file/video.mp4");
      },
      ThrowsMessage<Error>(HasSubstr("cannot be written")));
  EXPECT_THAT(
      [&] {
        render_video({{robot_, run_, {}}}, small_, folder_);
      },
      ThrowsMessage<Error>(HasSubstr("cannot be written")));
  EXPECT_EQ(files(), 1u);
}

TEST_F(Video, WrongRequestsAreNamed) {
  const auto complaint = [&](const VideoOptions& options) {
    return [this, options] { render_video({{robot_, run_, {}}}, options, folder_ / "x.mp4"); };
  };
  VideoOptions odd = small_;
  odd.width = 321;
  EXPECT_THAT(complaint(odd), ThrowsMessage<InputError>(HasSubstr("even")));
  VideoOptions backwards = small_;
  backwards.speed = -1.0;
  EXPECT_THAT(complaint(backwards), ThrowsMessage<InputError>(HasSubstr("speed")));
  VideoOptions beyond_end = small_;
  beyond_end.from = 100.0;
  beyond_end.to = 101.0;
  EXPECT_THAT(complaint(beyond_end), ThrowsMessage<InputError>(HasSubstr("3.000 s")));
  std::vector<BeliefTrack> mismatched = beliefs_;
  mismatched[0].p_contact[0].pop_back();
  EXPECT_THAT(
      [&] {
        render_video({{robot_, run_, mismatched}}, small_, folder_ / "x.mp4");
      },
      ThrowsMessage<InputError>(HasSubstr("robust")));
  EXPECT_THAT(
      [&] {
        render_video({{robot_, logs::Recording{}, {}}}, small_, folder_ / "x.mp4");
      },
      ThrowsMessage<InputError>(HasSubstr("empty")));
  EXPECT_EQ(files(), 0u);
}

TEST_F(Video, InterruptedByTheCallerLeavesNothing) {
  VideoOptions options = small_;
  options.progress = [](int done, int) {
    if (done == 4) throw Error("stop");
  };
  EXPECT_THROW(render_video({{robot_, run_, beliefs_}}, options, folder_ / "x.mp4"), Error);
  EXPECT_EQ(files(), 0u);
}

/// Compares the mean absolute difference per channel between a picture and its golden copy, both
/// slightly blurred: another library version may shift text and edges by a fraction of a pixel.
TEST_F(Video, PosterLooksLikeItsGoldenCopy) {
  const std::filesystem::path golden =
      std::filesystem::path(TOUCHDOWN_SOURCE_DIR) / "tests/render/film/golden_poster.png";
  const VideoOptions options = {{.width = 640, .height = 360}};
  const std::filesystem::path path = folder_ / "poster.png";
  render_poster({{robot_, run_, beliefs_}}, options, std::nan(""), path);
  if (std::getenv("TOUCHDOWN_UPDATE_GOLDEN"))
    std::filesystem::copy_file(path, golden, std::filesystem::copy_options::overwrite_existing);
  const cv::Mat now = cv::imread(path.string());
  const cv::Mat then = cv::imread(golden.string());
  ASSERT_EQ(now.size(), then.size());
  cv::Mat a, b, difference;
  cv::GaussianBlur(now, a, {5, 5}, 0);
  cv::GaussianBlur(then, b, {5, 5}, 0);
  cv::absdiff(a, b, difference);
  const cv::Scalar mean = cv::mean(difference);
  EXPECT_LT(std::max({mean[0], mean[1], mean[2]}), 1.5);
  double largest = 0.0;
  cv::minMaxLoc(difference.reshape(1), nullptr, &largest);
  EXPECT_LT(largest, 90.0);
}

TEST_F(Video, SceneIsDrawnWithoutLabels) {
  const VideoOptions options = {{.width = 320, .height = 180}};
  render_scene(robot_, run_, options, 2.1, folder_ / "scene.png");
  const cv::Mat scene = cv::imread((folder_ / "scene.png").string());
  EXPECT_EQ(scene.size(), cv::Size(320, 180));
  cv::Scalar mean, deviation;
  cv::meanStdDev(scene, mean, deviation);
  EXPECT_GT(deviation[0], 10.0);  // not one flat colour
}

}  // namespace
}  // namespace touchdown::render
