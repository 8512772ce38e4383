#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/logs/estimator.hpp"
#include "experiments/logs/fit.hpp"
#include "python/arrays.hpp"
#include "python/long_call.hpp"
#include "python/module.hpp"
#include "python/recording_arrays.hpp"
#include "python/signal_arrays.hpp"
#include "recordings/log/byte_source.hpp"
#include "recordings/log/writer.hpp"
#include "recordings/mapping/mapped_log.hpp"
#include "recordings/model_file.hpp"
#include "recordings/sample_times.hpp"
#include "recordings/signals_from.hpp"

namespace touchdown::python {

namespace {

namespace fs = std::filesystem;

/// A fitted model with its estimator, and a report of the fit.
struct Model {
  experiments::LogEstimator estimator;
  experiments::LogFitReport report = {};

  static Model load(const fs::path& path, const std::string& estimator) {
    if (path.empty()) throw InputError("expected a model's file, found an empty path");
    return {experiments::log_estimator({.name = estimator, .model = path})};
  }
  void save(const fs::path& path) const {
    const py::gil_scoped_release unlocked;
    recordings::save_model(estimator.model, path);
  }
};

using DeclaredRun = std::pair<py::object, std::optional<bool>>;

/// Fits to recordings in memory, or to logs by path.
Model fit(const std::vector<DeclaredRun>& runs, const std::string& name, double skip,
          const scoring::LabelConfig& labels, bool servo_load) {
  std::vector<experiments::FitLog> logs;
  for (const auto& [run, contact] : runs) {
    if (py::hasattr(run, "info")) {
      logs.push_back({fmt::format("recording {}", logs.size()), contact, records_of(run)});
    } else {
      logs.push_back({path_of(run), contact});
    }
  }
  const experiments::EstimatorEntry& entry = experiments::estimator_entry(name);
  if (!entry.fits()) throw InputError(fmt::format("estimator: '{}' is not fitted", name));
  if (logs.empty()) throw InputError("fit: a recording is missing");
  return long_call([&](const std::atomic<bool>& stop) {
    Model model;
    model.estimator.entry = entry;
    model.estimator.model = experiments::fit_to_logs(
        entry, logs, {.labels = labels, .skip = skip, .servo_load = servo_load, .stop = &stop},
        model.report);
    return model;
  });
}

/// `request` has the name, the robot and whether transfer is allowed.
experiments::LogEstimator with_model(experiments::LogEstimatorRequest request, const Model& model) {
  const experiments::EstimatorEntry& fitted = model.estimator.entry;
  const std::string name = request.name;
  request.model = model.estimator.request.model;
  if (name.empty() || name == fitted.name) {
    return {fitted, model.estimator.model, std::move(request)};
  }
  const experiments::EstimatorEntry& entry = experiments::estimator_entry(name);
  if (!share_model(entry, fitted)) {
    throw InputError(
        fmt::format("the model is one of '{}', which '{}' cannot use", fitted.name, name));
  }
  return {entry, model.estimator.model, std::move(request)};
}

/// The signals that an estimator uses.
SignalNeeds needs_of(const experiments::EstimatorEntry& entry) {
  const experiments::Sensors& sensors = entry.sensors;
  const bool is_neural = entry.name.starts_with("nmn");
  const bool uses_motion = sensors.joint_position && sensors.hip_torque && sensors.joint_velocity;
  return {.torque = sensors.hip_torque || sensors.knee_torque || sensors.wheel_torque,
          .position = sensors.joint_position,
          .velocity = sensors.joint_velocity,
          .acceleration = sensors.acceleration,
          .angular_velocity = is_neural || uses_motion,
          .acceleration_vector = is_neural,
          .command = is_neural};
}

/// A running estimator. Only one thread at a time may use it, because `run` releases Python's lock.
/// Errors: `InputError` if another thread uses it.
class Estimator {
 public:
  Estimator(experiments::LogEstimator source, double sample_rate)
      : source_(std::move(source)), rate_(sample_rate), estimator_(source_.make(sample_rate)) {}

  const std::string& name() const { return source_.entry.name; }
  double sample_rate() const { return rate_; }

  void reset() {
    const ExclusiveUse use(busy_);
    reset_state();
  }

  Belief update(const Signals& signals) {
    const ExclusiveUse use(busy_);
    ++steps_;
    return estimator_->update(signals);
  }

  Belief update_from_spine(const py::dict& spine, double ground_velocity_command) {
    const double time = static_cast<double>(steps_) / rate_;
    return update(recordings::signals_from(observation_of(spine, time), ground_velocity_command));
  }

  Belief update(const py::object& signals, bool gravity_included) {
    return update(signals_of_step(signals, needs_of(source_.entry), gravity_in(gravity_included)));
  }

