import copy
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import touchdown
from scene import HOP, SHORT, InFolder, hop, program

NAMES = ("time", "position", "velocity", "torque", "linear_acceleration", "angular_velocity", "vertical_acceleration",
         "ground_velocity_command")
TARGETS = ("target_position", "target_velocity", "target_torque", "target_kp", "target_kd")
# What the load filter uses, which is the default.
ALL = NAMES + TARGETS + ("orientation",)


def steps_of(run):
    """The steps of a run, as arguments of `Estimator.update`."""
    return ({name: run[name][k] for name in NAMES} for k in range(len(run["time"])))


def spine_observation(run, k):
    """One step as in info["spine_observation"] of Upkie's PyBullet backend, which has no time."""
    servos = ("left_hip", "left_knee", "left_wheel", "right_hip", "right_knee", "right_wheel")
    return {
        "base_orientation": {"pitch": run["pitch"][k], "angular_velocity": np.zeros(3)},
        "floor_contact": {"contact": True},
        "imu": {"orientation": run["orientation"][k], "angular_velocity": run["angular_velocity"][k].tolist(),
                "linear_acceleration": run["linear_acceleration"][k]},
        "number": k,
        "servo": {name: {"position": run["position"][k, i], "velocity": run["velocity"][k, i],
                         "torque": run["torque"][k, i], "temperature": 42.0, "voltage": 18.0}
                  for i, name in enumerate(servos)},
        "wheel_odometry": {"position": 0.0, "velocity": 0.0},
    }


class Fit(InFolder):
    def test_takes_a_log_by_its_path(self):
        run = hop()
        run.save("hop.mpack")
        for source in (run, "hop.mpack"):
            model = touchdown.fit(source)
            model.save(f"{type(source).__name__}.npz")
            self.assertEqual(model.estimator, "robust")
        self.assert_same_bytes("Recording.npz", "str.npz")
        self.assertAlmostEqual(model.seconds, run.steps * 0.001 - 0.3)

    def test_takes_runs_of_one_class(self):
        run = hop()
        rolls = touchdown.Recording({name: values[:1000] for name, values in run.items()}, run.info)
        hangs = touchdown.simulate("scenarios/hang.yaml", overrides={"end.duration": 1.5})
        touchdown.Estimator(model=touchdown.fit(estimator="robust", contact=rolls, no_contact=[hangs]))
        with self.assertRaisesRegex(touchdown.InputError, "no step of the logs is without contact"):
            touchdown.fit(contact=rolls)

    def test_refuses_reserved_seeds_estimators_that_need_no_fit_and_plain_dicts(self):
        run = copy.copy(hop())
        run.info = {**run.info, "seed": 900_000_001}
        self.assert_refused([
            (lambda: touchdown.fit(run, "robust"), "reserved for reporting and must not be fitted to"),
            (lambda: touchdown.fit(hop(), "load_filter"), "'load_filter' is not fitted"),
            (lambda: touchdown.fit(dict(hop())), "expected a Recording")])


