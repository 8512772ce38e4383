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
#include "render/encode/writer.hpp"
#include "tests/render/staged_run.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// What goes wrong: the message, and whether it is the request's fault (exit code 2) or not (1).
struct Complaint {
  std::string message;
  bool request = false;
};

template <typename Work>
Complaint complaint(const Work& work) {
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
  const Complaint said = complaint([&] {
    render_video({{robot, run, {}}}, options, folder / "x.mp4");
  });
  EXPECT_THAT(said.message, AllOf(HasSubstr("no H.264 encoder"), HasSubstr("libx264_is_not_here")));
  EXPECT_EQ(said.message.find('\n'), std::string::npos);
  EXPECT_FALSE(said.request);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

/// An encoder that is there but does not know x264's options must say so, not write another file.
TEST(VideoEncoder, AnotherCodecIsRefused) {
  const ScratchFolder folder;
  const Complaint said = complaint(
      [&] { VideoWriter(folder / "x.mp4", {.width = 64, .height = 64, .encoder = "mpeg4"}); });
  EXPECT_THAT(said.message, HasSubstr("video: "));
  EXPECT_FALSE(said.request);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(VideoEncoder, OddSizesAreTheRequestsFault) {
  const ScratchFolder folder;
  EXPECT_TRUE(
      complaint([&] { VideoWriter(folder / "x.mp4", {.width = 63, .height = 64}); }).request);
}

/// Neither the memory in which a film is made nor the disk takes more than its first bytes.
TEST(VideoEncoder, AFilmThatHasNoRoomIsAnErrorAndTheOldOneStays) {
  const ScratchFolder folder;
  folder.write("x.mp4", "the old film");
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit most{2000, 2000};
    ::setrlimit(RLIMIT_FSIZE, &most);
    const Complaint said = complaint([&] {
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
    ::_exit(said.message.find("write") != std::string::npos && !said.request ? 42 : 1);
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
