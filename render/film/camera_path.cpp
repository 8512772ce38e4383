#include "render/film/camera_path.hpp"

#include <cmath>

namespace touchdown::render {

std::vector<Eigen::Vector3d> smoothed(std::vector<Eigen::Vector3d> values, double period,
                                      double time_constant) {
  const double gain = 1.0 - std::exp(-period / time_constant);
  for (std::size_t k = 1; k < values.size(); ++k) {
    values[k] = values[k - 1] + gain * (values[k] - values[k - 1]);
  }
  for (std::size_t k = values.size(); k-- > 1;) {
    values[k - 1] = values[k] + gain * (values[k - 1] - values[k]);
  }
  return values;
}

}  // namespace touchdown::render
