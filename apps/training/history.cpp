#include "apps/training/history.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/table.hpp"
#include "render/gnuplot/process.hpp"

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

constexpr const char* script_text = R"gnuplot(# gnuplot training.gp
set terminal pngcairo size 1200,800 font "DejaVu Sans,20" linewidth 2
set output "training.png"
set datafile separator comma
set key above
set xrange [0:*]
set grid lc rgb "#dddddd"
set logscale y
set format y "%g"
set xlabel "Iteration (each with new data)"
set ylabel "Cross-entropy (nat) + squared velocity error (m²/s²)" font ",18"
set arrow from {chosen}, graph 0 to {chosen}, graph 1 nohead dashtype 2 lc rgb "#888888"
set label "chosen" at {chosen}, graph 0.03 right offset -0.5,0 tc rgb "#555555"
plot "{data}" using "iteration":"training_loss" with linespoints pt 7 ps 0.8 \
       lc rgb "#4477aa" title "training (last epoch)", \
     "" using "iteration":"validation_loss" with linespoints pt 7 ps 0.8 \
       lc rgb "#cc6677" title "validation"
)gnuplot";

/// The numbers of one line; empty for an invalid line.
std::vector<double> numbers(const std::string& line) {
  std::vector<double> values;
  const char* at = line.data();
  const char* const end = at + line.size();
  while (true) {
    double value = 0.0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc()) return {};
    values.push_back(value);
    if (next == end) return values;
    if (*next != ',') return {};
    at = next + 1;
  }
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
  std::istringstream text(read_file(path));
  const auto fail = [&](std::size_t line) {
    throw InputError(
        fmt::format("{}:{}: is not a line of a training history; remove the folder to start anew",
                    path.string(), line));
  };
  std::string line;
  TrainingHistory history;
  for (std::size_t number = 1; std::getline(text, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (number == 1) {
      if (line != fmt::format("{}", fmt::join(header(), ","))) fail(number);
      continue;
    }
    const std::vector<double> values = numbers(line);
    if (values.size() != header().size() || values[0] != static_cast<double>(number - 1)) {
      fail(number);
    }
    IterationRecord record;
    record.iteration = static_cast<int>(values[0]);
    std::size_t column = 1;
    for (const auto& [name, value] : columns(record)) *value = values[column++];
    history.push_back(record);
  }
  return history;
}

std::filesystem::path draw_losses(const std::filesystem::path& history,
                                  const std::filesystem::path& folder, int chosen_iteration) {
  return render::try_gnuplot(
      folder / "training.gp",
      fmt::format(script_text, fmt::arg("chosen", chosen_iteration),
                  fmt::arg("data", history.lexically_relative(folder).string())));
}

}  // namespace touchdown::training
