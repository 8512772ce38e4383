#include <csignal>
#include <filesystem>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/film/encode.hpp"
#include "tests/render/staged_run.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

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
  const recordings::Recording run = staged_run(0.5);
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

}  // namespace
}  // namespace touchdown::render
