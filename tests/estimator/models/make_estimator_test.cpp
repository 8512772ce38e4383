#include "estimator/models/make_estimator.hpp"

#include <array>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/bayes/filter.hpp"
#include "estimator/force/load_filter.hpp"
#include "estimator/models/configuration.hpp"
#include "tests/complaint.hpp"
#include "tests/estimator/models/models.hpp"

namespace touchdown {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

std::string complaint_about(const ModelArrays& arrays, const ModelUse& use = {}) {
  return complaint_of([&] { make_estimator(arrays, use); });
}

/// The probabilities and decisions of an estimator for a run with flights.
std::vector<double> beliefs_of(ContactEstimator& estimator, std::size_t steps = 1500) {
  std::vector<double> all;
  for (const Signals& s : test::drops_on_bent_legs(steps)) {
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
  for (const std::string name : {"load_filter", "nmn"}) {
    const ModelArrays arrays = test::fitted_arrays(name);
    EXPECT_THAT(complaint_about(arrays), HasSubstr("name its sample_rate (Hz)"));
    EXPECT_THAT(complaint_about(arrays, {.estimator = "robust", .sample_rate = 1000.0}),
                HasSubstr("was fitted for '" + name + "'"));
    make_estimator(arrays, {.sample_rate = 1000.0});
  }
  BayesFilter expected(measurement_model_of(grid), BayesFilterConfig::reference());
  EXPECT_EQ(beliefs_of(*make_estimator(grid, {.estimator = "reference", .sample_rate = 1000.0})),
            beliefs_of(expected));
}

TEST(MakeEstimator, RefusesChangedNumbers) {
  ModelArrays arrays = test::fitted_model("robust");
  arrays["contact_likelihood"].data[0] += 1e-9;
  EXPECT_THAT(complaint_about(arrays), HasSubstr("its numbers are not those that were fitted"));
  arrays = test::fitted_model("load_filter");
  arrays["new"] = {{1}, {0.0}};
  EXPECT_THAT(complaint_about(arrays), HasSubstr("not those that were fitted"));
}

TEST(MakeEstimator, RefusesInvalidMetadata) {
  const auto with = [](const std::string& from, const std::string& to) {
    ModelArrays arrays = test::fitted_model("load_filter");
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
  ModelArrays arrays = test::fitted_arrays("load_filter");
  add_metadata(arrays, {"load_filter", 1000.0, "", {{"speed", "1"}}, ""});
  EXPECT_THAT(complaint_about(arrays), HasSubstr("configuration.speed: is not known"));
  add_metadata(arrays, {"load_filter", 1000.0, "", {{"leave_below", "high"}}, ""});
  EXPECT_THAT(complaint_about(arrays),
              HasSubstr("configuration.leave_below: 'high' is no value for it"));
}

TEST(MakeEstimator, RefusesARobotNameOfSeveralLines) {
  EXPECT_THAT(complaint_of([] { test::fitted_model("load_filter", "a\nunits: kgf"); }),
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
              EndsWith("has no 'thresold' (did you mean 'threshold'?)"));
  EXPECT_THAT(complaint_about(arrays, {.configuration = {{"speed", "0.3"}}}),
              AllOf(HasSubstr("has no 'speed': expected one of "), HasSubstr("threshold")));
  for (const std::string wrong : {"low", "1e308", "nan", "-inf"}) {
    EXPECT_THAT(complaint_about(arrays, {.configuration = {{"threshold", wrong}}}),
                HasSubstr("'" + wrong + "' is no value for it: expected 0 to 1"));
  }
}

TEST(MakeEstimator, NamesANumberBeyondItsRange) {
  const std::vector<std::array<const char*, 4>> wrong = {
      {"load_filter", "leave_below", "2", "expected more than 0 and less than 1, found 2"},
      {"load_filter", "return_above", "0.001", "expected from leave_below to less than 1"},
      {"load_filter", "lead", "-1", "expected 0 or more"},
      {"load_filter", "geometry.lower_length", "0", "expected a positive number"},
      {"load_filter", "bounds.torque", "-3", "expected a positive number, found -3"},
      {"robust", "threshold", "1.5", "expected 0 to 1"},
      {"robust", "transition.switch.slope", "0", "expected a positive number"},
      {"robust", "transition.margin", "0.5", "expected 0 to less than 0.5"},
      {"paper", "guard.relaxation", "0", "expected a positive number"}};
  for (const auto& [estimator, key, value, expected] : wrong) {
    EXPECT_THAT(complaint_about(test::fitted_model(estimator), {.configuration = {{key, value}}}),
                HasSubstr(std::string(key) + ": " + expected));
  }
}

TEST(MakeEstimator, UsesTheLegsOfAnotherRobot) {
  const ModelArrays arrays = test::fitted_model("load_filter");
  LegGeometry longer;
  longer.upper_length = 0.3;
  const auto load = [&](const ModelUse& use) {
    const auto estimator = make_estimator(arrays, use);
    Belief belief;
    for (const Signals& s : test::drops_on_bent_legs(200)) belief = estimator->update(s);
    return belief.wheel[0].load.force;
  };
  EXPECT_NE(load({.geometry = longer}), load({}));
  EXPECT_EQ(load({.geometry = LegGeometry{}}), load({}));
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
  LoadFilterConfig loads;
  loads.geometry.upper_length = 0.1 + 0.2;
  loads.geometry.wheel_inertia = 1.0 / 3e4;
  loads.geometry.robot_mass = 8.1;
  loads.lead = 1.0 / 300.0;
  loads.leave_below = 0.3;
  loads.return_above = 0.6;
  loads.guard.frozen_after = 0.0;
  LoadFilterConfig loads_read;
  configure(loads_read, text_of(loads));
  EXPECT_EQ(loads_read.geometry, loads.geometry);
  EXPECT_EQ(loads_read.lead, loads.lead);
  EXPECT_EQ(loads_read.leave_below, loads.leave_below);
  EXPECT_EQ(loads_read.return_above, loads.return_above);
  EXPECT_EQ(loads_read.guard, loads.guard);
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
  for (const std::string name : {"robust", "nmn", "load_filter"}) {
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
      } else if (name == "nmn" && key.ends_with("_weight")) {
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

/// Files of earlier versions, with a few of their arrays.
TEST(MakeEstimator, RefusesModelsOfEstimatorsThatAreNoMore) {
  const auto expect_refusal = [](const ModelArrays& arrays, const std::string& name) {
    for (const ModelUse& use : {ModelUse{}, ModelUse{.sample_rate = 1000.0, .robot = "upkie"},
                                ModelUse{.estimator = "load_filter", .sample_rate = 1000.0}}) {
      EXPECT_THAT(complaint_about(arrays, use),
                  AllOf(HasSubstr("was fitted for '" + name + "', which this version"),
                        HasSubstr("load_filter")));
    }
  };
  const auto with_metadata = [](ModelArrays arrays, const std::string& name) {
    add_metadata(arrays, {name, 1000.0, "upkie", {{"leave_below", "0.6"}}, ""});
    return arrays;
  };
  for (const std::string name :
       {"evidence_curves", "evidence_curves_quiet", "decision_network", "force_kinematics"}) {
    const ModelArrays arrays = {{std::string(estimator_array), array_of_text(name)},
                                {"bias", {{1}, {0.5}}}};
    expect_refusal(arrays, name);
    expect_refusal(with_metadata(arrays, name), name);
  }
  const ModelArrays phases = {{"sample_rate", {{1}, {1000.0}}},
                              {"transition", {{2, 2}, {0.9, 0.1, 0.1, 0.9}}}};
  expect_refusal(phases, "phase");
  for (const std::string name : {"phase", "hmm", "hmm_without_memory"}) {
    expect_refusal(with_metadata(phases, name), name);
  }
}

}  // namespace
}  // namespace touchdown