  py::dict run(const py::object& arrays, bool gravity_included) {
    const SignalArrays signals(arrays, needs_of(source_.entry), gravity_in(gravity_included));
    require_rate(signals);
    const ExclusiveUse use(busy_);
    std::vector<Belief> beliefs(signals.steps());
    if (py::hasattr(arrays, "info")) {  // it names its robot
      estimator_ = source_.make(rate_, info_of(arrays.attr("info").cast<py::dict>()));
    }
    reset_state();
    long_call([&](const std::atomic<bool>& stop) {
      for (std::size_t k = 0; k < beliefs.size(); ++k) {
        if (stop) {
          reset_state();
          throw Stopped("stopped; the estimator was reset");
        }
        if (signals.has_record(k)) {
          beliefs[k] = estimator_->update(signals.at(k));
        } else if (k > 0) {
          beliefs[k] = beliefs[k - 1];
        }
      }
    });
    steps_ = beliefs.size();
    return arrays_of(std::move(beliefs));
  }

 private:
  static GravityIn gravity_in(bool is_included) {
    return is_included ? GravityIn::acceleration : GravityIn::nothing;
  }

  class ExclusiveUse {
   public:
    explicit ExclusiveUse(std::atomic<bool>& busy) : busy_(busy) {
      if (busy_.exchange(true)) throw InputError("this estimator is in use in another thread");
    }
    ~ExclusiveUse() { busy_ = false; }
    ExclusiveUse(const ExclusiveUse&) = delete;
    ExclusiveUse& operator=(const ExclusiveUse&) = delete;

   private:
    std::atomic<bool>& busy_;
  };

  void reset_state() {
    estimator_->reset();
    steps_ = 0;
  }

  /// Refuses runs at another sample rate. A clock may jitter.
  void require_rate(const SignalArrays& signals) const {
    const std::optional<double> period = signals.period();
    if (!period || (*period * rate_ > 0.8 && *period * rate_ < 1.25)) return;
    if (const std::string unit = recordings::unit_of_step(*period, 1.0 / rate_); !unit.empty()) {
      throw InputError(fmt::format("signals: time: expected seconds: steps of {:.6g} look like {}",
                                   *period, unit));
    }
    throw InputError(fmt::format(
        "signals: {:.6g} steps per second, and the estimator was made for {:.6g}: make it with "
        "sample_rate={:.6g}",
        1.0 / *period, rate_, 1.0 / *period));
  }