class Run(InFolder):
    def test_takes_the_targets_of_servos(self):
        run = hop()
        estimator = touchdown.Estimator()
        beliefs = estimator.run(run)
        self.assertEqual([touchdown.STATUS[k] for k in beliefs["status"][:2]], ["degraded", "good"])
        self.assertNotIn(4, beliefs["status"][1:])
        without = estimator.run({name: run[name] for name in NAMES})
        self.assertEqual({touchdown.STATUS[k] for k in without["status"]}, {"degraded"})
        np.testing.assert_array_equal(run["target_position"][1:, 1], run["command_position"][:-1, 1])
        np.testing.assert_array_equal(run["target_kp"][1:, 3], 20.0 * run["command_kp_scale"][:-1, 3])
        self.assertTrue(np.isnan(run["target_kp"][0]).all())

    def test_names_the_signal_that_no_sensor_reports(self):
        run = hop()
        estimator = touchdown.Estimator("upkie_observer")
        for k, step in enumerate(steps_of(run)):
            step = {name: np.array(value, copy=True) for name, value in step.items()}
            if k == 100:
                step["velocity"][5] = 1e308
            if k == 200:
                step["position"][0] = -1e308
            belief = estimator.update(step)
            expected = {100: "right wheel velocity", 200: "left hip position"}.get(k, "")
            self.assertEqual(belief.unusable, expected)
            self.assertEqual(belief.status, "invalid" if k == 100 else "good")

    def test_of_another_robot_uses_its_legs(self):
        for robot in ("upkie_heavy", "knee_and_wheel"):
            run = touchdown.simulate(HOP, overrides={**SHORT, "robot": f"models/{robot}.yaml"})
            beliefs = touchdown.Estimator().run(run)
            plain = {key: np.asarray(value) for key, value in run.items()}
            own = touchdown.Estimator(robot=f"models/{robot}.yaml").run(plain)
            np.testing.assert_array_equal(own["p_contact"], beliefs["p_contact"])
            self.assertFalse(np.array_equal(touchdown.Estimator().run(plain)["p_contact"], beliefs["p_contact"]))

    def test_has_loads_of_estimators_with_legs(self):
        run = hop()
        whole_run = touchdown.Estimator().run(run)
        self.assertGreater(np.isfinite(whole_run["load"]).mean(), 0.9)
        beliefs = touchdown.Estimator("free_fall").run(run)
        self.assertTrue(np.isnan(beliefs["load"]).all())

    def test_equals_successive_updates(self):
        run = hop()
        estimator = touchdown.Estimator(model=touchdown.fit(run, "robust"))
        whole_run = estimator.run(run)
        estimator.reset()
        for k, step in enumerate(steps_of(run)):
            belief = estimator.update(step)
            self.assertEqual(belief.p_contact, tuple(whole_run["p_contact"][k]))
            self.assertEqual(belief.contact, tuple(whole_run["contact"][k]))
        self.assertEqual(belief.status, "good")
        # Each call starts from the initial belief.
        np.testing.assert_array_equal(estimator.run(run)["p_contact"], whole_run["p_contact"])

    def test_reads_changed_arrays_of_any_layout(self):
        run = hop()
        falling = {name: np.asfortranarray(run[name]) for name in ALL}
        # These estimators use every joint: torques, and a leg's geometry.
        for estimator in (touchdown.Estimator(model=touchdown.fit(run)), touchdown.Estimator()):
            expected = estimator.run(run)["p_contact"]
            np.testing.assert_array_equal(estimator.run(falling)["p_contact"], expected, err_msg=estimator.name)
            shifted = {**run, "torque": np.ascontiguousarray(run["torque"]) + 0.5}
            self.assertFalse(np.array_equal(estimator.run(shifted)["p_contact"], expected), estimator.name)
        falling["vertical_acceleration"] = np.full(run.steps, -9, dtype=np.int16)
        self.assertFalse(touchdown.Estimator("free_fall").run(falling)["contact"][100:].any())

    def test_keeps_its_belief_at_steps_without_a_record(self):
        run = {name: hop()[name].copy() for name in NAMES}
        run["has_record"] = np.ones(len(run["time"]))
        run["has_record"][500:1500] = 0
        run["vertical_acceleration"][500:1500] = -9.81
        beliefs = touchdown.Estimator("free_fall").run(run)
        self.assertEqual(set(beliefs["p_contact"][500:1500, 0]), {beliefs["p_contact"][499, 0]})
        # A file of a benchmark has these names.
        np.savez("exported.npz", contact=hop()["contact"], **run)
        with np.load("exported.npz") as arrays:
            np.testing.assert_array_equal(touchdown.Estimator("free_fall").run(arrays)["p_contact"],
                                          beliefs["p_contact"])

    def test_refuses_another_rate_and_arrays_that_do_not_fit(self):
        run = dict(hop())
        slow = {name: run[name][::5] for name in NAMES}
        touchdown.Estimator("free_fall", sample_rate=200.0).run(slow)
        estimate = touchdown.Estimator("free_fall").run
        self.assert_refused([
            (lambda: estimate(slow), "200 steps per second, .* make it with sample_rate=200"),
            (lambda: estimate({}), "signals: 'time' is missing"),
            (lambda: estimate({**run, "velocity": run["velocity"][1:]}),
             r"'velocity' has the shape \(3200, 6\), expected \(3201, 6\)"),
            (lambda: estimate({**run, "velocity": "fast"}), "'velocity': expected an array of numbers"),
            *((lambda factor=factor: estimate({**run, "time": factor * run["time"]}),
               f"signals: time: expected seconds: .* look like {unit}")
              for factor, unit in ((1e3, "milliseconds"), (1e6, "microseconds"), (1e9, "nanoseconds")))])

    def test_refuses_paths_that_no_system_accepts_and_names_of_no_robot(self):
        fitted = touchdown.fit(hop(), "robust")
        cases = [(lambda: touchdown.Estimator("robust", "a\0b"), "expected a path"),
                 (lambda: touchdown.check("a\0b"), "expected a path"),
                 (lambda: touchdown.fit("a\0b", "robust"), "expected a path"),
                 (lambda: touchdown.Estimator("robust"), "'robust' has to be fitted"),
                 (lambda: touchdown.Estimator("free_fall", fitted), "one of 'robust', which 'free_fall' cannot use"),
                 (lambda: touchdown.Estimator("oracle"), "does not run on logs"),
                 (lambda: touchdown.Estimator("robusd"), "did you mean 'robust'")]
        for call in (touchdown.Model.load, touchdown.check, touchdown.Recording.load):
            # Bytes of a path that are no text are shown.
            cases += [(lambda call=call: call("\udcff\udcfe.npz"), r"\\xff\\xfe\.npz: no such file"),
                      (lambda call=call: call(""), "^.* file")]
        for robot in ("upkie", "missing/robot", "/dev/null"):
            cases.append((lambda robot=robot: touchdown.check(hop(), robot=robot), "expected a robot's file"))
        self.assert_refused(cases)
        # The paper's filter and its robust form have different densities; its ablation shares them.
        self.assertEqual(touchdown.Estimator("measurement_only", fitted).name, "measurement_only")


