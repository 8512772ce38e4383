#include "apps/training/history.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/table.hpp"
#include "render/gnuplot/facets.hpp"

namespace touchdown::training {

namespace {

/// The columns after "iteration", with pointers to their values in a record.
template <typename Record>
auto columns(Record& r) {
  return std::array{std::pair{"data_s", &r.data_seconds},
                    std::pair{"training_loss", &r.training.total},
                    std::pair{"training_contact", &r.training.contact},
                    std::pair{"training_velocity", &r.training.velocity},
                    std::pair{"training_accuracy", &r.training.accuracy},
                    std::pair{"validation_loss", &r.validation.total},
                    std::pair{"validation_contact", &r.validation.contact},
                    std::pair{"validation_velocity", &r.validation.velocity},
                    std::pair{"validation_accuracy", &r.validation.accuracy}};
}

std::vector<std::string> header() {
  std::vector<std::string> names = {"iteration"};
  const IterationRecord any;
  for (const auto& [name, value] : columns(any)) names.emplace_back(name);
  return names;
}

}  // namespace

std::size_t best_iteration(const TrainingHistory& history) {
  const auto best = std::min_element(history.begin(), history.end(),
                                     [](const IterationRecord& a, const IterationRecord& b) {
                                       return a.validation.total < b.validation.total;
                                     });
  return static_cast<std::size_t>(best - history.begin());
}

bool stopped_improving(const TrainingHistory& history, int patience) {
  return !history.empty() &&
         history.size() - 1 - best_iteration(history) >= static_cast<std::size_t>(patience);
}

void write_history(const TrainingHistory& history, const std::filesystem::path& path) {
  TextTable table{header(), {}};
  for (const IterationRecord& record : history) {
    std::vector<std::string> cells = {exact(record.iteration)};
    for (const auto& [name, value] : columns(record)) cells.push_back(exact(*value));
    table.rows.push_back(std::move(cells));
  }
  write_atomically(path, to_csv(table));
}

TrainingHistory read_history(const std::filesystem::path& path) {
  const TextTable table = from_csv(read_file(path));
  const auto require = [&](bool is_good, std::size_t line) {
    if (is_good) return;
    throw InputError(
        fmt::format("{}:{}: is not a line of a training history; remove the folder to start anew",
                    path.string(), line));
  };
  require(table.header == header(), 1);
  TrainingHistory history;
  for (const std::vector<std::string>& row : table.rows) {
    const std::size_t line = history.size() + 2;
    require(row.size() == table.header.size(), line);
    const auto number = [&](std::size_t column) {
      const std::string& text = row[column];
      double value = 0.0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      require(error == std::errc() && end == text.data() + text.size(), line);
      return value;
    };
    IterationRecord& record = history.emplace_back();
    record.iteration = static_cast<int>(history.size());
    require(number(0) == static_cast<double>(record.iteration), line);
    std::size_t column = 1;
    for (const auto& [name, value] : columns(record)) *value = number(column++);
  }
  return history;
}

std::filesystem::path draw_losses(const TrainingHistory& history, const render::FigureFile& file) {
  using experiments::MarkShape;
  const std::size_t chosen = best_iteration(history);
  Table losses{{{"of"}, {"iteration"}, {"loss"}, {"chosen"}}, {}};
  for (std::size_t i = 0; i < history.size(); ++i) {
    const auto add = [&](const char* of, const Loss& loss, bool is_chosen) {
      losses.rows.push_back(
          {of, exact(history[i].iteration), exact(loss.total), is_chosen ? "1" : "0"});
    };
    add("training (last epoch)", history[i].training, false);
    add("validation", history[i].validation, i == chosen);
  }
  experiments::FigureSpec spec;
  spec.series = experiments::groups_in(losses, "of", [](const auto& name) { return name; });
  spec.x = {.column = "iteration", .title = "iteration, each with new data"};
  spec.measures = {{.column = "loss",
                    .title = "contact (nat) + squared velocity error (m²/s²)",
                    .scale = experiments::AxisScale::log}};
  spec.marks = {{MarkShape::curve}, {MarkShape::ring, {{"chosen", "1"}}}};
  spec.title = "Loss of the neural measurement network";
  spec.caption = fmt::format(
      "Cross-entropy of contact and weighted squared error of the velocity; a ring marks "
      "the chosen iteration, {} (tables/training.csv).",
      history[chosen].iteration);
  spec.alt = "Loss by iteration." + experiments::values_text(spec, losses);
  try {
    const auto figure = render::draw_facets(spec, losses, file);
    return figure ? figure->png : std::filesystem::path();
  } catch (const Error&) {
    return {};  // the figure is optional
  }
}

}  // namespace touchdown::training
