#include "render/film/encode.hpp"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/error.hpp"
#include "core/files.hpp"
#include "tests/render/staged_run.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// A caught error: its message, and whether the request was wrong (exit code 2) or not (1).
struct CaughtError {
  std::string message;
  bool is_request = false;
};

template <typename Work>
CaughtError error_of(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return {error.what(), true};
  } catch (const Error& error) {
    return {error.what(), false};
  }
  return {};
}

/// FFmpeg without x264, as some distributions build it.
TEST(VideoEncoder, AMissingCodecIsOneClearErrorAndLeavesNothing) {
  const ScratchFolder folder;
  const models::RobotModel robot = models::compile_robot_model(upkie_mjcf, staged_terrain());
  const logs::Recording run = staged_run(0.5);
  const VideoOptions options = {{.width = 320, .height = 180, .encoder = "libx264_is_not_here"}};
  const CaughtError error = error_of([&] {
    render_video({{robot, run, {}}}, options, folder / "x.mp4");
  });
  EXPECT_THAT(error.message,
              AllOf(HasSubstr("no H.264 encoder"), HasSubstr("libx264_is_not_here")));
  EXPECT_EQ(error.message.find('\n'), std::string::npos);
  EXPECT_FALSE(error.is_request);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

/// An encoder that does not know x264's options must give an error, not write another file.
TEST(VideoEncoder, AnotherCodecIsRefused) {
  const ScratchFolder folder;
  const CaughtError error = error_of(
      [&] { VideoWriter(folder / "x.mp4", {.width = 64, .height = 64, .encoder = "mpeg4"}); });
  EXPECT_THAT(error.message, HasSubstr("video: "));
  EXPECT_FALSE(error.is_request);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(VideoEncoder, OddSizesAreTheRequestsFault) {
  const ScratchFolder folder;
  EXPECT_TRUE(
      error_of([&] { VideoWriter(folder / "x.mp4", {.width = 63, .height = 64}); }).is_request);
}

/// Neither the memory in which a film is made nor the disk takes more than its first bytes.
TEST(VideoEncoder, AFullDiskIsAnErrorAndTheOldFilmStays) {
  const ScratchFolder folder;
  folder.write("x.mp4", "the old film");
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit most{2000, 2000};
    ::setrlimit(RLIMIT_FSIZE, &most);
    const CaughtError error = error_of([&] {
      VideoWriter writer(folder / "x.mp4", {.width = 320, .height = 240});
      std::vector<std::uint8_t> picture(320 * 240 * 3 / 2);
      for (int i = 0; i < 60; ++i) {
        for (std::size_t k = 0; k < picture.size(); ++k) {
          picture[k] = static_cast<std::uint8_t>((k * k + 7919 * static_cast<std::size_t>(i)) >> 3);
        }
        writer.write(picture.data());
      }
      writer.finish();
    });
    ::_exit(error.message.find("write") != std::string::npos && !error.is_request ? 42 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 42);
  EXPECT_EQ(read_file(folder / "x.mp4"), "the old film");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(VideoEncoder, AWriterThatNeverFinishesLeavesNothing) {
  const ScratchFolder folder;
  {
    VideoWriter writer(folder / "x.mp4", {.width = 64, .height = 64});
    const std::vector<std::uint8_t> grey(64 * 64 * 3 / 2, 128);
    for (int i = 0; i < 5; ++i) writer.write(grey.data());
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

class Picture : public ::testing::Test {
 protected:
  /// A smooth gradient, another one in each colour.
  static cv::Mat gradient(int rows, int cols) {
    cv::Mat picture(rows, cols, CV_8UC3);
    for (int row = 0; row < rows; ++row) {
      for (int col = 0; col < cols; ++col) {
        picture.at<cv::Vec3b>(row, col) = {cv::saturate_cast<unsigned char>(row * 255 / rows),
                                           cv::saturate_cast<unsigned char>(col * 255 / cols), 40};
      }
    }
    return picture;
  }

  /// The largest difference between a picture and what OpenCV reads from its file, in any colour.
  double largest_difference(const cv::Mat& picture, const std::filesystem::path& path) const {
    write_picture(picture, path);
    const cv::Mat read = cv::imread(path.string());
    if (read.size() != picture.size()) return 256.0;
    return cv::norm(read, picture, cv::NORM_INF);
  }

  ScratchFolder scratch_;
};

TEST_F(Picture, AsPngIsReadBackExactly) {
  EXPECT_EQ(largest_difference(gradient(61, 83), scratch_.path() / "odd.png"), 0.0);
  EXPECT_EQ(largest_difference(gradient(1, 1), scratch_.path() / "pixel.png"), 0.0);
}

TEST_F(Picture, AsJpegIsReadBackWithinAFewLevels) {
  EXPECT_LE(largest_difference(gradient(120, 161), scratch_.path() / "still.jpg"), 8.0);
  EXPECT_LE(largest_difference(gradient(1, 1), scratch_.path() / "pixel.jpg"), 8.0);
}

TEST_F(Picture, AsJpegHasTheBytesOfOpenCvsEncoder) {
  const cv::Mat picture = gradient(90, 160);
  write_picture(picture, scratch_.path() / "still.jpg");
  std::vector<unsigned char> expected;
  ASSERT_TRUE(cv::imencode(".jpg", picture, expected, {cv::IMWRITE_JPEG_QUALITY, 82}));
  EXPECT_TRUE(std::ranges::equal(
      read_file(scratch_.path() / "still.jpg"), expected,
      [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; }));
}

TEST_F(Picture, MayBeAPartOfALargerOne) {
  const cv::Mat part = gradient(80, 100)(cv::Rect(7, 9, 64, 32));
  EXPECT_EQ(largest_difference(part, scratch_.path() / "part.png"), 0.0);
  EXPECT_LE(largest_difference(part, scratch_.path() / "part.jpg"), 8.0);
}

TEST_F(Picture, InAFileInsteadOfAFolderIsRefusedByName) {
  const std::filesystem::path file = scratch_.write("file", "");
  EXPECT_THAT([&] { write_picture(gradient(4, 4), file / "a.png"); },
              ThrowsMessage<Error>(HasSubstr("file")));
}

}  // namespace
}  // namespace touchdown::render
