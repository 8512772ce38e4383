#pragma once

#include "apps/viewer/curves.hpp"
#include "apps/viewer/label_editor.hpp"

struct ImDrawList;

namespace touchdown::viewer {

/// The column of a time of the log (px).
float column_of(const LabelEditor& editor, const LaneScale& scale, double time);

/// Draws the labels of a wheel between two heights of the window, with what is selected.
void draw_lane(ImDrawList& list, const LabelEditor& editor, std::size_t wheel,
               const LaneScale& scale, float top, float bottom);
/// Draws amber marks where a person should look: the lower, the less sure.
void draw_sureness(ImDrawList& list, const LabelEditor& editor, const LaneScale& scale, float top,
                   float bottom);
/// Draws ticks with the log's times (s).
void draw_ruler(ImDrawList& list, const LabelEditor& editor, const LaneScale& scale, float top,
                float bottom);

}  // namespace touchdown::viewer