class OwnArrays(InFolder):
    def test_need_only_the_signals_that_the_estimator_uses(self):
        run = hop()
        for name, model, used in (("free_fall", None, ("vertical_acceleration",)),
                                  ("robust", touchdown.fit(run), ("torque", "vertical_acceleration"))):
            estimator = touchdown.Estimator(name, model)
            few = {key: run[key] for key in ("time", *used)}
            np.testing.assert_array_equal(estimator.run(few)["p_contact"], estimator.run(run)["p_contact"])
            for missing in used:
                with self.assertRaisesRegex(touchdown.InputError, f"'{missing}' is missing"):
                    estimator.run({key: few[key] for key in few if key != missing})
            estimator.reset()
            self.assertEqual(estimator.update({key: few[key][0] for key in few}).status, "good")
        needed = ("time", "position", "velocity", "torque", "angular_velocity", "vertical_acceleration")
        touchdown.Estimator().run({key: run[key] for key in needed})
        for missing in needed:
            with self.assertRaisesRegex(touchdown.InputError, f"'{missing}' is missing"):
                touchdown.Estimator().run({key: run[key] for key in needed if key != missing})

    def test_have_gravity_taken_out_by_the_orientation(self):
        run = hop()
        estimator = touchdown.Estimator("free_fall")
        expected = estimator.run(run)["p_contact"]
        arrays = {"time": run["time"], "orientation": run["orientation"], "linear_acceleration": run["linear_acceleration"]}
        np.testing.assert_allclose(estimator.run(arrays)["p_contact"], expected, atol=1e-9)
        arrays["linear_acceleration"] = run["raw_linear_acceleration"]
        np.testing.assert_allclose(estimator.run(arrays, gravity_included=True)["p_contact"], expected, atol=1e-6)
        del arrays["orientation"]
        with self.assertRaisesRegex(touchdown.InputError, "'orientation' is missing"):
            estimator.run(arrays, gravity_included=True)


