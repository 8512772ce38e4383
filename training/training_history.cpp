#include "training/training_history.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/table.hpp"

namespace touchdown {

namespace {

const std::vector<std::string> header = {"iteration",           "data_s",
                                         "training_loss",       "training_contact",
                                         "training_velocity",   "training_accuracy",
                                         "validation_loss",     "validation_contact",
                                         "validation_velocity", "validation_accuracy"};

std::vector<double> row(const IterationRecord& r) {
  return {static_cast<double>(r.iteration),
          r.data_seconds,
          r.training.total,
          r.training.contact,
          r.training.velocity,
          r.training.accuracy,
          r.validation.total,
          r.validation.contact,
          r.validation.velocity,
          r.validation.accuracy};
}

IterationRecord record(const std::vector<double>& row) {
  const auto loss = [&](std::size_t at) {
    return Loss{
        .contact = row[at + 1], .velocity = row[at + 2], .total = row[at], .accuracy = row[at + 3]};
  };
  return {static_cast<int>(row[0]), row[1], loss(2), loss(6)};
}

/// The numbers of one line; empty if it is anything else.
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
  Table table{header, {}};
  for (const IterationRecord& r : history) {
    std::vector<std::string> cells;
    for (const double value : row(r)) cells.push_back(exact(value));
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
      if (line != fmt::format("{}", fmt::join(header, ","))) fail(number);
      continue;
    }
    const std::vector<double> values = numbers(line);
    if (values.size() != header.size() || values[0] != static_cast<double>(number - 1)) {
      fail(number);
    }
    history.push_back(record(values));
  }
  return history;
}

}  // namespace touchdown
