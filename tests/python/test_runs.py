import copy
import gc
import unittest

import numpy as np

import touchdown
from scene import HOP, SHORT, InFolder, hop, program


class Simulation(InFolder):
    def test_gives_arrays_of_one_row_per_step(self):
        run = hop()
        self.assertIsInstance(run, dict)
        self.assertEqual(run.steps, 3201)
        self.assertEqual(run.period, 0.001)
        self.assertEqual(run.info["simulator"], "mujoco")
        self.assertEqual(run.info["outcome"], "finished")
        shapes = {"time": (), "torque": (6,), "orientation": (4,), "contact": (2,), "normal_force": (2,),
                  "base_position": (3,), "command_velocity": (6,), "vertical_acceleration": ()}
        for name, shape in shapes.items():
            self.assertEqual(run[name].shape, (run.steps, *shape), name)
        np.testing.assert_allclose(run["time"], 0.001 * np.arange(run.steps), atol=1e-12)
        np.testing.assert_allclose(np.linalg.norm(run["orientation"], axis=1), 1.0, atol=1e-9)

    def test_is_consistent(self):
        run = hop()
        # γ^z: the acceleration turned by the quaternion w x y z, along the axis that points down, reversed.
        w, x, y, z = run["orientation"].T
        down = np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], axis=1)
        np.testing.assert_allclose(run["vertical_acceleration"], -np.sum(down * run["linear_acceleration"], axis=1),
                                   atol=1e-9)
        wheels = run["command_velocity"]
        np.testing.assert_allclose(run["ground_velocity_command"][1:],
                                   0.5 * 0.05 * (wheels[:-1, 2] - wheels[:-1, 5]), atol=1e-12)
        self.assertEqual(run["ground_velocity_command"][0], 0.0)
        # The robot of 5.3 kg stands, flies, and stands again.
        self.assertAlmostEqual(run["normal_force"][900].sum(), 5.3 * 9.81, delta=5.0)
        self.assertFalse(run["contact"][:, 0].all())
        self.assertTrue(run["contact"][-1].all())

    def test_writes_the_program_s_bytes_and_reads_them_back(self):
        run = hop()
        run.save("python.mpack")
        program("simulate", HOP, "--set", "end.duration=3.2", "-o", "program.mpack")
        self.assert_same_bytes("python.mpack", "program.mpack")
        read = touchdown.Recording.load("program.mpack")
        self.assertEqual(read.info, run.info)
        self.assertEqual(read.keys(), run.keys())
        for name in run:
            np.testing.assert_array_equal(read[name], run[name], err_msg=name)

    def test_draws_a_run_from_the_seed(self):
        options = {"seed": 7, "run": 2, "simulator": "bullet", "overrides": ["end.duration=0.5"]}
        run = touchdown.simulate(HOP, **options)
        run.save("python.mpack")
        program("simulate", HOP, "--seed", 7, "--run", 2, "--simulator", "bullet", "--set", "end.duration=0.5", "-o",
                "program.mpack")
        self.assert_same_bytes("python.mpack", "program.mpack")

    def test_saves_changed_arrays(self):
        run = touchdown.simulate(HOP, overrides={"end.duration": 0.2})
        run["torque"][50] = 0.25
        run["orientation"] = np.tile([1.0, 0.0, 0.0, 0.0], (run.steps, 1))
        run.save("changed.mpack")
        read = touchdown.Recording.load("changed.mpack")
        np.testing.assert_array_equal(read["torque"], run["torque"])
        self.assertEqual(read["torque"][50].tolist(), [0.25] * 6)
        self.assertEqual(read["orientation"][7].tolist(), [1.0, 0.0, 0.0, 0.0])

    def test_arrays_view_the_run_and_keep_it_alive(self):
        run = touchdown.simulate(HOP, overrides={"end.duration": 0.2})
        torque, position = run["torque"], run["position"]
        self.assertFalse(torque.flags.owndata)
        self.assertIs(torque.base, position.base)
        kept = torque.copy()
        del run, position
        gc.collect()
        touchdown.simulate(HOP, overrides={"end.duration": 0.2})  # reuses freed memory
        np.testing.assert_array_equal(torque, kept)

    def test_of_other_robots_has_their_torques_and_held_joints_as_ground_truth(self):
        for robot, names, width in (("upkie_actuated", ["joint_torque"], 6),
                                    ("hip_roll", ["held_position", "held_velocity", "held_torque"], 2)):
            run = touchdown.simulate(HOP, overrides={"end.duration": 0.1, "robot": f"models/{robot}.yaml"})
            run.save("robot.mpack")
            loaded = touchdown.Recording.load("robot.mpack")
            loaded.save("again.mpack")
            self.assert_same_bytes("robot.mpack", "again.mpack")
            for name in names:
                self.assertEqual(run[name].shape, (run.steps, width))
                np.testing.assert_array_equal(loaded[name], run[name])
                self.assertNotIn(name, hop())

    def test_raises_the_program_s_messages(self):
        requests = [
            (["scenarios/hops.yaml"], {}, ["simulate", "scenarios/hops.yaml"]),
            ([HOP], {"overrides": {"end.duratio": 1}}, ["simulate", HOP, "--set", "end.duratio=1"]),
            ([HOP], {"simulator": "mujocu"}, ["simulate", HOP, "--simulator", "mujocu"]),
            (["experiments/stairs.yaml"], {}, ["simulate", "experiments/stairs.yaml"]),
        ]
        for arguments, options, command in requests:
            done = program(*command, "-o", "x.mpack", check=False)
            self.assertEqual(done.returncode, 2)
            with self.assertRaises(touchdown.InputError) as raised:
                touchdown.simulate(*arguments, **options)
            self.assertEqual(done.stderr, f"touchdown: {raised.exception}\n")
        self.assertTrue(issubclass(touchdown.InputError, (touchdown.Error, ValueError)))
        with self.assertRaisesRegex(touchdown.InputError, "run: expected a number of at least 0"):
            touchdown.simulate(HOP, run=-1)


