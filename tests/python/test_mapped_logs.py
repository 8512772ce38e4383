import csv
import unittest
import warnings

import numpy as np

import bags
import touchdown
from scene import InFolder, hop, program


class OtherRobotsLogs(InFolder):
    """Bags and CSV files by a mapping give the numbers of the program."""

    def compare(self, log, mapping, rate, name="", model=None):
        options = ["--estimator", name] if name else []
        options += ["--model", model] if model else []
        program("estimate", log, "--mapping", mapping, *options, "-o", "beliefs.csv")
        with open("beliefs.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            run = touchdown.Recording.load(log, mapping=mapping)
        self.assertAlmostEqual(run.sample_rate, rate, delta=0.01 * rate)
        beliefs = touchdown.Estimator(name, model, sample_rate=rate).run(run)
        for wheel, side in enumerate(("left", "right")):
            np.testing.assert_array_equal(beliefs["p_contact"][:, wheel], [float(row[f"p_contact_{side}"]) for row in rows])
            np.testing.assert_array_equal(beliefs["contact"][:, wheel], [row[f"contact_{side}"] == "1" for row in rows])
        self.assertEqual([touchdown.STATUS[status] for status in beliefs["status"]], [row["status"] for row in rows])
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
