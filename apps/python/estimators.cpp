#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

#include "apps/python/arrays.hpp"
#include "apps/python/long_call.hpp"
#include "apps/python/mapped_loop.hpp"
#include "apps/python/module.hpp"
#include "apps/python/recording_arrays.hpp"
#include "apps/python/signal_arrays.hpp"
#include "core/error.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/logs/estimator.hpp"
#include "experiments/logs/fit.hpp"
#include "logs/sample_times.hpp"
#include "logs/signals_from.hpp"

namespace touchdown::python {

namespace {

namespace fs = std::filesystem;

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

/// The axes of an IMU: three names, or the rows of a rotation. None: nothing.
std::optional<Eigen::Matrix3d> axes_of(const py::object& given) {
  if (given.is_none()) return std::nullopt;
  const auto array = py::array_t<double>::ensure(given);
  PyErr_Clear();  // names are no numbers
  if (array && array.ndim() == 2 && array.shape(0) == 3 && array.shape(1) == 3) {
    const auto numbers = array.unchecked<2>();
    Eigen::Matrix3d axes;
    for (Eigen::Index row = 0; row < 3; ++row) {
      for (Eigen::Index column = 0; column < 3; ++column) axes(row, column) = numbers(row, column);
    }
    return axes;
  }
  std::vector<std::string> names;
  if (!array && py::isinstance<py::sequence>(given)) {
    for (const py::handle name : given) names.push_back(py::str(name));
  }
  const Eigen::Matrix3d axes =
      names.size() == 3 ? signed_axes({names[0], names[1], names[2]}) : Eigen::Matrix3d::Zero();
  if (axes.isZero()) {
    throw InputError(
        "axes: expected the IMU's axes that point back, left and down, such as [\"-x\", \"y\", "
        "\"-z\"]: a right-handed order of x, y and z, each with or without a minus, or a rotation "
        "with three rows");
  }
  return axes;
}

/// A running estimator. Only one thread at a time may use it, because `run` releases Python's lock.
/// Errors: `InputError` if another thread uses it.
class Estimator {
 public:
  /// `axes` are those of the IMU, `mapping` a file that states all conventions of the signals.
  Estimator(experiments::LogEstimator source, double sample_rate,
            const std::optional<Eigen::Matrix3d>& axes, const std::optional<fs::path>& mapping)
      : source_(std::move(source)), rate_(sample_rate), estimator_(source_.make(sample_rate)) {
    if (axes && mapping) throw InputError("axes: the mapping states them (`imu.axes`)");
    if (axes) imu_.axes = *axes;
    check_assembly_config(imu_);
    if (mapping) loop_.emplace(*mapping, sample_rate);
  }

  const std::string& name() const { return source_.entry.name; }
  double sample_rate() const { return rate_; }

  void reset() {
    const ExclusiveUse use(busy_);
    reset_state();
  }

  Belief update_from_spine(const py::dict& spine, double ground_velocity_command) {
    if (loop_ || !imu_.axes.isIdentity()) {
      throw InputError(
          "update_from_spine: a spine has Upkie's conventions: expected an estimator "
          "without axes and mapping");
    }
    const ExclusiveUse use(busy_);
    const double time = static_cast<double>(steps_++) / rate_;
    const Signals step = logs::signals_from(observation_of(spine, time), ground_velocity_command);
    add_time(step.time);
    return estimator_->update(step);
  }

  Belief update(const py::object& signals, bool gravity_included) {
    const AssemblyConfig imu = with_gravity(gravity_included);
    const ExclusiveUse use(busy_);
    const Signals step = loop_ ? loop_->next(signals)
                               : SignalArrays(signals, needs_of(source_.entry), imu, true).at(0);
    ++steps_;
    add_time(step.time);
    return estimator_->update(step);
  }

