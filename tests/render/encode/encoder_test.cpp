#include <filesystem>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
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
