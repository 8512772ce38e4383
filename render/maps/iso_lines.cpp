#include "render/maps/iso_lines.hpp"

#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace touchdown::render {
namespace {

using Point = std::array<double, 2>;
using Place = std::pair<long long, long long>;

/// Two cells compute the crossing of their common edge from opposite ends.
Place place_of(const Point& point) {
  constexpr double resolution = 1e9;
  return {std::llround(point[0] * resolution), std::llround(point[1] * resolution)};
}

/// Pieces that nobody has used yet, by their ends.
class LooseSegments {
 public:
  explicit LooseSegments(const std::vector<IsoPiece>& pieces) : pieces_(pieces) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      for (const Point& end : pieces[i]) at_[place_of(end)].push_back(i);
    }
  }

  std::size_t count_at(const Point& point) const {
    const auto found = at_.find(place_of(point));
    return found == at_.end() ? 0 : found->second.size();
  }

  /// Takes a piece that ends at `point`; returns its other end.
  Point follow(const Point& point) {
    const std::size_t piece = at_.at(place_of(point)).back();
    for (const Point& end : pieces_[piece]) std::erase(at_[place_of(end)], piece);
    const IsoPiece& ends = pieces_[piece];
    return place_of(ends[0]) == place_of(point) ? ends[1] : ends[0];
  }

 private:
  const std::vector<IsoPiece>& pieces_;
  std::map<Place, std::vector<std::size_t>> at_;
};

}  // namespace

std::vector<IsoLine> joined(const std::vector<IsoPiece>& pieces) {
  LooseSegments loose(pieces);
  std::vector<IsoLine> lines;
  const auto follow_from = [&](const Point& start) {
    IsoLine line = {start};
    while (loose.count_at(line.back()) > 0) line.push_back(loose.follow(line.back()));
    lines.push_back(std::move(line));
  };
  // Open lines from their ends, then what is left: closed ones.
  for (const IsoPiece& piece : pieces) {
    for (const Point& end : piece) {
      if (loose.count_at(end) == 1) follow_from(end);
    }
  }
  for (const IsoPiece& piece : pieces) {
    if (loose.count_at(piece[0]) > 0) follow_from(piece[0]);
  }
  return lines;
}

std::vector<IsoPiece> iso_lines(const std::vector<std::vector<double>>& rows, double level) {
  std::vector<IsoPiece> pieces;
  for (std::size_t r = 0; r + 1 < rows.size(); ++r) {
    for (std::size_t c = 0; c + 1 < rows[r].size() && c + 1 < rows[r + 1].size(); ++c) {
      // Corners counter-clockwise from (column c, row r).
      const std::array<double, 4> value = {rows[r][c], rows[r][c + 1], rows[r + 1][c + 1],
                                           rows[r + 1][c]};
      const auto x = static_cast<double>(c);
      const auto y = static_cast<double>(r);
      const std::array<std::array<double, 2>, 4> corner = {
          {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}};
      std::vector<std::array<double, 2>> crossings;
      bool finite = true;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t next = (k + 1) % 4;
        finite = finite && std::isfinite(value[k]);
        if ((value[k] >= level) == (value[next] >= level)) continue;
        const double share = (level - value[k]) / (value[next] - value[k]);
        crossings.push_back({corner[k][0] + share * (corner[next][0] - corner[k][0]),
                             corner[k][1] + share * (corner[next][1] - corner[k][1])});
      }
      if (!finite) continue;
      if (crossings.size() == 2) {
        pieces.push_back({crossings[0], crossings[1]});
      } else if (crossings.size() == 4) {
        const double middle = 0.25 * (value[0] + value[1] + value[2] + value[3]);
        // Crossings are on edges 0..3; the middle belongs with corner 0 or with corners 1 and 3.
        const bool with_first = (middle >= level) == (value[0] >= level);
        const std::size_t shift = with_first ? 0 : 1;
        pieces.push_back({crossings[shift], crossings[shift + 1]});
        pieces.push_back({crossings[shift + 2], crossings[(shift + 3) % 4]});
      }
    }
  }
  return pieces;
}

}  // namespace touchdown::render
