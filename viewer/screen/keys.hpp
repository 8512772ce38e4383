#pragma once

#include <functional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "render/film/plots.hpp"
#include "viewer/window/window.hpp"

namespace touchdown::viewer {

/// What a key does. The list of all keys, which `h` shows, is made of these.
struct KeyBinding {
  std::vector<int> keys;
  std::string label;  ///< the keys' names: "↑ ↓"
  std::string text;   ///< what they do
  std::function<void(const KeyPress& press)> act;
};

/// Acts on pressed keys, in their order. Keys without a binding do nothing.
void act_on(const std::vector<KeyBinding>& bindings, const std::vector<KeyPress>& presses);

/// The list of keys and of what the mouse does, at most `width`·`height` pixels.
cv::Mat key_list(const render::TextPen& pen, const std::vector<KeyBinding>& bindings,
                 const std::vector<std::pair<std::string, std::string>>& mouse, int width,
                 int height);

}  // namespace touchdown::viewer
