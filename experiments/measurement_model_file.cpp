#include "experiments/measurement_model_file.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "estimator/bayes_filter.hpp"
#include "recordings/npz.hpp"

namespace touchdown {

namespace {

NpyArray points(const Axis& axis) {
  NpyArray array{{static_cast<std::size_t>(axis.count)}, {}};
  for (int i = 0; i < axis.count; ++i) array.data.push_back(axis[i]);
  return array;
}

}  // namespace

void write_measurement_model(const MeasurementModel& model, const std::filesystem::path& path) {
  const LikelihoodGrids grids = model.grids();
  const std::vector<std::size_t> shape = {static_cast<std::size_t>(grids.wheel.count),
                                          static_cast<std::size_t>(grids.knee.count)};
  NpyArray probability{shape, {}};
  for (std::size_t i = 0; i < grids.contact.size(); ++i) {
    probability.data.push_back(measurement_probability({grids.contact[i], grids.no_contact[i]}));
  }
  write_npz({{"wheel_torque", points(grids.wheel)},
             {"knee_torque", points(grids.knee)},
             {"contact_likelihood", {shape, grids.contact}},
             {"no_contact_likelihood", {shape, grids.no_contact}},
             {"P_contact", probability}},
            path);
}

MeasurementModel read_measurement_model(const std::filesystem::path& path) {
  const NpzArrays arrays = read_npz(path);
  const auto array = [&](const std::string& name) -> const std::vector<double>& {
    const auto found = arrays.find(name);
    if (found == arrays.end()) {
      throw InputError(fmt::format("{}: has no array '{}'", path.string(), name));
    }
    return found->second.data;
  };
  try {
    return MeasurementModel(likelihood_grids(array("knee_torque"), array("wheel_torque"),
                                             array("contact_likelihood"),
                                             array("no_contact_likelihood")));
  } catch (const InputError& error) {
    const std::string what = error.what();
    if (what.rfind(path.string(), 0) == 0) throw;
    throw InputError(fmt::format("{}: {}", path.string(), what));
  }
}

}  // namespace touchdown
