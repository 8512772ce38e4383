#include "estimator/npz/load_estimator.hpp"

#include <memory>
#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "logs/model_file.hpp"
#include "tests/complaint.hpp"
#include "tests/estimator/models/models.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class LoadEstimator : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& name, const ModelArrays& arrays) const {
    logs::write_npz(arrays, folder_ / name);
    return folder_ / name;
  }

  const ScratchFolder folder_;
};

std::vector<double> beliefs_of(ContactEstimator& estimator) {
  std::vector<double> all;
  for (const Signals& s : test::drops_on_bent_legs(1200)) {
    const Belief& b = estimator.update(s);
    all.insert(all.end(), {b.wheel[0].p_contact, b.wheel[1].p_contact});
  }
  return all;
}

TEST_F(LoadEstimator, NamesTheFileInEveryError) {
  const auto m = file("m.npz", test::fitted_model("robust"));
  EXPECT_THAT(complaint_of([&] { load_estimator(m, {.sample_rate = 200.0}); }),
              AllOf(StartsWith(m.string()), EndsWith(": was fitted at 1000 Hz, not at 200 Hz")));
  EXPECT_THAT(complaint_of([&] { load_estimator(folder_ / "none.npz"); }),
              EndsWith("none.npz: no such file"));
  EXPECT_THAT(complaint_of([&] { load_estimator(folder_.path()); }),
              AllOf(StartsWith(folder_.path().string()), EndsWith(": is a folder")));
  EXPECT_THAT(complaint_of([&] { load_estimator(folder_.write("text.npz", "name: robust\n")); }),
              HasSubstr("text.npz: is not a readable .npz file"));
  ModelArrays changed = test::fitted_model("robust");
  changed["contact_likelihood"].data[7] *= 2.0;
  EXPECT_THAT(complaint_of([&] { load_estimator(file("changed.npz", changed)); }),
              HasSubstr("changed.npz: its numbers are not those that were fitted"));
}

TEST_F(LoadEstimator, IgnoresOtherArraysBesideAGrid) {
  ModelArrays arrays = test::fitted_model("robust");
  arrays["my_notes"] = {{2}, {1.0, 2.0}};
  EXPECT_EQ(beliefs_of(*load_estimator(file("m.npz", arrays))),
            beliefs_of(*make_estimator(test::fitted_model("robust"))));
}

TEST_F(LoadEstimator, LoadsTheMetadata) {
  const ModelMetadata metadata = load_metadata(file("m.npz", test::fitted_model("nmn", "tall")));
  EXPECT_EQ(metadata.estimator, "nmn");
  EXPECT_EQ(metadata.robot, "tall");
  EXPECT_EQ(metadata.configuration, default_configuration("nmn", 1000.0));
}

TEST_F(LoadEstimator, HeadersOfModelsAlwaysHaveMetadata) {
  const auto grid = file("grid.npz", test::fitted_arrays("robust"));
  EXPECT_THAT(complaint_of([&] { logs::load_model_for(grid, {}); }),
              HasSubstr("grid.npz: has no metadata"));
  const Model model = logs::load_model_for(grid, {"reference", 1000.0, "upkie"});
  EXPECT_THAT(logs::header_of_model(model, "grid.npz", "grid"),
              AllOf(HasSubstr("inline constexpr CompiledArray grid[] = {"),
                    HasSubstr("for 'reference' at 1000 Hz on the robot 'upkie'"),
                    HasSubstr("sample_rate: 1000\\n\"")));
}

TEST_F(LoadEstimator, ThrowsNothingButInputErrorsAboutPaths) {
  namespace fs = std::filesystem;
  fs::create_symlink("b.npz", folder_ / "a.npz");
  fs::create_symlink("a.npz", folder_ / "b.npz");
  fs::create_symlink("/dev/zero", folder_ / "zero.npz");
  ASSERT_EQ(::mkfifo((folder_ / "pipe.npz").c_str(), 0600), 0);
  const fs::path m = file("m.npz", test::fitted_model("robust"));
  fs::create_directories(folder_ / "locked");
  fs::copy_file(m, folder_ / "locked" / "m.npz");
  fs::permissions(folder_ / "locked", fs::perms::none);
  const bool is_root =
      fs::exists(folder_ / "locked" / "m.npz", *std::make_unique<std::error_code>());
  for (const fs::path& path :
       {folder_ / "a.npz", folder_ / std::string(300, 'x'), folder_ / "zero.npz",
        folder_ / "pipe.npz", m / "below.npz", fs::path(""), fs::path(std::string(5000, 'y'))}) {
    EXPECT_THAT(complaint_of([&] { load_estimator(path); }), HasSubstr(path.string() + ": "))
        << path;
    EXPECT_THAT(complaint_of([&] { load_metadata(path); }), HasSubstr(path.string() + ": "))
        << path;
  }
  if (!is_root) {
    EXPECT_THAT(complaint_of([&] { load_estimator(folder_ / "locked" / "m.npz"); }),
                HasSubstr("cannot be opened"));
  }
  fs::permissions(folder_ / "locked", fs::perms::owner_all);
}

}  // namespace
}  // namespace touchdown
