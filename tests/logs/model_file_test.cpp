#include "logs/model_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "estimator/npz/npz.hpp"
#include "tests/complaint.hpp"
#include "tests/python_with_numpy.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::logs {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::filesystem::path reference =
    std::filesystem::path(TOUCHDOWN_REFERENCE_DATA) / "bullet_stairs.npz";

/// 3 wheel torques × 4 knee torques.
ModelArrays small_grid() {
  ModelArrays arrays;
  arrays["wheel_torque"] = {{3}, {0.0, 0.5, 1.0}};
  arrays["knee_torque"] = {{4}, {-1.0, 1.0, 3.0, 5.0}};
  ModelArray grid{{3, 4}, {}};
  for (int i = 0; i < 12; ++i) grid.data.push_back(0.1 * i);
  arrays["contact_likelihood"] = grid;
  for (double& value : grid.data) value = 2.0 - value;
  grid.data[0] = 0.0;
  arrays["no_contact_likelihood"] = grid;
  return arrays;
}

/// Random bits that are finite floats: denormals, tiny and huge numbers among them.
NeuralNetwork odd_network() {
  std::mt19937 engine(1);
  const auto fill = [&](auto& matrix, Eigen::Index rows, Eigen::Index columns) {
    matrix.resize(rows, columns);
    for (float& x : matrix.reshaped()) {
      do {
        const auto bits = static_cast<std::uint32_t>(engine());
        std::memcpy(&x, &bits, sizeof x);
      } while (!std::isfinite(x));
    }
  };
  NeuralNetwork n;
  fill(n.input_mean, neural_input_count, 1);
  fill(n.input_scale, neural_input_count, 1);
  const auto layer = [&](DenseLayer& dense, Eigen::Index outputs, Eigen::Index inputs) {
    fill(dense.weight, outputs, inputs);
    fill(dense.bias, outputs, 1);
  };
  layer(n.gru_input, 12, neural_input_count);
  layer(n.gru_hidden, 12, 4);
  layer(n.first, 6, 4);
  layer(n.second, 5, 6);
  layer(n.heads, neural_output_count, 5);
  return n;
}

/// A model that names its estimator.
ModelArrays named_model() {
  return {{"estimator", array_of_text("load_filter")},
          {"slope", {{1}, {0.1 + 0.2}}},
          {"mean", {{2}, {1e-300, -2.0}}},
          {"provenance", array_of_text("seconds: 3.5\nseed:run: 1:0, 1:1\n")}};
}

class ModelFile : public ::testing::Test {
 protected:
  std::string message() const {
    return complaint_of([&] { load_model(path_); });
  }

  const ScratchFolder folder_;
  const std::filesystem::path path_ = folder_ / "model.npz";
};

TEST_F(ModelFile, KeepsEveryKindOfModelToTheBit) {
  for (const ModelArrays& arrays : {small_grid(), arrays_of(odd_network()), named_model()}) {
    write_npz(arrays, path_);
    const Model model = load_model(path_);
    save_model(model, folder_ / "again.npz");
    ModelArrays again = read_npz(folder_ / "again.npz");
    if (model.grid) again.erase("P_contact");
    EXPECT_EQ(again, arrays) << arrays.begin()->first;
  }
}

TEST_F(ModelFile, HasTheContactProbabilityOfAGrid) {
  write_npz(small_grid(), path_);
  save_model(load_model(path_), path_);
  const ModelArrays out = read_npz(path_);
  EXPECT_EQ(out.at("P_contact").data[0], 0.5) << "both likelihoods are zero there";
  EXPECT_NEAR(out.at("P_contact").data[6], 0.3, 1e-12);
}

TEST_F(ModelFile, HasARowOfAGridForEachWheelTorque) {
  write_npz(small_grid(), path_);
  const MeasurementModel model = *load_model(path_).grid;
  EXPECT_EQ(model.wheel_axis().count, 3);
  EXPECT_EQ(model.knee_axis().count, 4);
  TorqueSample sample;
  sample.wheel = 0.5;
  sample.knee = 3.0;
  EXPECT_NEAR(model(sample).contact, 0.6, 1e-12);
  EXPECT_NEAR(model(sample).no_contact, 1.4, 1e-12);
}

TEST_F(ModelFile, KeepsTheMetadata) {
  Model model = model_of(named_model());
  model.metadata = ModelMetadata{.estimator = "load_filter",
                                 .sample_rate = 1000.0,
                                 .robot = "upkie",
                                 .configuration = {{"lead", "0.004"}},
                                 .fingerprint = {}};
  save_model(model, path_);
  const Model read = load_model(path_);
  EXPECT_EQ(read.arrays, model.arrays);
  EXPECT_EQ(read.metadata->configuration, model.metadata->configuration);
  EXPECT_EQ(estimator_of(read), "load_filter");
}

