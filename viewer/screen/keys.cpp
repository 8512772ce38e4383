#include "viewer/screen/keys.hpp"

#include <algorithm>

#include "render/film/plots.hpp"

namespace touchdown::viewer {

void act_on(const std::vector<KeyBinding>& bindings, const std::vector<KeyPress>& presses) {
  for (const KeyPress& press : presses) {
    for (const KeyBinding& binding : bindings) {
      const auto& keys = binding.keys;
      if (std::find(keys.begin(), keys.end(), press.key) != keys.end()) binding.act(press);
    }
  }
}

cv::Mat key_list(const render::TextPen& pen, const std::vector<KeyBinding>& bindings,
                 const std::vector<std::pair<std::string, std::string>>& mouse, int width,
                 int height) {
  std::vector<std::pair<std::string, std::string>> lines;
  for (const KeyBinding& binding : bindings) lines.emplace_back(binding.label, binding.text);
  lines.insert(lines.end(), mouse.begin(), mouse.end());
  const int count = static_cast<int>(lines.size());
  const int line = std::clamp((height - 24) / std::max(1, count), 10, 18);
  const int letters = line * 6 / 10;
  int labels = 0;
  int texts = 0;
  for (const auto& [label, text] : lines) {
    labels = std::max(labels, pen.width(label, letters));
    texts = std::max(texts, pen.width(text, letters));
  }
  const int margin = line;
  cv::Mat image(std::min(height, count * line + 2 * (margin / 2)),
                std::min(width, labels + texts + 3 * margin), CV_8UC3, render::strip_paper);
  int top = margin / 2;
  for (const auto& [label, text] : lines) {
    pen.write(image, label, margin, top, letters, render::rgb(0x0072b2));
    pen.write(image, text, 2 * margin + labels, top, letters, render::strip_ink);
    top += line;
  }
  return image;
}

}  // namespace touchdown::viewer
