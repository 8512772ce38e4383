#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "render/csv_file.hpp"
#include "render/report_noise_grid.hpp"
#include "render/report_parts.hpp"

namespace touchdown {
namespace {

bool is_among(const std::vector<double>& levels, double level) {
  return std::any_of(levels.begin(), levels.end(),
                     [&](double one) { return std::abs(one - level) < 1e-9; });
}

}  // namespace

ReportSection heatmap_section(const ReportSubject& subject) {
  ReportSection section{"noise", "Under sensor noise", {}};
  const auto success = read_csv(subject.table("success.csv"));
  if (!success) return section;
  std::vector<TableRow> alike, apart;
  double accelerometer = std::numeric_limits<double>::quiet_NaN();
  for (const TableRow& row : rows_of(*success)) {
    if (std::isfinite(row.number("torque_noise_nm"))) {
      // The other grid's diagonal may have levels that this one does not have.
      if (is_among(subject.experiment.noise.torque, row.number("torque_noise_nm"))) {
        alike.push_back(row);
      }
    } else if (row.has("knee_noise_nm")) {
      accelerometer = row.number("accelerometer_noise_mps2");
    }
  }
  for (const TableRow& row : rows_of(*success)) {
    const KneeWheelGridConfig& grid = subject.experiment.noise.knee_wheel;
    if (row.number("accelerometer_noise_mps2") == accelerometer &&
        is_among(grid.knee, row.number("knee_noise_nm")) &&
        is_among(grid.wheel, row.number("wheel_noise_nm"))) {
      apart.push_back(row);
    }
  }
  const std::size_t columns = noise_levels(alike, "accelerometer_noise_mps2").size();
  if (columns * noise_levels(alike, "torque_noise_nm").size() > 1) {
    section.html +=
        grid_html(alike,
                  {"accelerometer_noise_mps2", "torque_noise_nm", "accelerometer noise (m/s²)",
                   "torque noise (N·m)", "m/s²", "N·m", "accelerometer noise", "torque noise"},
                  "estimator");
  }
  if (!apart.empty()) {
    section.html +=
        fmt::format("<h3>Knees and wheels apart</h3>\n<p>Accelerometer noise {:.4g} m/s².</p>\n",
                    accelerometer) +
        grid_html(apart,
                  {"wheel_noise_nm", "knee_noise_nm", "wheel torque noise (N·m)",
                   "knee torque noise (N·m)", "N·m", "N·m", "wheel noise", "knee noise"},
                  "estimator-apart");
  }
  return section;
}

}  // namespace touchdown
