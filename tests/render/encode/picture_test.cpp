#include "render/film/encode.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/error.hpp"
#include "core/files.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

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

TEST_F(Picture, WithoutPixelsIsRefusedByName) {
  for (const char* name : {"empty.png", "empty.jpg"}) {
    EXPECT_THAT([&] { write_picture(cv::Mat(0, 0, CV_8UC3), scratch_.path() / name); },
                ThrowsMessage<Error>(HasSubstr(name)));
    EXPECT_FALSE(std::filesystem::exists(scratch_.path() / name));
  }
}

TEST_F(Picture, InAFileInsteadOfAFolderIsRefusedByName) {
  const std::filesystem::path file = scratch_.write("file", "");
  EXPECT_THAT([&] { write_picture(gradient(4, 4), file / "a.png"); },
              ThrowsMessage<Error>(HasSubstr("file")));
}

}  // namespace
}  // namespace touchdown::render