class Saving(InFolder):
    def test_refuses_arrays_that_are_missing_or_of_another_shape(self):
        run = copy.copy(hop())
        run["torque"] = run["torque"][:, :5]
        with self.assertRaisesRegex(touchdown.InputError,
                                    r"'torque' has the shape \(3201, 5\), expected \(3201, 6\)"):
            run.save("x.mpack")
        del run["torque"]
        with self.assertRaisesRegex(touchdown.InputError, r"'torque' is missing: expected an array of shape"):
            run.save("x.mpack")
        self.assertEqual(list(self.folder.iterdir()), [])


class Labels(unittest.TestCase):
    def test_are_those_of_the_recording(self):
        run = hop()
        np.testing.assert_array_equal(touchdown.contact_labels(run["normal_force"], run.period), run["contact"])
        light = touchdown.contact_labels(run["normal_force"], run.period, share=1.0)
        self.assertLess(light.mean(), 0.1)
        heavy = touchdown.contact_labels(10 * run["normal_force"], run.period, robot_mass=10 * 5.33922)
        np.testing.assert_array_equal(heavy, run["contact"])
        self.assertAlmostEqual(run.info["robot_mass"], 5.33922, 5)

    def test_take_no_flight_shorter_than_the_window(self):
        force = np.full((100, 2), 20.0)
        force[40:50, 0] = 0.0
        force[60:71, 1] = 0.0
        labels = touchdown.contact_labels(force, 0.001)
        self.assertTrue(labels[:, 0].all())
        self.assertEqual(np.flatnonzero(~labels[:, 1]).tolist(), list(range(60, 71)))


class Scores(unittest.TestCase):
    truth = np.ones((2000, 2), dtype=bool)
    truth[900:1100] = False  # 0.2 s of flight
    recording = {"time": 0.001 * np.arange(2000), "contact": truth}

    def test_of_the_truth_are_perfect(self):
        scores = touchdown.score(self.truth, self.recording)
        self.assertEqual(list(scores), ["wheels", "left_wheel", "right_wheel", "any_wheel", "both_wheels"])
        for view in scores.values():
            self.assertEqual(view["success"], 1.0)
            self.assertEqual(view["takeoff_recall"], 1.0)
            self.assertEqual(view["landing_latency_ms"], 0.0)
            self.assertEqual(view["brier"], 0.0)

    def test_count_wrong_and_delayed_contact(self):
        delayed = np.roll(self.truth, 30, axis=0)
        scores = touchdown.score(delayed, self.recording)["wheels"]
        self.assertAlmostEqual(scores["takeoff_latency_ms"], 30.0)
        # 60 of the 1700 steps after the first 0.3 s.
        self.assertAlmostEqual(scores["success"], 1.0 - 60 / 1700)
        never = touchdown.score(np.ones(2000), self.recording)["wheels"]
        self.assertAlmostEqual(never["success"], 1500 / 1700)
        self.assertTrue(np.isnan(never["takeoff_precision"]))
        self.assertAlmostEqual(touchdown.score(np.full(2000, 0.9), self.recording, skip=0.0)["wheels"]["brier"],
                               (1800 * 0.01 + 200 * 0.81) / 2000)

    def test_refuse_beliefs_that_do_not_fit_the_run(self):
        with self.assertRaisesRegex(touchdown.InputError, "beliefs about 7 steps, expected 2000"):
            touchdown.score(np.ones(7), self.recording)
        with self.assertRaisesRegex(touchdown.InputError, "nan at step 3: expected a probability, from 0 to 1"):
            beliefs = np.ones((2000, 2))
            beliefs[3, 1] = np.nan
            touchdown.score(beliefs, self.recording)
        with self.assertRaisesRegex(touchdown.InputError, "'contact' is missing"):
            touchdown.score(np.ones(3), {"time": np.arange(3.0)})


if __name__ == "__main__":
    unittest.main()