TEST_F(ModelFile, OfTheAuthorsComesBackAsItWas) {
  if (!std::filesystem::exists(reference)) {
    GTEST_SKIP() << "the authors' grids are not here: " << reference;
  }
  save_model({.grid = load_model(reference).grid}, path_);
  const ModelArrays theirs = read_npz(reference);
  const ModelArrays ours = read_npz(path_);
  ASSERT_EQ(ours.size(), theirs.size());
  for (const auto& [name, array] : theirs) {
    ASSERT_EQ(ours.at(name).shape, array.shape) << name;
    for (std::size_t i = 0; i < array.data.size(); ++i) {
      ASSERT_NEAR(ours.at(name).data[i], array.data[i], 1e-12 * std::abs(array.data[i]) + 1e-14)
          << name << " " << i;
    }
  }
}

TEST_F(ModelFile, HasTheKeysShapesAndTypesOfTheAuthorsFileInNumPy) {
  if (!std::filesystem::exists(reference)) {
    GTEST_SKIP() << "the authors' grids are not here: " << reference;
  }
  const std::string python = python_with_numpy();
  if (python.empty()) {
    GTEST_SKIP() << "python3 with NumPy is not installed";
  }
  save_model(load_model(reference), path_);
  std::ofstream(folder_ / "script.py") << R"(
import sys
import numpy as np
ours, theirs = np.load(sys.argv[1]), np.load(sys.argv[2])
assert sorted(ours.keys()) == sorted(theirs.keys())
for key in theirs.keys():
    assert ours[key].shape == theirs[key].shape and ours[key].dtype == theirs[key].dtype
    assert np.allclose(ours[key], theirs[key], rtol=1e-12, atol=1e-14)
)";
  const std::string command = python + " " + (folder_ / "script.py").string() + " " +
                              path_.string() + " " + reference.string();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

/// What g++ takes for code: the lines that are neither comments, which end at any line break, nor
/// texts in quotes.
std::string code_of(const std::string& header) {
  std::string code;
  for (std::size_t at = 0; at < header.size();) {
    const std::size_t end = std::min(header.find_first_of("\r\n", at), header.size());
    const std::string line = header.substr(at, end - at);
    if (!line.starts_with("//") && !line.starts_with('"')) code += line + "\n";
    at = end + 1;
  }
  return code;
}

TEST_F(ModelFile, AsAHeaderHasNoCodeFromItsTexts) {
  for (const std::string text : {"x\rint pwned;", "x\nint pwned;", "\r\nint pwned;//",
                                 "x\\\nint pwned;", "\x1b[2Jint pwned;", "\xe9int pwned;"}) {
    Model model = model_of(small_grid());
    model.metadata = ModelMetadata{};
    model.metadata->estimator = "robust";
    model.metadata->sample_rate = 1000.0;
    if (text.find('\n') == std::string::npos) model.metadata->robot = text;  // else it is refused
    EXPECT_THAT(code_of(header_of_model(model, text, "grid")), Not(HasSubstr("pwned"))) << text;
  }
  Model model = model_of(small_grid());
  model.metadata = ModelMetadata{};
  model.metadata->estimator = "robust";
  model.metadata->sample_rate = 1000.0;
  model.arrays["x[]={1};int pwned"] = {{1}, {1.0}};
  EXPECT_THAT(complaint_of([&] { (void)header_of_model(model, "grid.npz", "grid"); }),
              HasSubstr("expected letters, digits and '_' in its name"));
}

TEST_F(ModelFile, IsRefusedWhereverItIsCutOffOrSpoilt) {
  EXPECT_THAT(message(), HasSubstr("no such file"));
  std::ofstream(path_) << "nonsense";
  EXPECT_THAT(message(), AllOf(HasSubstr(path_.string()), Not(HasSubstr("\n"))));
  save_model({.arrays = arrays_of(odd_network())}, path_);
  const std::string good = read_file(path_);
  for (const double part : {0.0, 0.1, 0.5, 0.9, 0.999}) {
    std::ofstream(path_, std::ios::binary)
        << good.substr(0, static_cast<std::size_t>(part * static_cast<double>(good.size())));
    EXPECT_THAT(message(), AllOf(HasSubstr(path_.string()), Not(HasSubstr("\n"))));
  }
  std::string spoilt = good;
  spoilt[200] = static_cast<char>(spoilt[200] ^ 0x10);  // within the first array
  std::ofstream(path_, std::ios::binary) << spoilt;
  EXPECT_THAT(message(), AllOf(HasSubstr(path_.string()), Not(HasSubstr("\n"))));
}

}  // namespace
}  // namespace touchdown::logs
