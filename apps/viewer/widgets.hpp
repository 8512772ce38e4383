#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <imgui/imgui.h>

#include "render/film/plots.hpp"

namespace touchdown::viewer {

/// Dear ImGui's form of 0xRRGGBB, and of a curve's colour.
ImU32 colour_of(unsigned rgb, unsigned opacity = 0xff);
ImU32 colour_of(const render::Colour& colour);

/// Colours of labels, as in films, and of paper, ink and errors.
inline constexpr unsigned dark = 0x2b2f36, grey = 0x5c636e, green = 0x2f6f4f, brown = 0x8a6d1d,
                          orange = 0xd9760f, red = 0xb0304f, paper = 0xf7f8fa, ink = 0x22262b,
                          error_red = 0xd0122f;

/// A rectangle in the window (pixels, from the upper left corner).
struct Area {
  float left, top, width, height;
};

/// Begins a window of widgets that fills an area. `ImGui::End` ends it. One that scrolls has
/// margins.
void begin_area(const char* name, const Area& area, bool scrolls);

/// A widget of the window's width that shows nothing and takes the mouse. Returns where it is.
Area mouse_area(const char* name, float height);

/// The contact of both wheels as two small boxes: filled in contact, empty without. A decision that
/// differs from the true contact has a red border.
struct ContactBadges {
  std::array<bool, 2> contact;
  std::optional<std::array<bool, 2>> truth = {};
};

/// A line of the panel: text at the left; badges, then a value at the right.
void panel_line(const std::string& text, const std::string& value = {},
                const std::optional<ContactBadges>& badges = {}, unsigned colour = ink);
/// A line that begins a part of the panel.
void panel_heading(const std::string& text, const std::string& value = {});

/// Writes a title left of the next widget, whose identity, "##title", it returns.
std::string widget_title(const std::string& title);
/// A list of names to choose from. Returns what the user chooses now.
std::optional<std::size_t> choice(const std::string& title, const std::vector<std::string>& names,
                                  std::size_t chosen);

}  // namespace touchdown::viewer
