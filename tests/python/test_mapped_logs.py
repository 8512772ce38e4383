import unittest

import numpy as np

import touchdown
from scene import InFolder, hop, program


class OtherRobotsLogs(InFolder):
    """CSV files and arrays by a mapping give the numbers of the program. Bags do in tests/cli/doors_test.cpp."""

    def setUp(self):
        super().setUp()
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

    def test_give_the_beliefs_of_the_program(self):
        runs = {}
        for kind, name in (("csv", ""), ("npz", ""), ("csv", "free_fall")):
            log, mapping = f"log.{kind}", f"{kind}.yaml"
            run = runs[kind] = touchdown.Recording.load(log, mapping=mapping)
            self.assertAlmostEqual(run.sample_rate, 1e3 / 3, delta=3.0)
            self.assertRegex(repr(run), "a robot's log")
            beliefs = touchdown.Estimator(name, sample_rate=1e3 / 3).run(run)
            self.assert_program_believes(beliefs, log, "--mapping", mapping, *(["--estimator", name] if name else []))
        np.testing.assert_array_equal(runs["csv"]["torque"], runs["npz"]["torque"])

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
        slow = touchdown.Estimator(mapping="npz.yaml")  # at 1 kHz, and its steps are those of 250 Hz
        steps = [{name: values[4 * k] for name, values in log.items()} for k in range(100)]
        with self.assertRaisesRegex(touchdown.InputError, "250 steps per second, and the estimator was made for 1000: "):
            for step in steps:
                slow.update(step)
        right = touchdown.Estimator(mapping="npz.yaml", sample_rate=250.0)
        self.assertEqual([right.update(step).status for step in steps][-1], "degraded")
        estimator = touchdown.Estimator(mapping="npz.yaml")
        whole = estimator.run(log)
        estimator.reset()
        for k in range(500):
            belief = estimator.update({name: values[k] for name, values in log.items()})
            self.assertEqual(belief.p_contact, tuple(whole["p_contact"][k]))
        (self.folder / "npz.yaml").write_text((self.folder / "npz.yaml").read_text().replace("contact:", "#"), encoding="utf-8")
        self.assert_program_believes(whole, "log.npz", "--mapping", "npz.yaml")

        upright = dict(run, angular_velocity=log["gyro"], linear_acceleration=log["acc"],
                       orientation=np.column_stack([-y, -z, w, x]))
        del upright["vertical_acceleration"]
        expected = touchdown.Estimator().run(run)
        for axes in (["-x", "y", "-z"], np.diag(forward)):
            found = touchdown.Estimator(axes=axes).run(upright)
            np.testing.assert_allclose(found["p_contact"], expected["p_contact"], atol=1e-9)

    def test_of_a_loop_refuse_what_the_mapping_does_not_fit(self):
        (self.folder / "robot.yaml").write_text("time: {from: t}\njoints: {position: {from: q}}\n", encoding="utf-8")
        estimator = touchdown.Estimator(mapping="robot.yaml")
        self.assert_refused([
            (lambda: touchdown.Estimator(axes=["-x", "y", "z"]), "axes: expected the IMU's axes that point back, left and down"),
            (lambda: touchdown.Estimator(axes=5), "axes: expected the IMU's axes"),
            (lambda: touchdown.Estimator(axes=np.diag([1.0, 1.0, -1.0])), "axes must be a rotation"),
            (lambda: touchdown.Estimator(axes=["x", "y", "z"], mapping="robot.yaml"), "axes: the mapping states them"),
            (lambda: estimator.update({"t": 0.0, "p": np.zeros(6)}), "robot.yaml:2:.*joints.position.from: signals has no array 'q'"),
            (lambda: estimator.update({}, gravity_included=True), "gravity_included: the mapping states the acceleration"),
            (lambda: estimator.update_from_spine({}), "a spine has Upkie's conventions")])

    def test_are_checked(self):
        self.assertEqual(touchdown.check("log.csv", mapping="csv.yaml"), [])
        text = (self.folder / "csv.yaml").read_text(encoding="utf-8")
        (self.folder / "signs.yaml").write_text(text.replace("joints:", "joints:\n  sign: [1, 1, 1, -1, -1, -1]"), encoding="utf-8")
        found = touchdown.check("log.csv", mapping="signs.yaml")
        self.assertRegex("\n".join(found), "wheels: turn in opposite directions")
        printed = program("check", "log.csv", "--mapping", "signs.yaml").stdout
        for line in found:
            self.assertIn(f"  {line}\n", printed)
        self.assert_refused([
            (lambda: touchdown.check(hop(), mapping="csv.yaml"), "mapping is for logs by path"),
            *((lambda call=call: call("log.csv", mapping="none.yaml"), "none.yaml")
              for call in (touchdown.check, touchdown.Recording.load)),
            *((lambda call=call: call("log.csv"), "is a CSV file, expected a log in Upkie's layout")
              for call in (touchdown.check, touchdown.Recording.load))])


if __name__ == "__main__":
    unittest.main()
