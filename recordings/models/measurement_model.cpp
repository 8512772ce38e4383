#include "recordings/models/measurement_model.hpp"

#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "recordings/models/npz.hpp"

namespace touchdown::recordings {

namespace {

void check_grid(const NpyArray& grid, std::size_t wheels, std::size_t knees,
                const std::string& where) {
  if (grid.shape.size() == 2 && grid.shape[0] == wheels && grid.shape[1] == knees) return;
  throw InputError(fmt::format("{}: expected shape ({}, {}) as the axes say, found ({})", where,
                               wheels, knees, fmt::join(grid.shape, ", ")));
}

NpyArray points(const Axis& axis) {
  NpyArray array{{static_cast<std::size_t>(axis.count)}, {}};
  for (int i = 0; i < axis.count; ++i) array.data.push_back(axis[i]);
  return array;
}

}  // namespace

MeasurementModel read_measurement_model(const std::filesystem::path& path) {
  const NpzArrays arrays = read_npz(path);
  constexpr std::array<const char*, 4> names = {"wheel_torque", "knee_torque", "contact_likelihood",
                                                "no_contact_likelihood"};
  std::vector<std::string> missing;
  for (const char* name : names) {
    if (!arrays.contains(name)) missing.emplace_back(name);
  }
  if (!missing.empty()) {
    throw InputError(fmt::format("{}: is no measurement model: missing {}", path.string(),
                                 fmt::join(missing, ", ")));
  }
  const NpyArray& wheel = arrays.at(names[0]);
  const NpyArray& knee = arrays.at(names[1]);
  for (std::size_t i = 2; i < names.size(); ++i) {
    check_grid(arrays.at(names[i]), wheel.data.size(), knee.data.size(),
               fmt::format("{}: {}", path.string(), names[i]));
  }
  try {
    return MeasurementModel(likelihood_grids(knee.data, wheel.data, arrays.at(names[2]).data,
                                             arrays.at(names[3]).data, GridRows::wheel));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
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
