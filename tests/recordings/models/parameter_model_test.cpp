#include "recordings/models/parameter_model.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "recordings/models/npz.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::recordings {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class ParameterModelFileTest : public ::testing::Test {
 protected:
  std::filesystem::path path() const { return folder_.path() / "m.npz"; }

  std::string complaint() const {
    try {
      read_parameter_model(path());
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  const ScratchFolder folder_;
};

TEST_F(ParameterModelFileTest, ReadsBackWhatWasWritten) {
  const ParameterModelFile written = {"force_kinematics",
                                      {{"slope", {0.1 + 0.2}}, {"mean", {1e-300, -2.0}}},
                                      {{"seconds", "3.5"}, {"seed:run", "1:0, 1:1"}}};
  write_parameter_model(written, path());
  const ParameterModelFile read = read_parameter_model(path());
  EXPECT_EQ(read.estimator, written.estimator);
  EXPECT_EQ(read.parameters, written.parameters);
  EXPECT_EQ(read.provenance, written.provenance);
}

TEST_F(ParameterModelFileTest, IsPlainArraysForNumPy) {
  write_parameter_model({"load", {{"mean", {1.0, 2.0}}}, {}}, path());
  const NpzArrays arrays = read_npz(path());
  EXPECT_EQ(arrays.at("mean").data, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(arrays.at("estimator").data, (std::vector<double>{'l', 'o', 'a', 'd'}));
}

TEST_F(ParameterModelFileTest, NamesTheError) {
  write_npz({{"slope", {{1}, {1.0}}}}, path());
  EXPECT_THAT(complaint(), AllOf(HasSubstr("m.npz"), HasSubstr("missing estimator")));
  write_npz({{"estimator", {{1}, {300.0}}}}, path());
  EXPECT_THAT(complaint(), HasSubstr("estimator: expected bytes"));
  write_npz(
      {{"estimator", {{1}, {'x'}}}, {"slope", {{1}, {std::numeric_limits<double>::quiet_NaN()}}}},
      path());
  EXPECT_THAT(complaint(), HasSubstr("slope: expected finite numbers"));
  EXPECT_THROW(write_parameter_model({"x", {{"provenance", {1.0}}}, {}}, path()), Error);
}

TEST_F(ParameterModelFileTest, NamesTheParameterThatIsMissingOrHasAnotherSize) {
  const Parameters parameters = {{"slope", {2.0}}, {"mean", {1.0, 2.0}}};
  EXPECT_EQ(parameter(parameters, "slope"), 2.0);
  EXPECT_EQ(parameter(parameters, "mean", 2)[1], 2.0);
  EXPECT_THROW(parameter(parameters, "mean"), InputError);
  EXPECT_THROW(parameter(parameters, "intercept"), InputError);
}

}  // namespace
}  // namespace touchdown::recordings
