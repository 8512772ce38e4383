#pragma once

#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "experiments/config/experiment.hpp"
#include "render/figures/figures.hpp"
#include "render/gnuplot/facets.hpp"

namespace touchdown::render {

/// Maps of MuJoCo with a cell per estimator, torque noise and accelerometer noise.
struct NoiseMap {
  std::vector<std::string> estimators = {};
  std::vector<double> torque = {}, accelerometer = {};
  /// The error of a cell, and half the width of its interval (%).
  std::function<double(double torque, double accelerometer)> error = {};
  double half_width = 0.0;
  double always_contact = 90.0;  ///< %

  experiments::Experiment experiment() const {
    experiments::Experiment experiment;
    experiment.name = "study";
    experiment.estimators = estimators;
    experiment.noise.torque = torque;
    experiment.noise.accelerometer = accelerometer;
    return experiment;
  }

  /// The cells as the scores have them, in another order than the figure's.
  Table cells() const {
    std::string text =
        "simulator,estimator,torque_noise_nm,accelerometer_noise_mps2,success,success_low,"
        "success_high,always_contact_success\n";
    for (auto x = accelerometer.rbegin(); x != accelerometer.rend(); ++x) {
      for (const double y : torque) {
        for (const std::string& estimator : estimators) {
          const double success = 100.0 - error(y, *x);
          text += fmt::format("mujoco,{},{},{},{:.6f},{:.6f},{:.6f},{}\n", estimator, y, *x,
                              0.01 * success, 0.01 * (success - half_width),
                              0.01 * (success + half_width), 0.01 * always_contact);
        }
      }
    }
    const Table all = table_of(from_csv(text));
    return mapped_cells(all, noise_maps(experiment()).front(), "mujoco");
  }

  experiments::FigureSpec spec() const {
    return map_figure(cells(), noise_maps(experiment()).front(), experiment(), "mujoco");
  }

  Figure draw(const FigureFile& file) const { return draw_facets(spec(), cells(), file).value(); }
};

}  // namespace touchdown::render
