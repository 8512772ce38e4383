#include "render/film/gl_context.hpp"

#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <iostream>
#include <optional>

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

using ::testing::ExitedWithCode;
using ::testing::ThrowsMessage;

/// A process looks for its OpenGL once, and so does MuJoCo. Each drawing here therefore runs in its
/// own process, which repeats the test up to that point with the same environment.
class OffScreen : public ::testing::Test {
 protected:
  OffScreen() {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    if (std::getenv("TOUCHDOWN_TEST_FOLDER") == nullptr) {
      scratch_.emplace();
      ::setenv("TOUCHDOWN_TEST_FOLDER", scratch_->path().c_str(), 1);
    }
  }
  void TearDown() override {
    ::unsetenv("TOUCHDOWN_TEST_FOLDER");
    ::unsetenv("TOUCHDOWN_GL");
    ::unsetenv("LD_LIBRARY_PATH");
  }

  static std::filesystem::path folder() { return std::getenv("TOUCHDOWN_TEST_FOLDER"); }
  static std::filesystem::path picture(const std::string& name) {
    return folder() / (name + ".png");
  }
  static void draw(const std::string& name) {
    render_scene(models::compile_robot_model(upkie_mjcf, staged_terrain()), staged_run(3.0),
                 {{.width = 640, .height = 360}}, 2.1, picture(name));
  }
  [[noreturn]] static void draw_and_exit(const std::string& name) {
    try {
      draw(name);
    } catch (const Error& error) {
      std::cerr << error.what() << '\n';
      std::_Exit(1);
    }
    std::_Exit(0);
  }

  /// Hides a library from all processes that start later.
  static void hide(const char* library) {
    write_atomically(folder() / library, "");
    ::setenv("LD_LIBRARY_PATH", folder().c_str(), 1);
  }
  static bool is_installed(const char* library) {
    void* const handle = ::dlopen(library, RTLD_LAZY | RTLD_LOCAL);
    if (handle) ::dlclose(handle);
    return handle != nullptr;
  }

  std::optional<ScratchFolder> scratch_;  ///< of the first process alone
};

TEST_F(OffScreen, OsmesaAndEglDrawTheSamePicture) {
  if (!is_installed("libOSMesa.so.8"))
    GTEST_SKIP() << "no OSMesa to compare with (package libosmesa6)";
  if (!is_installed("libEGL.so.1")) GTEST_SKIP() << "no EGL to compare with (package libegl1)";
  for (const char* const gl : {"osmesa", "egl"}) {
    ::setenv("TOUCHDOWN_GL", gl, 1);
    EXPECT_EXIT(draw_and_exit(gl), ExitedWithCode(0), "");
  }
  const cv::Mat osmesa = cv::imread(picture("osmesa").string());
  const cv::Mat egl = cv::imread(picture("egl").string());
  ASSERT_EQ(osmesa.size(), cv::Size(640, 360));
  ASSERT_EQ(egl.size(), osmesa.size());
  cv::Scalar mean, deviation;
  cv::meanStdDev(osmesa, mean, deviation);
  EXPECT_GT(deviation[0], 10.0);  // not one flat colour
  cv::Mat apart;
  cv::absdiff(osmesa, egl, apart);
  double largest = 0.0;
  cv::minMaxLoc(apart.reshape(1), nullptr, &largest);
  const double on_average = cv::mean(apart.reshape(1))[0];
  RecordProperty("largest_difference", std::to_string(largest));
  RecordProperty("mean_difference", std::to_string(on_average));
  EXPECT_LT(on_average, 0.1);
  EXPECT_LT(largest, 64.0);
}

TEST_F(OffScreen, EglDrawsWhereThereIsNoOsmesa) {
  if (!is_installed("libEGL.so.1")) GTEST_SKIP() << "no EGL (package libegl1)";
  hide("libOSMesa.so.8");
  EXPECT_EXIT(draw_and_exit("found"), ExitedWithCode(0), "");
  EXPECT_FALSE(cv::imread(picture("found").string()).empty());
}

TEST_F(OffScreen, PackagesAreNamedWhereThereIsNeither) {
  hide("libOSMesa.so.8");
  hide("libEGL.so.1");
  EXPECT_EXIT(draw_and_exit("neither"), ExitedWithCode(1),
              "cannot draw .* pixels off screen: OSMesa: .*libOSMesa.so.8.*libosmesa6.*; "
              "EGL: .*libEGL.so.1.*libegl-mesa0");
  ::setenv("TOUCHDOWN_GL", "osmesa", 1);
  EXPECT_EXIT(draw_and_exit("osmesa"), ExitedWithCode(1), "off screen: OSMesa: .*libosmesa6.\n");
  ::setenv("TOUCHDOWN_GL", "egl", 1);
  EXPECT_EXIT(draw_and_exit("egl"), ExitedWithCode(1), "off screen: EGL: .*libegl-mesa0");
}

TEST_F(OffScreen, EglWithoutADriverNamesItsPackages) {
  if (!is_installed("libEGL.so.1")) GTEST_SKIP() << "no EGL (package libegl1)";
  ::setenv("TOUCHDOWN_GL", "egl", 1);
  EXPECT_EXIT(
      {
        ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null", 1);
        draw_and_exit("no_driver");
      },
      ExitedWithCode(1), "off screen: EGL: .*libegl-mesa0");
}

TEST_F(OffScreen, OtherNamesAreRefused) {
  ::setenv("TOUCHDOWN_GL", "vulkan", 1);
  EXPECT_THAT([] { GlContext(8, 8); },
              ThrowsMessage<InputError>("TOUCHDOWN_GL=vulkan: expected osmesa or egl"));
}

}  // namespace
}  // namespace touchdown::render
