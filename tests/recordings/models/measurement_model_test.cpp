#include "recordings/models/measurement_model.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "recordings/models/npz.hpp"
#include "tests/python_with_numpy.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::recordings {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::filesystem::path reference =
    std::filesystem::path(TOUCHDOWN_REFERENCE_DATA) / "bullet_stairs.npz";

/// 3 wheel torques × 4 knee torques.
NpzArrays small_model() {
  NpzArrays arrays;
  arrays["wheel_torque"] = {{3}, {0.0, 0.5, 1.0}};
  arrays["knee_torque"] = {{4}, {-1.0, 1.0, 3.0, 5.0}};
  NpyArray grid{{3, 4}, {}};
  for (int i = 0; i < 12; ++i) grid.data.push_back(0.1 * i);
  arrays["contact_likelihood"] = grid;
  for (double& value : grid.data) value = 2.0 - value;
  grid.data[0] = 0.0;
  arrays["no_contact_likelihood"] = grid;
  return arrays;
}

std::string message(const NpzArrays& arrays) {
  const ScratchFolder folder;
  write_npz(arrays, folder / "model.npz");
  try {
    read_measurement_model(folder / "model.npz");
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(ModelFile, RowsFollowTheWheelTorque) {
  const ScratchFolder folder;
  write_npz(small_model(), folder / "model.npz");
  const MeasurementModel model = read_measurement_model(folder / "model.npz");
  EXPECT_EQ(model.wheel_axis().count, 3);
  EXPECT_EQ(model.knee_axis().count, 4);
  TorqueSample sample;
  sample.wheel = 0.5;
  sample.knee = 3.0;
  EXPECT_NEAR(model(sample).contact, 0.6, 1e-12);
  EXPECT_NEAR(model(sample).no_contact, 1.4, 1e-12);
}

TEST(ModelFile, WritesWhatItReadAndTheContactProbability) {
  const ScratchFolder folder;
  write_npz(small_model(), folder / "in.npz");
  write_measurement_model(read_measurement_model(folder / "in.npz"), folder / "out.npz");
  const NpzArrays out = read_npz(folder / "out.npz");
  ASSERT_EQ(out.size(), 5U);
  for (const auto& [name, array] : small_model()) {
    EXPECT_EQ(out.at(name).shape, array.shape);
    EXPECT_EQ(out.at(name).data, array.data) << name;
  }
  EXPECT_EQ(out.at("P_contact").data[0], 0.5) << "both likelihoods are zero there";
  EXPECT_NEAR(out.at("P_contact").data[6], 0.3, 1e-12);
}

TEST(ModelFile, TheAuthorsGridsLoadAndComeBackAsTheyWere) {
  if (!std::filesystem::exists(reference)) {
    GTEST_SKIP() << "the authors' grids are not here: " << reference;
  }
  const ScratchFolder folder;
  write_measurement_model(read_measurement_model(reference), folder / "out.npz");
  const NpzArrays theirs = read_npz(reference);
  const NpzArrays ours = read_npz(folder / "out.npz");
  ASSERT_EQ(ours.size(), theirs.size());
  for (const auto& [name, array] : theirs) {
    ASSERT_EQ(ours.at(name).shape, array.shape) << name;
    for (std::size_t i = 0; i < array.data.size(); ++i) {
      ASSERT_NEAR(ours.at(name).data[i], array.data[i], 1e-12 * std::abs(array.data[i]) + 1e-14)
          << name << " " << i;
    }
  }
}

TEST(ModelFile, NumPySeesTheSameKeysShapesAndTypesAsInTheAuthorsFile) {
  if (!std::filesystem::exists(reference)) {
    GTEST_SKIP() << "the authors' grids are not here: " << reference;
  }
  const std::string python = python_with_numpy();
  if (python.empty()) {
    GTEST_SKIP() << "python3 with NumPy is not installed";
  }
  const ScratchFolder folder;
  write_measurement_model(read_measurement_model(reference), folder / "out.npz");
  std::ofstream(folder / "script.py") << R"(
import sys
import numpy as np
ours, theirs = np.load(sys.argv[1]), np.load(sys.argv[2])
assert sorted(ours.keys()) == sorted(theirs.keys())
for key in theirs.keys():
    assert ours[key].shape == theirs[key].shape and ours[key].dtype == theirs[key].dtype
    assert np.allclose(ours[key], theirs[key], rtol=1e-12, atol=1e-14)
)";
  const std::string command = python + " " + (folder / "script.py").string() + " " +
                              (folder / "out.npz").string() + " " + reference.string();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST(ModelFile, AllMissingArraysAreNamed) {
  NpzArrays arrays = small_model();
  arrays.erase("knee_torque");
  arrays.erase("no_contact_likelihood");
  EXPECT_THAT(message(arrays), AllOf(HasSubstr("model.npz"), HasSubstr("knee_torque"),
                                     HasSubstr("no_contact_likelihood")));
}

TEST(ModelFile, AGridThatDoesNotFitItsAxesIsRefused) {
  NpzArrays arrays = small_model();
  arrays["contact_likelihood"].shape = {4, 3};
  EXPECT_THAT(message(arrays), AllOf(HasSubstr("contact_likelihood"), HasSubstr("(3, 4)")));
}

TEST(ModelFile, ValuesThatAreNoLikelihoodsAreRefused) {
  NpzArrays arrays = small_model();
  arrays["contact_likelihood"].data[5] = std::nan("");
  EXPECT_THAT(message(arrays), HasSubstr("model.npz"));
  arrays = small_model();
  arrays["wheel_torque"].data = {0.0, 0.5, 3.0};
  EXPECT_THAT(message(arrays), HasSubstr("model.npz"));
}

}  // namespace
}  // namespace touchdown::recordings
