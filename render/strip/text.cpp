#include "render/strip/text.hpp"

#include <filesystem>

#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "core/files.hpp"

namespace touchdown::render {
namespace {

const char* const font_file = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

}  // namespace

TextPen::TextPen() : font_(cv::freetype::createFreeType2()) {
  if (!is_there(font_file)) {
    throw Error(std::string(font_file) + " is missing: install fonts-dejavu-core");
  }
  font_->loadFontData(font_file, 0);
}

int TextPen::width(const std::string& text, int height) const {
  int baseline = 0;
  return font_->getTextSize(text, height, -1, &baseline).width;
}

int TextPen::write(cv::Mat& image, const std::string& text, int left, int top, int height,
                   const Colour& colour) const {
  font_->putText(image, text, {left, top + height}, height, colour, -1, cv::LINE_AA, true);
  return width(text, height);
}

int TextPen::chip(cv::Mat& image, const std::string& text, int left, int top, int height,
                  const Colour& fill) const {
  const int letters = height / 2;
  const int margin = (2 * height) / 5;
  const int box = width(text, letters) + 2 * margin;
  cv::rectangle(image, cv::Rect(left, top, box, height), fill, cv::FILLED);
  write(image, text, left + margin, top + (height - letters) / 2 - letters / 8, letters,
        rgb(0xffffff));
  return box;
}

}  // namespace touchdown::render
