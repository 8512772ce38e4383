#include "render/benchmark/scores.hpp"

#include <fmt/format.h>

#include "core/files.hpp"
#include "core/table.hpp"
#include "render/report/tables.hpp"

namespace touchdown::render {

namespace {

/// The rows of a table, with access to their cells by column name.
class Rows {
 public:
  explicit Rows(const std::filesystem::path& file) {
    if (is_there(file)) table_ = from_csv(read_file(file));
  }

  template <typename Each>
  void for_each(const Each& each) {
    for (row_ = 0; row_ < table_.rows.size(); ++row_) each();
  }

  /// The cell of the current row.
  std::string text(const std::string& column) const {
    return cell(table_, table_.rows[row_], column);
  }
  double value(const std::string& column) const { return number(text(column)); }
  Interval interval(const std::string& column) const {
    return {value(column), value(column + "_low"), value(column + "_high")};
  }
  std::string setting() const {
    return fmt::format("{}, {} sensors", text("robot"), text("sensors"));
  }
  std::string noise() const {
    return fmt::format("{} N·m, {} m/s²", text("torque_noise_nm"),
                       text("accelerometer_noise_mps2"));
  }

 private:
  Table table_;
  std::size_t row_ = 0;
};

}  // namespace

BenchmarkScores benchmark_scores(const std::filesystem::path& run_directory) {
  const std::filesystem::path tables = run_directory / "tables";
  BenchmarkScores scores;
  Rows rows(tables / "benchmark.csv");
  rows.for_each([&] {
    if (rows.text("fitted_on") != "own") return;
    scores.scenes.push_back(
        {rows.text("simulator"), rows.setting(), rows.noise(), rows.text("scene"),
         rows.text("estimator"), rows.text("split") == "unseen", rows.interval("balanced_accuracy"),
         rows.value("no_contact_precision"), rows.value("no_contact_recall"),
         rows.value("flight_f1"), rows.value("extra_switches_per_minute"),
         rows.value("false_takeoffs_per_minute"), rows.value("takeoff_latency_median_ms")});
  });
  Rows standings(tables / "benchmark_standings.csv");
  standings.for_each([&] {
    scores.standings.push_back(
        {standings.setting(), standings.text("robot"), standings.text("sensors"), standings.noise(),
         standings.text("estimator"), standings.interval("mean_balanced_accuracy"),
         standings.value("worst_balanced_accuracy"), standings.text("worst_scene"),
         standings.text("worst_simulator"), standings.text("is_not_significantly_worse") == "1",
         standings.value("excess_log_loss_bits")});
  });
  Rows pairs(tables / "benchmark_differences.csv");
  pairs.for_each([&] {
    scores.pairs.push_back({pairs.setting(), pairs.noise(), pairs.text("scene"),
                            pairs.text("first"), pairs.text("second"),
                            pairs.interval("difference")});
  });
  return scores;
}

}  // namespace touchdown::render
