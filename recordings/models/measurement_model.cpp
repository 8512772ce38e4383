#include "recordings/models/measurement_model.hpp"

#include <string>
#include <vector>

#include <fmt/ranges.h>

#include "recordings/models/npz.hpp"

namespace touchdown::recordings {

namespace {

/// What `touchdown fit` can write is smaller by far.
std::size_t needed(std::string_view name) {
  constexpr std::size_t most_points = 20'000;
  constexpr std::size_t most_cells = std::size_t{1} << 25U;
  if (name == "wheel_torque" || name == "knee_torque") return most_points;
  return name == "contact_likelihood" || name == "no_contact_likelihood" ? most_cells : 0;
}

/// One row per wheel torque, one column per knee torque.
const std::vector<double>& grid(const NpzArrays& arrays, const char* name) {
  const NpyArray& grid = arrays.at(name);
  const std::size_t wheels = arrays.at("wheel_torque").data.size();
  const std::size_t knees = arrays.at("knee_torque").data.size();
  if (grid.shape.size() == 2 && grid.shape[0] == wheels && grid.shape[1] == knees) return grid.data;
  throw InputError(fmt::format("{}: expected shape ({}, {}) as the axes say, found ({})", name,
                               wheels, knees, fmt::join(grid.shape, ", ")));
}

NpyArray points(const Axis& axis) {
  NpyArray array{{static_cast<std::size_t>(axis.count)}, {}};
  for (int i = 0; i < axis.count; ++i) array.data.push_back(axis[i]);
  return array;
}

}  // namespace

MeasurementModel read_measurement_model(const std::filesystem::path& path) {
  return made_of_npz(path, needed, [](const NpzArrays& arrays) {
    require_arrays(arrays, "measurement model",
                   {"wheel_torque", "knee_torque", "contact_likelihood", "no_contact_likelihood"});
    const std::vector<double>& contact = grid(arrays, "contact_likelihood");
    const std::vector<double>& no_contact = grid(arrays, "no_contact_likelihood");
    return MeasurementModel(likelihood_grids(arrays.at("knee_torque").data,
                                             arrays.at("wheel_torque").data, contact, no_contact));
  });
}

void write_measurement_model(const MeasurementModel& model, const std::filesystem::path& path) {
  const LikelihoodGrids grids = model.grids();
  const std::vector<std::size_t> shape = {static_cast<std::size_t>(grids.wheel.count),
                                          static_cast<std::size_t>(grids.knee.count)};
  NpzArrays arrays;
  arrays["wheel_torque"] = points(grids.wheel);
  arrays["knee_torque"] = points(grids.knee);
  arrays["P_contact"] = {shape, contact_probability(grids)};
  arrays["contact_likelihood"] = {shape, grids.contact};
  arrays["no_contact_likelihood"] = {shape, grids.no_contact};
  write_npz(arrays, path);
}

}  // namespace touchdown::recordings
