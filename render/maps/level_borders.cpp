#include "render/maps/level_borders.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace touchdown::render {
namespace {

/// The levels between two neighbours' values.
std::vector<double> between(double a, double b, const std::vector<double>& levels) {
  std::vector<double> crossed;
  if (!std::isfinite(a) || !std::isfinite(b)) return crossed;
  std::copy_if(levels.begin(), levels.end(), std::back_inserter(crossed),
               [&](double level) { return (a < level) != (b < level); });
  return crossed;
}

std::size_t segments_of(const LevelBorder& border) { return border.line.size() - 1; }

/// The distance below which two labels would touch (px).
constexpr double label_distance = 36.0;

/// Places each label as near to the middle of its line as the previous labels permit.
void place_labels(std::vector<LevelBorder>& borders, const CellSize& cell) {
  std::vector<LabelPlace> taken;
  for (LevelBorder& border : borders) {
    const std::size_t segments = segments_of(border);
    for (std::size_t i = 0; i < segments; ++i) {
      // From the middle outwards: 0, 1, −1, 2, −2, …
      const std::size_t away = (i + 1) / 2, middle = segments / 2;
      border.labelled =
          i % 2 == 1 ? (middle + away) % segments : (middle + segments - away) % segments;
      const LabelPlace place = label_place(border);
      const bool free = std::none_of(taken.begin(), taken.end(), [&](const LabelPlace& other) {
        return cell.width * std::abs(place.x - other.x) < label_distance &&
               cell.height * std::abs(place.y - other.y) < label_distance;
      });
      if (free) {
        taken.push_back(place);
        break;
      }
      border.labelled.reset();
    }
  }
}

}  // namespace

std::vector<LevelBorder> level_borders(const std::vector<std::vector<double>>& rows,
                                       const std::vector<double>& levels, const CellSize& cell) {
  std::map<std::vector<double>, std::vector<IsoSegment>> segments;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      const auto x = static_cast<double>(c), y = static_cast<double>(r);
      if (c + 1 < rows[r].size()) {
        segments[between(rows[r][c], rows[r][c + 1], levels)].push_back(
            {{{x + 0.5, y - 0.5}, {x + 0.5, y + 0.5}}});
      }
      if (r + 1 < rows.size() && c < rows[r + 1].size()) {
        segments[between(rows[r][c], rows[r + 1][c], levels)].push_back(
            {{{x - 0.5, y + 0.5}, {x + 0.5, y + 0.5}}});
      }
    }
  }
  std::vector<LevelBorder> borders;
  for (const auto& [crossed, edges] : segments) {
    if (crossed.empty()) continue;
    for (IsoLine& line : joined(edges)) borders.push_back({crossed, std::move(line)});
  }
  std::stable_sort(borders.begin(), borders.end(), [](const LevelBorder& a, const LevelBorder& b) {
    return segments_of(a) > segments_of(b);
  });
  place_labels(borders, cell);
  return borders;
}

std::string label_of(const LevelBorder& border) {
  return fmt::format("{} %", fmt::join(border.levels, ", "));
}

LabelPlace label_place(const LevelBorder& border) {
  const auto& from = border.line[*border.labelled];
  const auto& to = border.line[*border.labelled + 1];
  return {0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1]), from[0] == to[0]};
}

std::vector<IsoLine> without_label(const LevelBorder& border, const CellSize& cell) {
  if (!border.labelled) return {border.line};
  const LabelPlace place = label_place(border);
  const auto before = border.line.begin() + static_cast<std::ptrdiff_t>(*border.labelled) + 1;
  IsoLine first(border.line.begin(), before), second(before, border.line.end());
  constexpr double letter = 6.2, around = 3.0;
  const double gap = (letter * static_cast<double>(label_of(border).size()) + around) /
                     (place.upright ? cell.height : cell.width);
  if (gap < 1.0) {
    const auto towards_middle = [&](const std::array<double, 2>& corner) {
      return std::array{place.x + gap * (corner[0] - place.x),
                        place.y + gap * (corner[1] - place.y)};
    };
    const auto from = first.back(), to = second.front();
    first.push_back(towards_middle(from));
    second.insert(second.begin(), towards_middle(to));
  }
  return {first, second};
}

}  // namespace touchdown::render