class Default(InFolder):
    def test_is_the_load_filter(self):
        run = hop()
        self.assertEqual(touchdown.Estimator().name, "load_filter")
        np.testing.assert_array_equal(touchdown.Estimator().run(run)["p_contact"],
                                      touchdown.Estimator("load_filter").run(run)["p_contact"])

    def test_serves_every_rate_and_robot_but_a_fitted_model_its_own_without_transfer(self):
        run = hop()
        plain = {name: run[name] for name in ALL}
        for rate in (100.0, 200.0, 1000.0, 2000.0):
            touchdown.Estimator(sample_rate=rate)
        heavy = touchdown.Estimator(robot="models/upkie_heavy.yaml").run(plain)
        self.assertFalse(np.array_equal(heavy["p_contact"], touchdown.Estimator().run(plain)["p_contact"]))
        fitted = touchdown.fit(run)
        for options, words in (({"sample_rate": 200.0}, "was fitted at 1000 Hz, not at 200 Hz"),
                               ({"robot": "models/upkie_heavy.yaml"}, "was fitted to the robot 'upkie', not to")):
            with self.assertRaisesRegex(touchdown.InputError, words):
                touchdown.Estimator(model=fitted, **options)
        touchdown.Estimator(model=fitted, transfer=True, robot="models/upkie_heavy.yaml")
        with self.assertRaisesRegex(touchdown.InputError, "was fitted at 1000 Hz, not at 200 Hz"):
            touchdown.Estimator(model=fitted, transfer=True, sample_rate=200.0)


class Check(InFolder):
    def test_is_silent_on_a_recording_and_names_what_is_wrong(self):
        run = hop()
        self.assertEqual(touchdown.check(run), [])
        run.save("hop.mpack")
        self.assertEqual(touchdown.check("hop.mpack", robot="models/upkie.xml"), [])
        for name, change, words in (("torque", lambda x: 0 * x, "torque is 0 throughout"),
                                    ("torque", lambda x: -x, "torques have the other sign"),
                                    ("velocity", lambda x: np.degrees(x), "is the velocity in deg/s"),
                                    ("position", lambda x: np.degrees(x), "is it in degrees")):
            wrong = touchdown.Recording({**run, name: change(np.array(run[name]))}, run.info)
            self.assertRegex("\n".join(touchdown.check(wrong)), words)