  py::dict run(const py::object& arrays, bool gravity_included) {
    const AssemblyConfig imu = with_gravity(gravity_included);
    if (loop_) {
      const ExclusiveUse use(busy_);
      const std::vector<Signals> signals = loop_->all(arrays);
      std::vector<double> times;
      for (const Signals& step : signals) times.push_back(step.time);
      require_rate(logs::typical_step(times));
      return run_over(signals.size(), [&](std::size_t k) { return &signals[k]; });
    }
    const SignalArrays signals(arrays, needs_of(source_.entry), imu);
    require_rate(signals.period());
    const ExclusiveUse use(busy_);
    if (py::hasattr(arrays, "info")) {  // it names its robot
      estimator_ = source_.make(rate_, info_of(arrays.attr("info").cast<py::dict>()));
    }
    Signals step;
    return run_over(signals.steps(), [&](std::size_t k) {
      if (!signals.has_record(k)) return static_cast<const Signals*>(nullptr);
      step = signals.at(k);
      return static_cast<const Signals*>(&step);
    });
  }

 private:
  /// The conventions of the IMU, for an acceleration that includes gravity or does not.
  AssemblyConfig with_gravity(bool is_included) const {
    if (is_included && loop_) {
      throw InputError(
          "gravity_included: the mapping states the acceleration "
          "(`imu.proper_acceleration`)");
    }
    AssemblyConfig imu = imu_;
    if (is_included) imu.acceleration = AccelerationSource::proper;
    return imu;
  }

  /// `signals_at` returns null for steps without a record, where the last belief stays.
  template <typename SignalsAt>
  py::dict run_over(std::size_t count, const SignalsAt& signals_at) {
    std::vector<Belief> beliefs(count);
    reset_state();
    long_call([&](const std::atomic<bool>& stop) {
      for (std::size_t k = 0; k < beliefs.size(); ++k) {
        if (stop) {
          reset_state();
          throw Stopped("stopped; the estimator was reset");
        }
        if (const Signals* signals = signals_at(k)) {
          beliefs[k] = estimator_->update(*signals);
        } else if (k > 0) {
          beliefs[k] = beliefs[k - 1];
        }
      }
    });
    steps_ = beliefs.size();
    return arrays_of(std::move(beliefs));
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
    if (loop_) loop_->reset();
    steps_ = 0;
    first_times_.clear();
  }

  /// Refuses a loop at another sample rate, once its first steps show it.
  void add_time(double time) {
    constexpr std::size_t enough = 50;  // most of them follow each other without a pause
    if (first_times_.size() == enough || !std::isfinite(time)) return;
    first_times_.push_back(time);
    if (first_times_.size() == enough) require_rate(logs::typical_step(first_times_));
  }

