#include "estimator/models/make_estimator.hpp"

#include <array>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/bayes/filter.hpp"
#include "estimator/evidence/filter.hpp"
#include "estimator/models/configuration.hpp"
#include "tests/complaint.hpp"
#include "tests/estimator/models/models.hpp"

namespace touchdown {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string complaint_about(const ModelArrays& arrays, const ModelUse& use = {}) {
  return complaint_of([&] { make_estimator(arrays, use); });
}

/// The probabilities and decisions of an estimator for a run with flights.
std::vector<double> beliefs_of(ContactEstimator& estimator, std::size_t steps = 1500) {
  std::vector<double> all;
  for (const Signals& s : test::drops(steps)) {
    const Belief& b = estimator.update(s);
    for (const WheelBelief& wheel : b.wheel) {
      all.push_back(wheel.p_contact);
      all.push_back(wheel.contact ? 1.0 : 0.0);
    }
  }
  return all;
}

TEST(MakeEstimator, MakesTheOneThatTheModelWasFittedFor) {
  const ModelArrays arrays = test::fitted_model("robust");
  BayesFilter expected(measurement_model_of(arrays), BayesFilterConfig::robust());
  EXPECT_EQ(beliefs_of(*make_estimator(arrays)), beliefs_of(expected));
  EXPECT_EQ(beliefs_of(*make_estimator(arrays, {"robust", 1000.0, "upkie"})), beliefs_of(expected));
}

TEST(MakeEstimator, UsesTheConfigurationInTheMetadata) {
  ModelArrays arrays = test::fitted_arrays("robust");
  BayesFilterConfig config = BayesFilterConfig::robust();
  config.threshold = 0.6;
  config.transition.switch_sigmoid = {20.0, 3.0};
  config.transition.power = PowerMeasure::energy;
  add_metadata(arrays, {"robust", 1000.0, "", text_of(config), ""});
  BayesFilter expected(measurement_model_of(arrays), config);
  EXPECT_EQ(beliefs_of(*make_estimator(arrays)), beliefs_of(expected));
}

TEST(MakeEstimator, ReportsMismatchesWithTheModel) {
  const ModelArrays robust = test::fitted_model("robust");
  EXPECT_EQ(complaint_about(robust, {.estimator = "reference"}),
            "was fitted for 'robust', which 'reference' cannot use");
  EXPECT_EQ(complaint_about(robust, {.sample_rate = 500.0}),
            "was fitted at 1000 Hz, not at 500 Hz");
  EXPECT_EQ(complaint_about(robust, {.robot = "tall"}),
            "was fitted to the robot 'upkie', not to 'tall'");
  EXPECT_THAT(complaint_about(robust, {.estimator = "robst"}),
              HasSubstr("no model is fitted for 'robst': expected one of robust, reference"));
  // One fit serves both of these, and the robot of the second is unknown.
  make_estimator(robust, {.estimator = "measurement_only"});
  make_estimator(test::fitted_model("paper", ""), {.estimator = "paper_rms", .robot = "tall"});
}

TEST(MakeEstimator, AcceptsAModelWithoutMetadataIfTheCallerNamesTheRest) {
  const ModelArrays grid = test::fitted_arrays("reference");
  EXPECT_EQ(complaint_about(grid),
            "has no metadata, being older or from another program: name the estimator that it was "
            "fitted for, and its sample_rate (Hz)");
  EXPECT_THAT(complaint_about(grid, {.sample_rate = 1000.0}), HasSubstr("name the estimator"));
  EXPECT_THAT(complaint_about(test::fitted_arrays("force_kinematics")),
              HasSubstr("name its sample_rate (Hz)"));
  EXPECT_THAT(complaint_about(test::fitted_arrays("phase"), {.estimator = "robust"}),
              HasSubstr("was fitted for 'phase'"));
  BayesFilter expected(measurement_model_of(grid), BayesFilterConfig::reference());
  EXPECT_EQ(beliefs_of(*make_estimator(grid, {.estimator = "reference", .sample_rate = 1000.0})),
            beliefs_of(expected));
  make_estimator(test::fitted_arrays("phase"));  // its arrays imply its name and rate
  make_estimator(test::fitted_arrays("nmn"), {.sample_rate = 1000.0});
}

TEST(MakeEstimator, RefusesChangedNumbers) {
  ModelArrays arrays = test::fitted_model("force_kinematics");
  arrays["force_mean"].data[0] += 1e-9;
  EXPECT_THAT(complaint_about(arrays), HasSubstr("its numbers are not those that were fitted"));
  arrays = test::fitted_model("force_kinematics");
  arrays["new"] = {{1}, {0.0}};
  EXPECT_THAT(complaint_about(arrays), HasSubstr("not those that were fitted"));
}

TEST(MakeEstimator, RefusesInvalidMetadata) {
  const auto with = [](const std::string& from, const std::string& to) {
    ModelArrays arrays = test::fitted_model("force_kinematics");
    const std::string name(metadata_array);
    std::string text = text_of_array(arrays.at(name), name);
    text.replace(text.find(from), from.size(), to);
    arrays[name] = array_of_text(text);
    return complaint_about(arrays);
  };
  EXPECT_EQ(with("format: 1", "format: 2"), "metadata: format 2: expected 1");
  EXPECT_EQ(with("units: SI", "units: kgf"), "metadata: units kgf: expected SI");
  EXPECT_THAT(with("robot: upkie", "rabbit: upkie"),
              HasSubstr("'rabbit: upkie' is not understood"));
  EXPECT_THAT(with("sample_rate: 1000", "sample_rate: fast"), HasSubstr("is not understood"));
  EXPECT_THAT(with("sample_rate: 1000", "sample_rate: -1"), HasSubstr("positive sample_rate"));
  EXPECT_THAT(with("robot: upkie", "robot: other"), HasSubstr("fingerprint"));
  ModelArrays arrays = test::fitted_arrays("force_kinematics");
  add_metadata(arrays, {"force_kinematics", 1000.0, "", {{"speed", "1"}}, ""});
  EXPECT_THAT(complaint_about(arrays), HasSubstr("configuration.speed: is not known"));
  add_metadata(arrays, {"force_kinematics", 1000.0, "", {{"threshold", "high"}}, ""});
  EXPECT_THAT(complaint_about(arrays),
              HasSubstr("configuration.threshold: 'high' is no value for it"));
}

TEST(MakeEstimator, RefusesARobotNameOfSeveralLines) {
  EXPECT_THAT(complaint_of([] { test::fitted_model("force_kinematics", "a\nunits: kgf"); }),
              HasSubstr("expected a name of one line"));
}

TEST(MakeEstimator, GivesTheSameFitTheSameFingerprint) {
  const auto fingerprint = [](const ModelArrays& arrays) {
    return metadata_of(arrays)->fingerprint;
  };
  const std::string robust = fingerprint(test::fitted_model("robust"));
  EXPECT_EQ(robust.size(), 16U);
  EXPECT_EQ(fingerprint(test::fitted_model("robust")), robust);
  EXPECT_NE(fingerprint(test::fitted_model("robust", "tall")), robust);
  EXPECT_NE(fingerprint(test::fitted_model("paper")), robust);
  ModelArrays without_derived = test::fitted_model("robust");
  without_derived.erase(std::string(derived_array));
  EXPECT_EQ(fingerprint(without_derived), robust);
}

TEST(MakeEstimator, CallersConfigurationReplacesThatOfTheMetadata) {
  const ModelArrays arrays = test::fitted_model("robust");
  BayesFilterConfig config = BayesFilterConfig::robust();
  config.threshold = 0.3;
  BayesFilter expected(measurement_model_of(arrays), config);
  const ModelUse use{.configuration = {{"threshold", "0.3"}}};
  EXPECT_EQ(beliefs_of(*make_estimator(arrays, use)), beliefs_of(expected));
  EXPECT_NE(beliefs_of(*make_estimator(arrays)), beliefs_of(expected));
  EXPECT_THAT(complaint_about(arrays, {.configuration = {{"thresold", "0.3"}}}),
              AllOf(HasSubstr("has no 'thresold'"), HasSubstr("threshold")));
  EXPECT_THAT(complaint_about(arrays, {.configuration = {{"threshold", "low"}}}),
              HasSubstr("'low' is no value for it"));
}

TEST(MakeEstimator, UsesTheLegsOfAnotherRobot) {
  const ModelArrays arrays = test::fitted_model("force_kinematics");
  LegGeometry longer;
  longer.upper_length = 0.3;
  std::vector<Signals> stream = test::drops(200);
  const auto left = [&](const ModelUse& use) {
    const auto estimator = make_estimator(arrays, use);
    for (Signals& s : stream) {
      s.leg[0].hip = {0.4, 0.0, 0.5};
      s.leg[0].knee.position = -0.8;
      estimator->update(s);
    }
    return estimator->update(stream.back()).wheel[0].p_contact;
  };
  EXPECT_NE(left({.geometry = longer}), left({}));
  EXPECT_EQ(left({.geometry = LegGeometry{}}), left({}));
}

TEST(Configuration, ReadsBackFromItsText) {
  for (const char* name : {"robust", "reference", "paper", "paper_rms"}) {
    BayesFilterConfig expected =
        name == std::string("paper_rms") ? BayesFilterConfig::paper_rms() : test::named(name);
    BayesFilterConfig read;
    read.measurement.fit = expected.measurement.fit;  // not part of the text
    configure(read, text_of(expected));
    EXPECT_EQ(read, expected) << name;
  }
  PhaseFilterConfig phase;
  phase.torque_exponent = 0.1 + 0.2;
  phase.noise_floor = {1.0 / 3.0, 0.5, 0.7};
  PhaseFilterConfig phase_read;
  configure(phase_read, text_of(phase));
  EXPECT_EQ(phase_read, phase);
  DecisionConfig decision;
  decision.geometry.wheel_inertia = 1.0 / 3e4;
  decision.point.leave_below = 0.6;
  decision.point.settle_after = 0.03;
  decision.geometry.upper_mass = 0.7;
  decision.geometry.robot_mass = 8.1;
  decision.guard.frozen_after = 0.0;
  DecisionConfig decision_read;
  configure(decision_read, text_of(decision));
  EXPECT_EQ(decision_read, decision);
}

TEST(Configuration, ReadsOlderFilesOfDecisionNetworks) {
  DecisionConfig read;
  configure(read, {{"wheel_inertia", "0.125"}});
  EXPECT_EQ(read.geometry.wheel_inertia, 0.125);
  EXPECT_EQ(text_of(read).at("wheel_inertia"), "0.125");
  EXPECT_EQ(read.geometry.robot_mass, LegGeometry{}.robot_mass) << "which they do not contain";
  // Configurations of other estimators contain neither the wheel's inertia nor the robot's mass.
  EXPECT_FALSE(text_of(ForceKinematicsConfig{}).contains("geometry.wheel_inertia"));
  EXPECT_FALSE(text_of(ForceKinematicsConfig{}).contains("robot_mass"));
}

TEST(MakeEstimator, MakesALoadFilterOfARobotsGeometryAlone) {
  LegGeometry legs;
  legs.upper_length = 0.2;
  legs.robot_mass = 7.0;
  legs.knee_armature = 0.003;
  legs.hip_torque_limit = 9.0;
  const ModelArrays file = arrays_of(load_filter_model(legs, 1000.0, "other"));
  LoadFilter expected({.geometry = legs});
  const std::vector<double> beliefs = beliefs_of(expected);
  EXPECT_EQ(beliefs_of(*make_estimator(file)), beliefs);
  EXPECT_EQ(beliefs_of(*make_estimator(file, {.sample_rate = 1000.0, .robot = "other"})), beliefs);
  EXPECT_THAT(complaint_about(file, {.configuration = {{"speed", "1"}}}), HasSubstr("no 'speed'"));
  EXPECT_NO_THROW(make_estimator(file, {.sample_rate = 200.0})) << "its constants are in seconds";
  EXPECT_THAT(complaint_about(file, {.robot = "upkie"}), HasSubstr("'other'"));
  LoadFilterConfig config;
  configure(config, metadata_of(file)->configuration);
  EXPECT_EQ(config.geometry, legs);
}

TEST(Configuration, KeepsTheWindowsLengthAtAnotherRate) {
  EXPECT_EQ(at_rate(BayesFilterConfig::robust(), 200.0).transition.window, 26);
  EXPECT_EQ(default_configuration("robust", 500.0).at("transition.window"), "64");
  ModelArrays arrays = test::fitted_arrays("robust");
  add_metadata(arrays, {"robust", 500.0, "", default_configuration("robust", 500.0), ""});
  BayesFilter expected(measurement_model_of(arrays), at_rate(BayesFilterConfig::robust(), 500.0));
  EXPECT_EQ(beliefs_of(*make_estimator(arrays)), beliefs_of(expected));
}

TEST(CompiledModel, BelievesTheSameToTheBit) {
  for (const std::string name : {"robust", "phase", "nmn", "force_kinematics", "decision_network",
                                 "evidence_curves", "evidence_curves_quiet"}) {
    const ModelArrays arrays = test::fitted_model(name);
    std::vector<std::vector<float>> floats;
    std::vector<std::string> texts;
    floats.reserve(arrays.size());
    texts.reserve(arrays.size());
    std::vector<CompiledArray> compiled;
    for (const auto& [key, array] : arrays) {
      CompiledArray entry{
          key.c_str(),       array.rows(), array.shape.size() < 2 ? 0 : array.columns(),
          array.data.data(), nullptr,      nullptr};
      if (key == metadata_array || key == estimator_array) {
        texts.push_back(text_of_array(array, key));
        entry.doubles = nullptr;
        entry.text = texts.back().c_str();
      } else if (key.ends_with("log_density")) {
        floats.emplace_back(array.data.begin(), array.data.end());
        entry.doubles = nullptr;
        entry.floats = floats.back().data();
      }
      compiled.push_back(entry);
    }
    EXPECT_EQ(beliefs_of(*make_estimator(compiled), 400), beliefs_of(*make_estimator(arrays), 400))
        << name;
  }
}

TEST(MakeEstimator, TakesTheBoundsOfSignalsFromMetadataAndUse) {
  ModelArrays arrays = test::fitted_model("robust");
  Signals fast = test::drops(1).front();
  fast.leg[0].hip.velocity = 60.0;
  fast.leg[1].knee.torque = 50.0;
  EXPECT_EQ(make_estimator(arrays)->update(fast).unusable, SignalIndex::none);
  const auto limited = make_estimator(arrays, {.configuration = {{"bounds.velocity", "50"}}});
  EXPECT_EQ(to_text(limited->update(fast).unusable), "left hip velocity");

  ModelMetadata metadata = metadata_of(arrays).value();
  metadata.configuration["bounds.torque"] = "40";
  add_metadata(arrays, metadata);
  const Belief belief = make_estimator(arrays)->update(fast);
  EXPECT_EQ(to_text(belief.unusable), "right knee torque");
  EXPECT_EQ(belief.status, SignalStatus::invalid);
  EXPECT_EQ(
      to_text(make_estimator(arrays, {.estimator = "measurement_only"})->update(fast).unusable),
      "right knee torque");
  EXPECT_EQ(
      make_estimator(arrays, {.configuration = {{"bounds.torque", "70"}}})->update(fast).unusable,
      SignalIndex::none);
  for (const char* const value : {"0", "-1", "nan", "inf", "many"}) {
    EXPECT_NE(complaint_about(test::fitted_model("robust"),
                              {.configuration = {{"bounds.velocity", value}}}),
              "no complaint")
        << value;
  }
  EXPECT_THAT(
      complaint_about(test::fitted_model("robust"), {.configuration = {{"bounds.speed", "1"}}}),
      HasSubstr("has no 'bounds.speed'"));
}

TEST(Configuration, HasTheServoLoadOnlyWhereTheModelHasIt) {
  LegGeometry legs;
  legs.hip_friction = 0.06;
  legs.knee_friction = 0.07;
  legs.position_resolution = 1e-3;
  for (const char* const name : {"evidence_curves_quiet", "decision_network", "evidence_curves"}) {
    const ConfigurationText without = default_configuration(name, 1000.0, legs);
    for (const char* const key :
         {"servo_load", "hip_friction", "knee_friction", "position_resolution"}) {
      EXPECT_FALSE(without.contains(key)) << name << key;
    }
    DecisionConfig read;
    configure(read, default_configuration(name, 1000.0, legs, true));
    EXPECT_TRUE(read.servo_load);
    EXPECT_EQ(read.geometry, legs);
  }
  // Other estimators have no such channel.
  EXPECT_EQ(default_configuration("phase", 1000.0, legs, true),
            default_configuration("phase", 1000.0, legs));
}

TEST(Parameters, OfModelsWithTheServoLoadReadBack) {
  EvidenceModel curves = test::random_curves(5);
  DecisionModel network = test::random_model(6);
  for (const Parameters& without : {parameters_of(curves), parameters_of(network)}) {
    for (const auto& [name, values] : without) EXPECT_EQ(name.find("servo"), std::string::npos);
  }
  network.servo_weight.assign(servo_weights, 0.25F);
  curves.servo_curve.resize(2 * decision_scales);
  curves.servo_seen.resize(2 * decision_scales);
  for (std::size_t i = 0; i < curves.servo_curve.size(); ++i) {
    curves.servo_curve[i].fill(static_cast<float>(i));
    curves.servo_seen[i] = {-1.0F, static_cast<float>(i)};
  }
  EXPECT_EQ(decision_model_of(parameters_of(network)), network);
  Parameters parameters = parameters_of(curves);
  EXPECT_EQ(evidence_curve_sets_of(parameters), curves);
  EXPECT_TRUE(parameters.contains("curves_servo_load"));
  EXPECT_TRUE(parameters.contains("curves_other_servo_load"));
  // One part without the other is refused.
  parameters.erase("curves_other_servo_load");
  EXPECT_THROW(static_cast<void>(evidence_curve_sets_of(parameters)), InputError);
}

OperatingPoint point_in(const ConfigurationText& configuration) {
  DecisionConfig config;
  configure(config, configuration);
  return config.point;
}

TEST(EvidenceCurves, OfFilesWithoutATimeDecideByThresholdsAlone) {
  ConfigurationText older = default_configuration("evidence_curves", 1000.0);
  older.erase("settle_at");
  older.erase("settle_after");
  EXPECT_EQ(point_in(older).settle_after, 0.0);
  EXPECT_EQ(point_in(older).return_above, balanced_point.return_above);
}

TEST(EvidenceCurves, HaveTwoOperatingPointsOfOneModel) {
  EXPECT_EQ(point_in(default_configuration("evidence_curves", 1000.0)), balanced_point);
  EXPECT_EQ(point_in(default_configuration("evidence_curves_quiet", 1000.0)), quiet_point);
  EXPECT_TRUE(share_fit("evidence_curves", "evidence_curves_quiet"));

  // Each makes the other from its model, which keeps the rest of the configuration.
  LegGeometry legs;
  legs.upper_length = 0.2;
  for (const std::string name : {"evidence_curves", "evidence_curves_quiet"}) {
    ModelArrays arrays = test::fitted_arrays(name);
    add_metadata(arrays, {name, 1000.0, "", default_configuration(name, 1000.0, legs), ""});
    const EvidenceCurveSets model = evidence_curve_sets_of(parameters_of(arrays));
    for (const std::string made : {"evidence_curves", "evidence_curves_quiet"}) {
      const OperatingPoint& point = made == "evidence_curves" ? balanced_point : quiet_point;
      EvidenceCurves expected(model, {.geometry = legs, .point = point});
      EXPECT_EQ(beliefs_of(*make_estimator(arrays, {.estimator = made})), beliefs_of(expected))
          << name << " as " << made;
    }
  }
}

}  // namespace
}  // namespace touchdown