class Spine(InFolder):
    def test_gives_the_beliefs_of_the_recording(self):
        run = hop()
        estimator = touchdown.Estimator(model=touchdown.fit(run, "robust"))
        whole_run = estimator.run(run)["p_contact"]
        estimator.reset()
        beliefs = [estimator.update_from_spine(spine_observation(run, k), run["ground_velocity_command"][k])
                   for k in range(run.steps)]
        # Times differ in the last digits, because steps are counted here.
        np.testing.assert_allclose([belief.p_contact for belief in beliefs], whole_run, atol=1e-12)

    def test_without_torques_has_invalid_signals(self):
        run = hop()
        estimator = touchdown.Estimator(model=touchdown.fit(run, "robust"))
        whole = spine_observation(run, 0)
        self.assertEqual(estimator.update_from_spine(whole).status, "good")
        for broken in ({"torque": None}, {"torque": float("nan")}, {}):
            observation = spine_observation(run, 1)
            knee = observation["servo"]["left_knee"]
            del knee["torque"]
            knee.update(broken)
            self.assertEqual(estimator.update_from_spine(observation).status, "invalid")
        observation = spine_observation(run, 1)
        del observation["servo"]["left_wheel"]
        self.assertEqual(estimator.update_from_spine(observation).status, "invalid")

    def test_uses_its_own_time(self):
        estimator = touchdown.Estimator("free_fall")
        for time, status in ((0.0, "good"), (0.001, "good"), (0.9, "gap")):
            belief = estimator.update_from_spine({**spine_observation(hop(), 0), "time": time})
            self.assertEqual(belief.status, status)

    def test_at_another_rate_than_the_estimators_is_refused(self):
        run = hop()
        for rate, step in ((1000.0, 0.004), (1000.0, 0.0005), (250.0, 0.001)):
            by_spine, by_arrays = (touchdown.Estimator("free_fall", sample_rate=rate) for _ in range(2))
            words = f"{1.0 / step:g} steps per second, and the estimator was made for {rate:g}"
            with self.assertRaisesRegex(touchdown.InputError, words):
                for k in range(100):
                    by_spine.update_from_spine({**spine_observation(run, k), "time": step * k})
            with self.assertRaisesRegex(touchdown.InputError, words):
                for k in range(100):
                    by_arrays.update({**{name: run[name][k] for name in ALL}, "time": step * k})

    def test_refuses_other_dictionaries(self):
        update = touchdown.Estimator("free_fall").update_from_spine
        whole = spine_observation(hop(), 0)
        imu, servo = whole["imu"], whole["servo"]
        self.assert_refused([
            (lambda: update({}), "'servo' is missing: expected info"),
            (lambda: update({**whole, "servo": 3}), "observation.servo: expected a dictionary"),
            (lambda: update({**whole, "imu": {**imu, "orientation": [1.0, 0.0, 0.0]}}),
             "observation.imu.orientation: expected four numbers: w, x, y, z"),
            (lambda: update({**whole, "servo": {**servo, "left_knee": {"torque": True}}}),
             "observation.servo.left_knee.torque: expected a number")])

    def test_of_a_gym_environment_gets_beliefs(self):
        class Environment:  # with the interface of Upkie's environments
            spec = "Upkie"
            step_count = 0

            def reset(self, **options):
                self.step_count = 0
                return None, {"spine_observation": spine_observation(hop(), 0)}

            def step(self, action):
                self.step_count += 1
                return None, 0.0, False, False, {"spine_observation": spine_observation(hop(), self.step_count)}

        estimator = touchdown.Estimator("free_fall")
        environment = touchdown.ContactWrapper(Environment(), estimator)
        expected = estimator.run(hop())["p_contact"]
        for _ in range(2):
            _, info = environment.reset(seed=1)
            self.assertEqual(info["contact"].p_contact, tuple(expected[0]))
            for k in range(1, 10):
                *_, info = environment.step(np.zeros(1))
                self.assertAlmostEqual(info["contact"].p_contact[0], expected[k, 0], delta=1e-12)
        self.assertEqual(environment.spec, "Upkie")

    def test_is_a_wrapper_of_gymnasium_where_that_is_installed(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "gymnasium.py").write_text(
                "class Wrapper:\n    def __init__(self, env): self.env = self.unwrapped = env\n")
            program = ("import gymnasium, touchdown\nwrapper = touchdown.ContactWrapper('an environment', 'an estimator')\n"
                       "print(isinstance(wrapper, gymnasium.Wrapper), wrapper.unwrapped, wrapper.estimator)")
            path = os.pathsep.join([folder, *filter(None, sys.path)])
            done = subprocess.run([sys.executable, "-c", program], env={**os.environ, "PYTHONPATH": path},
                                  capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.strip(), "True an environment an estimator")


class Keywords(unittest.TestCase):
    def test_that_are_unknown_are_refused_with_the_nearest_one(self):
        for call, message in (
                (lambda: touchdown.Estimator(modle="x.npz"), "Estimator: unknown keyword 'modle': .*did you mean 'model'"),
                (lambda: touchdown.simulate("scenarios/flat.yaml", sead=1), "simulate: unknown keyword 'sead': .*'seed'"),
                (lambda: touchdown.fit([], estimater="robust"), "fit: unknown keyword 'estimater': .*'estimator'"),
                (lambda: touchdown.run({}, overides={}), "run: unknown keyword 'overides': expected one of"),
                (lambda: touchdown.score({}, {}, zzz=1), "score: unknown keyword 'zzz': expected one of beliefs, recording")):
            with self.assertRaisesRegex(touchdown.InputError, message):
                call()


if __name__ == "__main__":
    unittest.main()