  experiments::LogEstimator source_;
  double rate_;
  std::unique_ptr<ContactEstimator> estimator_;
  std::size_t steps_ = 0;
  std::atomic<bool> busy_ = false;
};

py::tuple both(const Belief& belief, const auto& of) {
  return py::make_tuple(of(belief.wheel[0]), of(belief.wheel[1]));
}

void add_belief(py::module_& module) {
  py::class_<Belief>(
      module, "Belief",
      "An estimator's belief after one step: `p_contact` and `contact` of the left and the right "
      "wheel, `p_any_wheel`, `p_both_wheels`. `status` reports whether the signals were usable: "
      "\"good\", \"invalid\", \"gap\", \"frozen\" or \"degraded\"; `unusable` names the first "
      "signal that is NaN "
      "or "
      "beyond its bound, if any (\"left hip position\").")
      .def_property_readonly("p_contact",
                             [](const Belief& belief) {
                               return both(belief, [](auto& wheel) { return wheel.p_contact; });
                             })
      .def_property_readonly("contact",
                             [](const Belief& belief) {
                               return both(belief, [](auto& wheel) { return wheel.contact; });
                             })
      .def_readonly("p_any_wheel", &Belief::p_any_wheel)
      .def_readonly("p_both_wheels", &Belief::p_both_wheels)
      .def_property_readonly("status", [](const Belief& belief) { return to_text(belief.status); })
      .def_property_readonly("unusable",
                             [](const Belief& belief) { return to_text(belief.unusable); })
      .def("__repr__", [](const Belief& belief) {
        return fmt::format("<Belief: p_contact ({:.6g}, {:.6g}), contact ({}, {}), {}>",
                           belief.wheel[0].p_contact, belief.wheel[1].p_contact,
                           belief.wheel[0].contact ? "True" : "False",
                           belief.wheel[1].contact ? "True" : "False", to_text(belief.status));
      });
}

void add_model(py::module_& module) {
  using namespace py::literals;  // NOLINT(google-build-using-namespace)
  py::class_<Model>(
      module, "Model",
      "A fitted model, as returned by `fit`. `estimator`: the name of its estimator; "
      "`seconds`: total duration of the fitted runs (s); `warnings`: about these runs.")
      .def_static("load", &Model::load, "path"_a, "estimator"_a = "",
                  "Read a model that `save` or `touchdown fit` wrote. Some models serve several "
                  "estimators: "
                  "name one, or get the default.")
      .def("save", &Model::save, "path"_a, "Write the model as `touchdown fit` does (.npz).")
      .def_property_readonly("estimator",
                             [](const Model& model) { return model.estimator.entry.name; })
      .def_property_readonly("seconds", [](const Model& model) { return model.report.seconds; })
      .def_property_readonly("warnings", [](const Model& model) { return model.report.warnings; })
      .def("__repr__", [](const Model& model) {
        return fmt::format("<Model of '{}'>", model.estimator.entry.name);
      });
  module.def(
      "fit",
      [](const std::vector<DeclaredRun>& runs, const std::string& estimator, double skip,
         double force_threshold, double debounce, bool servo_load) {
        return fit(runs, estimator, skip, {force_threshold, debounce}, servo_load);
      },
      "runs"_a, "estimator"_a, "skip"_a, "force_threshold"_a, "debounce"_a, "servo_load"_a);
}

void add_estimator(py::module_& module) {
  using namespace py::literals;  // NOLINT(google-build-using-namespace)
  py::class_<Estimator>(
      module, "Estimator",
      "An estimator by name (`estimators()` lists them), with its model if it is fitted.\n\n"
      "name: without it, the estimator of the model\n"
      "model: a result of `fit`, or the path of a file that `touchdown fit` wrote; without name "
      "and model, the shipped one\n"
      "sample_rate: steps per second of its signals (Hz)\n"
      "robot: name or file of the robot; a file gives the leg geometry\n"
      "transfer: allow another rate or robot than the model was fitted for")
      .def(py::init([](const std::string& name, const py::object& model, double sample_rate,
                       const std::string& robot, bool transfer) {
             experiments::LogEstimatorRequest request{
                 .name = name, .robot = experiments::robot_called(robot), .transfer = transfer};
             if (py::isinstance<Model>(model)) {
               return std::make_unique<Estimator>(
                   with_model(std::move(request), model.cast<const Model&>()), sample_rate);
             }
             if (!model.is_none()) request.model = path_of(model);
             return std::make_unique<Estimator>(experiments::log_estimator(std::move(request)),
                                                sample_rate);
           }),
           "name"_a = "", "model"_a = py::none(), "sample_rate"_a = 1000.0, "robot"_a = "",
           "transfer"_a = false)
      .def_property_readonly("name", &Estimator::name)
      .def_property_readonly("sample_rate", &Estimator::sample_rate)
      .def("reset", &Estimator::reset, "Return to the initial belief: P(contact) is 0.5.")
      .def(
          "update",
          [](Estimator& estimator, const py::object& signals, bool gravity_included) {
            return estimator.update(signals, gravity_included);
          },
          "signals"_a, "gravity_included"_a = false,
          "Update the belief by one step. signals: `time` (s), `position` (6, rad), `velocity` (6, "
          "rad/s), `torque` (6, "
          "N·m) of the joints, left hip, knee, wheel, then right; `linear_acceleration` (3, m/s², "
          "without gravity) and `angular_velocity` (3, rad/s) in the IMU's frame (x back, y left, "
          "z down); "
          "`vertical_acceleration` (m/s², upwards), `ground_velocity_command` (m/s, of the step "
          "before). Only the signals that this estimator uses are needed. Without "
          "`vertical_acceleration` it follows from `linear_acceleration` and `orientation` (4: w x "
          "y z, from the IMU to a frame with z down); with gravity_included, the orientation also "
          "takes gravity out of `linear_acceleration`. NaN marks a failed sensor. Models with the "
          "load by the servo law also use the joints' commands of the step before: "
          "`target_position`, `target_velocity`, `target_torque` (feed-forward), `target_kp` "
          "(N·m/rad), `target_kd` (N·m·s/rad), 6 each; without them the status is \"degraded\".")
      .def("update_from_spine", &Estimator::update_from_spine, "observation"_a,
           "ground_velocity_command"_a = 0.0,
           "Update the belief by one observation of Upkie's spine: `info[\"spine_observation\"]` "
           "of a "
           "gym environment, or `observation` of a log's record. A missing number, or None, is a "
           "failed sensor. Without `time`, steps are counted at the sample rate. "
           "ground_velocity_command: of the step before (m/s).")
      .def("run", &Estimator::run, "signals"_a, "gravity_included"_a = false,
           "Reset, then run on a whole run: the arrays of a `Recording`, or any others with the "
           "names "
           "and units of `update` and one row per step: `torque` (steps, 6), `orientation` (steps, "
           "4). The optional `has_record` is 0 at steps "
           "without a record, where the last belief stays. "
           "Returns `p_contact` (steps, 2) and `contact` (steps, 2, bool) of the wheels, "
           "`p_any_wheel` and `p_both_wheels` (steps,), `status` (steps,): numbers of `STATUS`.")
      .def("__repr__", [](const Estimator& estimator) {
        return fmt::format("<Estimator '{}' at {:.6g} Hz>", estimator.name(),
                           estimator.sample_rate());
      });
}

py::list estimators() {
  py::list all;
  for (const experiments::EstimatorEntry& entry : experiments::estimator_entries()) {
    py::dict about;
    about["name"] = entry.name;
    about["title"] = entry.title;
    about["summary"] = entry.summary;
    about["fitted"] = entry.fits();
    all.append(about);
  }
  return all;
}

}  // namespace

void add_estimators(py::module_& module) {
  add_belief(module);
  add_model(module);
  add_estimator(module);
  module.def("estimators", &estimators);
}

}  // namespace touchdown::python
