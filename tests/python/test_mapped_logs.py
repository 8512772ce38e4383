import unittest
import warnings

import numpy as np

import bags
import touchdown
from scene import InFolder, assert_same, estimated, hop, program


class OtherRobotsLogs(InFolder):
    """Bags and CSV files by a mapping give the numbers of the program."""

    def compare(self, log, mapping, rate, name="", model=None):
        options = ["--estimator", name] if name else []
        options += ["--model", model] if model else []
        rows = estimated(log, "--mapping", mapping, *options)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            run = touchdown.Recording.load(log, mapping=mapping)
        self.assertAlmostEqual(run.sample_rate, rate, delta=0.01 * rate)
        assert_same(touchdown.Estimator(name, model, sample_rate=rate).run(run), rows)
        return run, [str(one.message) for one in caught]

    def test_of_bags_give_the_beliefs_of_the_program(self):
        (self.folder / "robot.yaml").write_text(bags.MAPPING, encoding="utf-8")
        for every, rate in (((2, 5), 500.0), ((1, 1), 1000.0), ((5, 2), 200.0)):
            (self.folder / "bag.db3").unlink(missing_ok=True)
            bags.write_bag(hop(), "bag.db3", every)
            for name in ("", "free_fall", "support_force"):
                run, lines = self.compare("bag.db3", "robot.yaml", rate, name)
            self.assertRegex("\n".join(lines), "/imu/data: held at the rows of /joint_states, ages")
            np.testing.assert_allclose(run["torque"], hop()["torque"][::every[0]][-run.steps:], atol=1e-9)
            self.assertRegex(repr(run), "a robot's log")

    def test_of_csv_files_give_the_beliefs_of_the_program(self):
        run = hop()
        few = {key: np.asarray(run[key])[::3] for key in ("time", "position", "velocity", "torque", "orientation",
                                                         "angular_velocity", "linear_acceleration")}
        columns = [f"{key}{i}" for key, value in few.items() for i in range(1 if value.ndim == 1 else value.shape[1])]
        table = np.hstack([value.reshape(len(value), -1) for value in few.values()])
        np.savetxt("log.csv", table, delimiter=",", header=",".join(columns), comments="", fmt="%.17g")
        np.savez("log.npz", **few)
        numbered = lambda key, count: f"[{', '.join(f'{key}{i}' for i in range(count))}]"
        text = "time: {{from: {}}}\njoints:\n  position: {{from: {}}}\n  velocity: {{from: {}}}\n  torque: {{from: {}}}\nimu:\n" \
               "  orientation: {{from: {}}}\n  angular_velocity: {{from: {}}}\n  linear_acceleration: {{from: {}}}\n"
        (self.folder / "csv.yaml").write_text(text.format("time0", *(numbered(key, value.shape[1]) for key, value in few.items()
                                                                    if value.ndim == 2)), encoding="utf-8")
        (self.folder / "npz.yaml").write_text(text.format(*few), encoding="utf-8")
        of_csv, _ = self.compare("log.csv", "csv.yaml", 1e3 / 3)
        of_npz, _ = self.compare("log.npz", "npz.yaml", 1e3 / 3)
        self.compare("log.csv", "csv.yaml", 1e3 / 3, "free_fall")
        np.testing.assert_array_equal(of_csv["torque"], of_npz["torque"])

    def test_of_a_loop_give_the_beliefs_of_its_log(self):
        """The mapping file of a robot's .npz log serves its loop, by the same names."""
        run = hop()
        forward = np.array([-1.0, 1.0, -1.0])  # x forward, y left, z up
        w, x, y, z = run["orientation"].T
        log = {"t": run["time"], "servos": run["position"][:, ::-1], "speeds": run["velocity"][:, ::-1],
               "torques": run["torque"][:, ::-1], "q": np.column_stack([-y, -z, w, x]),
               "gyro": forward * run["angular_velocity"], "acc": forward * run["linear_acceleration"]}
        np.savez("log.npz", **log)
        joint = "{{from: {}, index: [5, 4, 3, 2, 1, 0]}}"
        (self.folder / "npz.yaml").write_text(
            "time: {from: t}\njoints:\n  position: " + joint.format("servos") + "\n  velocity: " + joint.format("speeds") +
            "\n  torque: " + joint.format("torques") + "\nimu:\n  axes: [-x, y, -z]\n  orientation: {from: q}\n"
            "  angular_velocity: {from: gyro}\n  linear_acceleration: {from: acc}\ncontact: {from: not_in_a_loop}\n", encoding="utf-8")
        estimator = touchdown.Estimator(mapping="npz.yaml")
        whole = estimator.run(log)
        estimator.reset()
        for k in range(500):
            belief = estimator.update({name: values[k] for name, values in log.items()})
            self.assertEqual(belief.p_contact, tuple(whole["p_contact"][k]))
        (self.folder / "npz.yaml").write_text((self.folder / "npz.yaml").read_text().replace("contact:", "#"), encoding="utf-8")
        assert_same(whole, estimated("log.npz", "--mapping", "npz.yaml"))

        upright = dict(run, angular_velocity=log["gyro"], linear_acceleration=log["acc"],
                       orientation=np.column_stack([-y, -z, w, x]))
        del upright["vertical_acceleration"]
        expected = touchdown.Estimator().run(run)
        for axes in (["-x", "y", "-z"], np.diag(forward)):
            found = touchdown.Estimator(axes=axes).run(upright)
            np.testing.assert_allclose(found["p_contact"], expected["p_contact"], atol=1e-9)

    def test_of_a_loop_refuse_what_the_mapping_does_not_fit(self):
        (self.folder / "robot.yaml").write_text("time: {from: t}\njoints: {position: {from: q}}\n", encoding="utf-8")
        for given, expected in (
                (dict(axes=["-x", "y", "z"]), "axes: expected the IMU's axes that point back, left and down"),
                (dict(axes=5), "axes: expected the IMU's axes"),
                (dict(axes=np.diag([1.0, 1.0, -1.0])), "axes must be a rotation"),
                (dict(axes=["x", "y", "z"], mapping="robot.yaml"), "axes: the mapping states them")):
            with self.assertRaisesRegex(touchdown.InputError, expected):
                touchdown.Estimator(**given)
        estimator = touchdown.Estimator(mapping="robot.yaml")
        with self.assertRaisesRegex(touchdown.InputError, "robot.yaml:2:.*joints.position.from: signals has no array 'q'"):
            estimator.update({"t": 0.0, "p": np.zeros(6)})
        with self.assertRaisesRegex(touchdown.InputError, "gravity_included: the mapping states the acceleration"):
            estimator.update({}, gravity_included=True)
        with self.assertRaisesRegex(touchdown.InputError, "a spine has Upkie's conventions"):
            estimator.update_from_spine({})

    def test_are_checked(self):
        (self.folder / "robot.yaml").write_text(bags.MAPPING, encoding="utf-8")
        (self.folder / "signs.yaml").write_text(bags.MAPPING.replace("[1, 1, 1, -1, -1, -1]", "1"), encoding="utf-8")
        bags.write_bag(hop(), "bag.db3")
        lines = touchdown.check("bag.db3", mapping="robot.yaml")
        self.assertEqual(len(lines), 1)
        self.assertRegex(lines[0], "/imu/data: held at the rows of /joint_states")
        printed = program("check", "bag.db3", "--mapping", "signs.yaml").stdout
        found = touchdown.check("bag.db3", mapping="signs.yaml")[1:]
        self.assertRegex("\n".join(found), "wheels: turn in opposite directions")
        for line in found:
            self.assertIn(f"  {line}\n", printed)
        with self.assertRaisesRegex(touchdown.InputError, "mapping is for logs by path"):
            touchdown.check(hop(), mapping="robot.yaml")
        for call in (touchdown.check, touchdown.Recording.load):
            with self.assertRaisesRegex(touchdown.InputError, "none.yaml"):
                call("bag.db3", mapping="none.yaml")
            with self.assertRaisesRegex(touchdown.InputError, "`touchdown export --mapping` makes such a log"):
                call("bag.db3")


if __name__ == "__main__":
    unittest.main()
