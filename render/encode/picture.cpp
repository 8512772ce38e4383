#include "render/encode/picture.hpp"

#include <memory>
#include <png.h>
#include <string>
#include <turbojpeg.h>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"

// OpenCV's own `imencode` uses the same two libraries. Its library loads a hundred others, which
// more than doubles the start of every command.

namespace touchdown::render {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* reason) {
  throw Error(fmt::format("{}: cannot compress the picture: {}", path.string(), reason));
}

std::string png(const cv::Mat& bgr, const std::filesystem::path& path) {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(bgr.cols);
  image.height = static_cast<png_uint_32>(bgr.rows);
  image.format = PNG_FORMAT_BGR;
  const auto row = static_cast<png_int_32>(bgr.step[0]);
  std::string file(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = file.size();
  if (!png_image_write_to_memory(&image, file.data(), &size, 0, bgr.data, row, nullptr)) {
    fail(path, image.message);
  }
  file.resize(size);
  return file;
}

std::string jpeg(const cv::Mat& bgr, const std::filesystem::path& path) {
  constexpr int quality = 82;
  const std::unique_ptr<void, decltype(&tjDestroy)> compressor(tjInitCompress(), &tjDestroy);
  if (!compressor) fail(path, tjGetErrorStr2(nullptr));
  unsigned char* bytes = nullptr;
  unsigned long size = 0;  // NOLINT(google-runtime-int): the library's type
  const int status =
      tjCompress2(compressor.get(), bgr.data, bgr.cols, static_cast<int>(bgr.step[0]), bgr.rows,
                  TJPF_BGR, &bytes, &size, TJSAMP_420, quality, TJFLAG_ACCURATEDCT);
  const std::unique_ptr<unsigned char, decltype(&tjFree)> buffer(bytes, &tjFree);
  if (status != 0) fail(path, tjGetErrorStr2(compressor.get()));
  return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace

void write_picture(const cv::Mat& bgr, const std::filesystem::path& path) {
  write_atomically(path, path.extension() == ".jpg" ? jpeg(bgr, path) : png(bgr, path));
}

}  // namespace touchdown::render
