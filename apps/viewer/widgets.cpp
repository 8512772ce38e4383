#include "apps/viewer/widgets.hpp"

#include <algorithm>

namespace touchdown::viewer {

ImU32 colour_of(unsigned rgb, unsigned opacity) {
  return IM_COL32(rgb >> 16 & 0xff, rgb >> 8 & 0xff, rgb & 0xff, opacity);
}

ImU32 colour_of(const render::Colour& colour) {
  const auto part = [&](int i) { return static_cast<unsigned>(colour[i]); };
  return IM_COL32(part(2), part(1), part(0), 0xff);
}

void begin_area(const char* name, const Area& area, bool scrolls) {
  const float margin = scrolls ? 12.0F : 0.0F;
  ImGuiWindowFlags flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                           ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus;
  if (!scrolls) flags |= ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
  ImGui::SetNextWindowPos({area.left, area.top});
  ImGui::SetNextWindowSize({area.width, area.height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {margin, margin});
  ImGui::Begin(name, nullptr, flags);
  ImGui::PopStyleVar();
}

Area mouse_area(const char* name, float height) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = std::max(1.0F, ImGui::GetContentRegionAvail().x);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0F, 0.0F});
  ImGui::InvisibleButton(name, {width, height});
  ImGui::PopStyleVar();
  return {corner.x, corner.y, width, height};
}

namespace {

/// Goes to where something of this width ends at the right edge.
void go_right(float width) {
  ImGui::SameLine();
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - width);
}

float badge_size() { return ImGui::GetTextLineHeight(); }

void draw_badge(const char* name, bool contact, bool is_wrong) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float size = badge_size();
  const ImVec2 end(corner.x + size, corner.y + size);
  list.AddRectFilled(corner, end, contact ? colour_of(0x2f8f5b) : IM_COL32_WHITE);
  list.AddRect(corner, end, colour_of(is_wrong ? error_red : grey), 0.0F, 0,
               is_wrong ? 3.0F : 1.0F);
  list.AddText({corner.x + 0.5F * (size - ImGui::CalcTextSize(name).x), corner.y},
               contact ? IM_COL32_WHITE : colour_of(grey), name);
  ImGui::Dummy({size, size});
}

}  // namespace

void panel_line(const std::string& text, const std::string& value,
                const std::optional<ContactBadges>& badges, unsigned colour) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour_of(colour));
  ImGui::TextUnformatted(text.c_str());
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float value_width = value.empty() ? 0.0F : ImGui::CalcTextSize(value.c_str()).x + gap;
  if (badges) {
    const auto& [contact, truth] = *badges;
    go_right(value_width + 2.0F * badge_size() + gap);
    draw_badge("L", contact[0], truth && contact[0] != (*truth)[0]);
    ImGui::SameLine();
    draw_badge("R", contact[1], truth && contact[1] != (*truth)[1]);
  }
  if (!value.empty()) {
    go_right(value_width - gap);
    ImGui::TextUnformatted(value.c_str());
  }
  ImGui::PopStyleColor();
}

void panel_heading(const std::string& text, const std::string& value) {
  ImGui::Separator();
  panel_line(text, value, {}, grey);
}

std::string widget_title(const std::string& title) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(title.c_str());
  ImGui::SameLine();
  constexpr float share = 0.6F;  // of the panel
  ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), share * ImGui::GetWindowWidth()));
  ImGui::SetNextItemWidth(-1.0F);  // as far as the right edge
  return "##" + title;
}

std::optional<std::size_t> choice(const std::string& title, const std::vector<std::string>& names,
                                  std::size_t chosen) {
  std::vector<const char*> items;
  for (const std::string& name : names) items.push_back(name.c_str());
  int index = static_cast<int>(chosen);
  const int count = static_cast<int>(items.size());
  if (!ImGui::Combo(widget_title(title).c_str(), &index, items.data(), count)) return {};
  return static_cast<std::size_t>(index);
}

}  // namespace touchdown::viewer
