#include "render/figures/level_borders.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "core/table.hpp"

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

using Point = std::array<double, 2>;
using BorderEdge = std::array<Point, 2>;  ///< from, to
using RoundedPoint = std::pair<long long, long long>;

/// A rounded position, which is the same for the two cells that compute the crossing of their
/// common edge from opposite ends.
RoundedPoint rounded(const Point& point) {
  constexpr double resolution = 1e9;
  return {std::llround(point[0] * resolution), std::llround(point[1] * resolution)};
}

/// Line segments that belong to no line yet, by their ends.
class LooseSegments {
 public:
  explicit LooseSegments(const std::vector<BorderEdge>& segments) : segments_(segments) {
    for (std::size_t i = 0; i < segments.size(); ++i) {
      for (const Point& end : segments[i]) at_[rounded(end)].push_back(i);
    }
  }

  std::size_t count_at(const Point& point) const {
    const auto found = at_.find(rounded(point));
    return found == at_.end() ? 0 : found->second.size();
  }

  /// Removes a segment that ends at `point`; returns its other end.
  Point follow(const Point& point) {
    const std::size_t segment = at_.at(rounded(point)).back();
    for (const Point& end : segments_[segment]) std::erase(at_[rounded(end)], segment);
    const BorderEdge& ends = segments_[segment];
    return rounded(ends[0]) == rounded(point) ? ends[1] : ends[0];
  }

 private:
  const std::vector<BorderEdge>& segments_;
  std::map<RoundedPoint, std::vector<std::size_t>> at_;
};

/// Joins segments that share an end into lines. A closed line ends where it begins.
std::vector<BorderLine> joined(const std::vector<BorderEdge>& segments) {
  LooseSegments loose(segments);
  std::vector<BorderLine> lines;
  const auto follow_from = [&](const Point& start) {
    BorderLine line = {start};
    while (loose.count_at(line.back()) > 0) line.push_back(loose.follow(line.back()));
    lines.push_back(std::move(line));
  };
  // First the open lines, from their ends; the remaining lines are closed.
  for (const BorderEdge& segment : segments) {
    for (const Point& end : segment) {
      if (loose.count_at(end) == 1) follow_from(end);
    }
  }
  for (const BorderEdge& segment : segments) {
    if (loose.count_at(segment[0]) > 0) follow_from(segment[0]);
  }
  return lines;
}

}  // namespace

std::vector<LevelBorder> level_borders(const std::vector<std::vector<double>>& rows,
                                       const std::vector<double>& levels, const CellSize& cell) {
  std::map<std::vector<double>, std::vector<BorderEdge>> segments;
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
    for (BorderLine& line : joined(edges)) borders.push_back({crossed, std::move(line)});
  }
  std::stable_sort(borders.begin(), borders.end(), [](const LevelBorder& a, const LevelBorder& b) {
    return segments_of(a) > segments_of(b);
  });
  place_labels(borders, cell);
  return borders;
}

std::string label_of(const LevelBorder& border) {
  const double last = 100.0 - border.levels.back();
  if (border.levels.size() == 1) return fmt::format("{:g} %", last);
  return fmt::format("{:g}–{:g} %", last, 100.0 - border.levels.front());
}

LabelPlace label_place(const LevelBorder& border) {
  const auto& from = border.line[*border.labelled];
  const auto& to = border.line[*border.labelled + 1];
  return {0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1]), from[0] == to[0]};
}

std::vector<BorderLine> without_label(const LevelBorder& border, const CellSize& cell) {
  if (!border.labelled) return {border.line};
  const LabelPlace place = label_place(border);
  const auto before = border.line.begin() + static_cast<std::ptrdiff_t>(*border.labelled) + 1;
  BorderLine first(border.line.begin(), before), second(before, border.line.end());
  constexpr double letter = 6.2, around = 3.0;
  const double gap = (letter * static_cast<double>(width(label_of(border))) + around) /
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
