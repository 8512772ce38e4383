#include "render/figures/facet_data.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiments/figures/figure_spec.hpp"

namespace touchdown::render {

namespace {

std::vector<std::string> encoded(const std::vector<std::string>& cells) {
  std::vector<std::string> texts;
  std::transform(cells.begin(), cells.end(), std::back_inserter(texts), percent_encoded);
  return texts;
}

}  // namespace

std::string FacetData::text(const FacetRow& row, const std::string& column) const {
  return cell(table, table.rows[row.index], column);
}

double FacetData::value(const FacetRow& row, const experiments::FigureAxis& axis) const {
  return experiments::drawn_value(axis, text(row, axis.column));
}

bool FacetData::has_values(const experiments::FigureAxis& axis) const {
  return std::any_of(rows.begin(), rows.end(),
                     [&](const FacetRow& row) { return !std::isnan(value(row, axis)); });
}

FacetData facet_data(const experiments::FigureSpec& spec, const Table& table) {
  FacetData data{table, {}};
  experiments::FigureAxis order = spec.x;
  order.floor.reset();  // values that are drawn at one place keep their order
  for (std::size_t index = 0; index < table.rows.size(); ++index) {
    const std::vector<std::string>& cells = table.rows[index];
    const auto panel = experiments::group_of(spec.panels, table, cells);
    const auto series = experiments::group_of(spec.series, table, cells);
    const auto row = experiments::group_of(spec.rows, table, cells);
    const auto mark =
        std::find_if(spec.marks.begin(), spec.marks.end(), [&](const experiments::FigureMark& m) {
          return experiments::passes(table, cells, m.where);
        });
    const bool is_drawn = experiments::passes(table, cells, spec.where) && panel && series && row &&
                          mark != spec.marks.end();
    if (!is_drawn) continue;
    FacetRow drawn{index, *panel, *series, *row,
                   static_cast<std::size_t>(mark - spec.marks.begin())};
    if (spec.rows.columns.empty()) drawn.x = data.value(drawn, order);
    if (!std::isnan(drawn.x)) data.rows.push_back(drawn);
  }
  std::stable_sort(data.rows.begin(), data.rows.end(), [](const FacetRow& a, const FacetRow& b) {
    return std::tie(a.panel, a.series, a.mark, a.row, a.x) <
           std::tie(b.panel, b.series, b.mark, b.row, b.x);
  });
  return data;
}

std::string data_file(const FacetData& data) {
  // Not `to_csv`, which marks names that spreadsheets would compute: gnuplot compares the names.
  std::string text = fmt::format("{}\n", fmt::join(encoded(data.table.header), ","));
  for (const FacetRow& row : data.rows) {
    text += fmt::format("{}\n", fmt::join(encoded(data.table.rows[row.index]), ","));
  }
  return text;
}

std::string percent_encoded(const std::string& text) {
  // gnuplot cuts a quoted cell at a comma and at a quote, reads escapes such as \n, and skips a
  // line that begins with #.
  constexpr std::string_view special = "%\",\\#";
  std::string result;
  for (const char letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    if (byte < 0x20 || special.find(letter) != std::string_view::npos) {
      result += fmt::format("%{:02X}", byte);
    } else {
      result += letter;
    }
  }
  return result;
}

}  // namespace touchdown::render
