#include "recordings/models/phase_model.hpp"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "recordings/models/npz.hpp"

namespace touchdown::recordings {
namespace {

std::filesystem::path file_in_temp(const char* name) {
  return std::filesystem::path(testing::TempDir()) / name;
}

PhaseModel model() {
  PhaseModel m;
  m.sample_rate = 500.0;
  for (std::size_t i = 0; i < phase_count; ++i) {
    m.transition[i] = {};
    m.transition[i][i] = 0.75;
    m.transition[i][(i + 1) % phase_count] = 0.25;
    m.seconds[i] = 0.5 + static_cast<double>(i);
  }
  for (const double noise : {0.0, 0.5}) {
    for (const double wheel_noise : {0.0, 0.5}) {
      PhaseTorqueDensity torque{{noise, wheel_noise},
                                {std::hypot(0.1, noise), std::hypot(0.1, wheel_noise)},
                                {-2.0, 5.0, 4},
                                {-1.0, 1.0, 3},
                                {}};
      for (int i = 0; i < 4 * 3 * static_cast<int>(torque_density_count); ++i) {
        torque.log_density.push_back(-0.1F * static_cast<float>(i) -
                                     static_cast<float>(noise + 3.0 * wheel_noise));
      }
      m.torque.push_back(torque);
    }
    PhaseAccelerationDensity acceleration{noise, std::hypot(1.0, noise), {-30.0, 100.0, 5}, {}};
    for (int i = 0; i < 5 * static_cast<int>(acceleration_density_count); ++i) {
      acceleration.log_density.push_back(-0.3F * static_cast<float>(i));
    }
    m.acceleration.push_back(acceleration);
  }
  return m;
}

TEST(PhaseModelFile, ReadsBackWhatWasWritten) {
  const auto path = file_in_temp("phase_model.npz");
  const ModelProvenance provenance = {{"scenario", "stairs, hang"}, {"seed", "1: one"}};
  write_phase_model({model(), provenance}, path);
  const PhaseModelFile file = read_phase_model(path);
  EXPECT_EQ(file.provenance, provenance);
  EXPECT_EQ(file.model.sample_rate, 500.0);
  EXPECT_EQ(file.model.transition, model().transition);
  EXPECT_EQ(file.model.seconds, model().seconds);
  ASSERT_EQ(file.model.torque.size(), 4U);
  ASSERT_EQ(file.model.acceleration.size(), 2U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(file.model.torque[i].noise, model().torque[i].noise);
    EXPECT_EQ(file.model.torque[i].bandwidth, model().torque[i].bandwidth);
    EXPECT_EQ(file.model.torque[i].knee, model().torque[i].knee);
    EXPECT_EQ(file.model.torque[i].wheel, model().torque[i].wheel);
    EXPECT_EQ(file.model.torque[i].log_density, model().torque[i].log_density);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(file.model.acceleration[i].axis, model().acceleration[i].axis);
    EXPECT_EQ(file.model.acceleration[i].log_density, model().acceleration[i].log_density);
  }
}

TEST(PhaseModelFile, NamesTheError) {
  const auto path = file_in_temp("broken_phase_model.npz");
  write_phase_model({model(), {}}, path);
  const NpzArrays good = read_npz(path);
  const auto complaint_about = [&](const auto& change) {
    NpzArrays arrays = good;
    change(arrays);
    write_npz(arrays, path);
    try {
      read_phase_model(path);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no complaint");
  };
  EXPECT_NE(complaint_about([](auto& a) { a.erase("transition"); }).find("missing transition"),
            std::string::npos);
  EXPECT_NE(complaint_about([](auto& a) { a["transition"].data[0] = 0.5; }).find("rolling sum"),
            std::string::npos);
  EXPECT_NE(complaint_about([](auto& a) { a["torque_1_knee"].data[2] = 7.0; }).find("axes ask for"),
            std::string::npos);
  EXPECT_NE(complaint_about([](auto& a) { a["torque_0_knee"].data[2] = -1.0; }).find("2 points"),
            std::string::npos);
  EXPECT_NE(complaint_about([](auto& a) {
              a.erase("acceleration_0_noise");
            }).find("no acceleration density"),
            std::string::npos);
  write_atomically(path, "this is no archive");
  EXPECT_THROW(read_phase_model(path), InputError);
  EXPECT_THROW(read_phase_model(file_in_temp("no such file.npz")), InputError);
}

}  // namespace
}  // namespace touchdown::recordings