  /// Refuses runs at another sample rate. A clock may jitter.
  void require_rate(const std::optional<double>& period) const {
    if (!period || (*period * rate_ > 0.8 && *period * rate_ < 1.25)) return;
    if (const std::string unit = logs::unit_of_step(*period, 1.0 / rate_); !unit.empty()) {
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
  AssemblyConfig imu_;              ///< the frames of the IMU, without a mapping
  std::optional<MappedLoop> loop_;  ///< with one
  std::size_t steps_ = 0;
  std::vector<double> first_times_;  ///< of the steps of `update` (s)
  std::atomic<bool> busy_ = false;
};

/// A property of both wheels.
auto both(const auto& of) {
  return [of](const Belief& belief) {
    return py::make_tuple(of(belief.wheel[0]), of(belief.wheel[1]));
  };
}

void add_belief(py::module_& module) {
  py::class_<Belief>(
      module, "Belief",
      "An estimator's belief after one step: `p_contact` and `contact` of the left and the right "
      "wheel, `p_any_wheel`, `p_both_wheels`. `load` and `load_deviation` are the normal force on "
      "each wheel and its standard deviation (N), NaN where it is not known. `status` reports "
      "whether the signals were usable: "
      "\"good\", \"invalid\", \"gap\", \"frozen\" or \"degraded\"; `unusable` names the first "
      "signal that is NaN "
      "or "
      "beyond its bound, if any (\"left hip position\").")
      .def_property_readonly("p_contact", both([](auto& wheel) { return wheel.p_contact; }))
      .def_property_readonly("contact", both([](auto& wheel) { return wheel.contact; }))
      .def_property_readonly("load", both([](auto& wheel) { return wheel.load.force; }))
      .def_property_readonly("load_deviation",
                             both([](auto& wheel) { return wheel.load.deviation; }))
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

void add_estimator(py::module_& module) {
  using namespace py::literals;  // NOLINT(google-build-using-namespace)
  py::class_<Estimator>(
      module, "Estimator",
      "An estimator by name (`estimators()` lists them), with its model if it is fitted.\n\n"
      "name: without it, the estimator of the model\n"
      "model: a result of `fit`, or the path of a file that `touchdown fit` wrote; without name "
      "and model, load_filter, which needs the robot alone\n"
      "sample_rate: steps per second of its signals (Hz); other times of theirs are refused\n"
      "robot: name or file of the robot; a file gives the leg geometry\n"
      "transfer: allow another robot than the model was fitted for\n"
      "axes: how the IMU is mounted, if not as Upkie's (x back, y left, z down): the names of its "
      "axes that point back, left and down ([\"-x\", \"y\", \"-z\"] for x forward, y left, z up), "
      "or "
      "three rows with these directions in its own axes\n"
      "mapping: path of the mapping file that also converts this robot's logs. `update` and `run` "
      "then take the robot's own numbers by the names in the file, with its order, signs, zeros, "
      "units and axes")
      .def(py::init([](const std::string& name, const py::object& model, double sample_rate,
                       const std::string& robot, bool transfer, const py::object& axes,
                       const std::optional<fs::path>& mapping) {
             experiments::LogEstimatorRequest request{
                 .name = name, .robot = experiments::robot_called(robot), .transfer = transfer};
             if (py::isinstance<Model>(model)) {
               return std::make_unique<Estimator>(
                   with_model(std::move(request), model.cast<const Model&>()), sample_rate,
                   axes_of(axes), mapping);
             }
             if (!model.is_none()) request.model = path_of(model);
             return std::make_unique<Estimator>(experiments::log_estimator(std::move(request)),
                                                sample_rate, axes_of(axes), mapping);
           }),
           "name"_a = "", "model"_a = py::none(), "sample_rate"_a = 1000.0, "robot"_a = "",
           "transfer"_a = false, "axes"_a = py::none(), "mapping"_a = py::none())
      .def_property_readonly("name", &Estimator::name)
      .def_property_readonly("sample_rate", &Estimator::sample_rate)
      .def("reset", &Estimator::reset, "Return to the initial belief: P(contact) is 0.5.")
      .def(
          "update", &Estimator::update, "signals"_a, "gravity_included"_a = false,
          "Update the belief by one step. signals: `time` (s), `position` (6, rad), `velocity` (6, "
          "rad/s), `torque` (6, "
          "N·m) of the joints, left hip, knee, wheel, then right; `linear_acceleration` (3, m/s², "
          "without gravity) and `angular_velocity` (3, rad/s) in the IMU's frame (x back, y left, "
          "z down); "
          "`vertical_acceleration` (m/s², upwards), `ground_velocity_command` (m/s, of the step "
          "before). Only the signals that this estimator uses are needed. Without "
          "`vertical_acceleration` it follows from `linear_acceleration` and `orientation` (4: w x "
          "y z, from the IMU to a frame with z down); with gravity_included, the orientation also "
          "takes gravity out of `linear_acceleration`. NaN marks a failed sensor. load_filter "
          "also uses the joints' commands of the step before: "
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
           "`p_any_wheel` and `p_both_wheels` (steps,), `status` (steps,): numbers of `STATUS`, "
           "`load` and `load_deviation` (steps, 2, N).")
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
  add_estimator(module);
  module.def("estimators", &estimators);
}

}  // namespace touchdown::python
