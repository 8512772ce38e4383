#include <random>

#include <gtest/gtest.h>

#include "apps/viewer/log_window.hpp"
#include "core/error.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::viewer {
namespace {

constexpr int pictures = 120;
constexpr double rate = 25.0;

constexpr int bits = 7;
constexpr int bar = 16;  // px

cv::Rect bar_of(int bit) { return {bit * bar, 0, bar, 48}; }

/// A film of pictures that show their numbers, as black and white bars.
std::filesystem::path numbered_film(const ScratchFolder& folder) {
  const auto path = folder / "numbers.mp4";
  cv::VideoWriter writer(path.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('m', 'p', '4', 'v'),
                         rate, {bits * bar, 48});
  EXPECT_TRUE(writer.isOpened());
  for (int k = 0; k < pictures; ++k) {
    cv::Mat picture(48, bits * bar, CV_8UC3);
    for (int bit = 0; bit < bits; ++bit) {
      picture(bar_of(bit)).setTo(cv::Scalar::all((k & (1 << bit)) != 0 ? 255 : 0));
    }
    writer << picture;
  }
  return path;
}

int shown(Film& film, double time) {
  const cv::Mat& picture = film.at(time);
  int number = 0;
  for (int bit = 0; bit < bits; ++bit) {
    if (cv::mean(picture(bar_of(bit)))[0] > 128.0) number |= 1 << bit;
  }
  return number;
}

TEST(AFilm, ShowsThePictureOfATimeFromWhereverItWas) {
  const ScratchFolder folder;
  Film film(numbered_film(folder));
  EXPECT_NEAR(film.frame_period(), 1.0 / rate, 1e-9);
  EXPECT_EQ(film.size(), cv::Size(bits * bar, 48));
  std::mt19937 random(1);
  for (int i = 0; i < 60; ++i) {
    const int k = static_cast<int>(random() % pictures);
    EXPECT_EQ(shown(film, k / rate), k) << "sought";
    const int next = std::min(k + static_cast<int>(random() % 5), pictures - 1);
    EXPECT_EQ(shown(film, (next + 0.9) / rate), next) << "on the way";
  }
}

TEST(AFilm, IsEmptyBeforeItsStartAndAfterItsEnd) {
  const ScratchFolder folder;
  Film film(numbered_film(folder));
  EXPECT_TRUE(film.at(-0.01).empty());
  EXPECT_FALSE(film.at(0.0).empty());
  EXPECT_FALSE(film.at((pictures - 1) / rate).empty());
  EXPECT_TRUE(film.at(pictures / rate).empty());
}

TEST(AFilm, ThatIsNoneIsRefused) {
  const ScratchFolder folder;
  EXPECT_THROW(Film(folder / "none.mp4"), InputError);
  EXPECT_THROW(Film(folder.write("text.mp4", "hello")), InputError);
  EXPECT_THROW(Film(folder.path()), InputError);
}

}  // namespace
}  // namespace touchdown::viewer
