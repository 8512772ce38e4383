import importlib
import json
import pathlib
import sys
import textwrap
import traceback
import unittest

import numpy as np

import touchdown
from scene import InFolder, program

EXPERIMENT = textwrap.dedent("""\
    name: hops
    simulators: [mujoco]
    estimators: [free_fall, robust]
    fit: {scenarios: [hop.yaml], runs: 1}
    test: {scenarios: [hop.yaml], runs: 2}
    noise: {torque: [0, 1], accelerometer: [0, 5], seeds: 2}
    highlights: [{torque: 0, accelerometer: 0}, {torque: 1, accelerometer: 5}]
    intervals: {resamples: 50}
    video: {enabled: false}
    recordings: none
    workers: 2
    """)

ESTIMATORS = textwrap.dedent('''\
    import threading
    import numpy as np
    import touchdown

    class Same:
        """Gives the beliefs of free_fall."""
        title = "The same"
        sensors = ["acceleration"]
        threads, calls = set(), []

        def run(self, signals):
            self.threads.add(threading.get_ident())
            self.calls.append(signals["torque"].shape)
            return touchdown.Estimator("free_fall", sample_rate=signals["sample_rate"]).run(signals)

    class UsesEverySensor(Same):
        sensors = touchdown.experiment.SENSORS
        calls = []

    class Never:
        def run(self, signals):
            return np.zeros(len(signals["time"]), dtype=bool)

    class Sees(Never):
        sensors, seen = ["knee_torque", "acceleration"], {}

        def run(self, signals):
            for name in ("torque", "position", "velocity", "vertical_acceleration"):
                self.seen[name] = np.isfinite(signals[name]).reshape(len(signals["time"]), -1).all(axis=0).tolist()
            return super().run(signals)

    class SeesNothing(Sees):
        sensors, seen = [], {}

    class Breaks:
        def run(self, signals):
            raise ZeroDivisionError("of the user's own")

    class Short:
        def run(self, signals):
            return np.zeros((3, 2))

    class WithoutRun:
        pass

    class Misspells:
        def run(self, signals):
            return signals["knee_torque"] > 1.0

    class UnknownSensor(Never):
        sensors = ["acceleratoin"]
    ''')


class InExperimentFolder(InFolder):
    def setUp(self):
        super().setUp()
        hop = (pathlib.Path(touchdown.experiment._touchdown.find_resource("scenarios/hop.yaml"))).read_text()
        (self.folder / "hop.yaml").write_text(hop.replace("duration: 7.0", "duration: 3.2"))
        (self.folder / "hops.yaml").write_text(EXPERIMENT)
        (self.folder / "mine.py").write_text(ESTIMATORS)
        sys.path.insert(0, str(self.folder))
        self.addCleanup(sys.path.remove, str(self.folder))
        self.addCleanup(sys.modules.pop, "mine", None)


class Experiment(InExperimentFolder):
    def test_gives_the_program_s_tables(self):
        result = touchdown.run("hops.yaml", out="python")
        program("run", "hops.yaml", "--out", "program", "--no-pictures")
        written = sorted(path.name for path in (self.folder / "program/tables").iterdir())
        self.assertEqual(sorted(path.name for path in (result.path / "tables").iterdir()), written)
        for name in written:
            self.assertEqual((result.path / "tables" / name).read_bytes(),
                             (self.folder / "program/tables" / name).read_bytes(), name)
        self.assertIn("latency", result.tables)
        scores = result.tables["success"]
        self.assertEqual(set(scores["estimator"]), {"free_fall", "robust", "always_contact"})
        self.assertEqual(scores["success"].dtype, np.float64)
        self.assertEqual(len(result.tables["runs"]["role"]), 3)  # one of them for fitting

    def test_takes_python_values_as_overrides(self):
        result = touchdown.run("hops.yaml", overrides={"test.runs": 1, "noise.torque": np.array([0.0, 1.0]),
                                                       "estimators": ["free_fall"], "noise.seeds": 1})
        self.assertEqual(result.path.parent, pathlib.Path("runs/hops"))
        self.assertEqual(set(result.tables["success"]["estimator"]), {"free_fall", "always_contact"})
        self.assertEqual(json.loads((result.path / "manifest.json").read_text())["command"],
                         "python3 -m touchdown run hops.yaml --set test.runs=1 --set 'noise.torque=[0.0, 1.0]' "
                         "--set 'estimators=[\"free_fall\"]' --set noise.seeds=1")
        again = touchdown.run({"name": "hops", "simulators": ["mujoco"], "estimators": ["free_fall"],
                               "fit": {"scenarios": ["hop.yaml"], "runs": 1},
                               "test": {"scenarios": ["hop.yaml"], "runs": 1},
                               "noise": {"torque": [0, 1], "accelerometer": [0, 5], "seeds": 1},
                               "highlights": [{"torque": 0, "accelerometer": 0}, {"torque": 1, "accelerometer": 5}],
                               "intervals": {"resamples": 50}, "video": {"enabled": False}, "recordings": "none"})
        self.assertEqual(again.id, result.id)
        with self.assertRaisesRegex(touchdown.InputError, "experiment:1:1: name: is missing"):
            touchdown.run({"fit": {}, "test": {}})
        with self.assertRaisesRegex(touchdown.InputError, "noise.seed.*did you mean"):
            touchdown.run("hops.yaml", overrides={"noise.seed": 1})


class WrittenInPython(InExperimentFolder):
    def rows(self, result, name):
        """Every number about one estimator."""
        numbers = {}
        for table in ("success", "classification", "transitions", "latency", "views", "calibration"):
            columns = result.tables[table]
            its = columns["estimator"] == name
            numbers[table] = {key: values[its] for key, values in columns.items() if key != "estimator"}
        return numbers

    def test_has_its_title_in_the_tables_of_studies(self):
        studies = {"benchmark": {}, "ablation": {}, "vary": {"sensors.accelerometer.bias": [0, 0.1]}}
        for key, section in studies.items():
            result = touchdown.run("hops.yaml", overrides={"estimators": ["free_fall", "python:mine.Same"], "noise.seeds": 1,
                                                           "test.runs": 1, key: section}, out=key)
            text = "\n".join(result.studies)
            self.assertIn("The same", text, key)
            self.assertNotIn("python:mine.Same", text, key)

    def test_is_scored_by_its_beliefs(self):
        import mine

        result = touchdown.run("hops.yaml", overrides={"estimators": ["free_fall", "python:mine.Same", mine.Never]})
        self.assertEqual(list(dict.fromkeys(result.tables["success"]["estimator"])),
                         ["free_fall", "python:mine.Same", "python:mine.Never", "always_contact"])
        ours, theirs = self.rows(result, "free_fall"), self.rows(result, "python:mine.Same")
        for table in ours:
            for key, values in ours[table].items():
                np.testing.assert_array_equal(theirs[table][key], values, err_msg=f"{table} {key}")
        never = self.rows(result, "python:mine.Never")["classification"]
        self.assertTrue((never["contact_recall"] == 0.0).all())

    def test_gets_whole_runs_and_only_the_noise_of_its_sensors(self):
        import mine

        touchdown.run("hops.yaml", overrides={"estimators": [mine.Same, mine.UsesEverySensor]})
        # 2 runs × 2 seeds, counted at different levels of 4 cells, then scored at the noisy highlight. Without noise
        # both seeds of a run share the score, unless two threads compute it at once.
        per_task = {"Same": 2 + 1, "UsesEverySensor": 4 + 1}
        for name, calls in per_task.items():
            self.assertIn(len(getattr(mine, name).calls) - 4 * calls, {2, 3, 4}, name)
            self.assertEqual(set(getattr(mine, name).calls), {(3201, 6)})

    def test_hides_sensors_that_an_estimator_does_not_name(self):
        import mine
        touchdown.run("hops.yaml", overrides={"estimators": [mine.Sees, mine.SeesNothing]})
        hip_knee_wheel = [False, True, False]
        self.assertEqual(mine.Sees.seen, {"torque": 2 * hip_knee_wheel, "position": 6 * [False], "velocity": 6 * [False],
                                          "vertical_acceleration": [True]})
        self.assertFalse(any(sum(mine.SeesNothing.seen.values(), [])))

    def test_with_changed_source_is_evaluated_again(self):
        import mine

        first = touchdown.run("hops.yaml", overrides={"estimators": [mine.Never]})
        again = touchdown.run("hops.yaml", overrides={"estimators": [mine.Never]})
        self.assertEqual(again.path, first.path)
        (self.folder / "mine.py").write_text(ESTIMATORS.replace("np.zeros(len", "np.ones(len"))
        with self.assertRaisesRegex(touchdown.InputError, "mine.py was changed since it was imported"):
            touchdown.run("hops.yaml", overrides={"estimators": ["python:mine.Never"]})
        importlib.reload(mine)
        changed = touchdown.run("hops.yaml", overrides={"estimators": ["python:mine.Never"]})
        self.assertNotEqual(changed.id, first.id)
        self.assertTrue((changed.tables["classification"]["contact_recall"] == 1.0).all())

    def test_gets_figures_a_film_and_a_report_like_any_other(self):
        experiment = {"estimators": ["free_fall", "python:mine.Same"], "recordings": "pictured", "noise.seeds": 1,
                      "video": {"estimators": ["free_fall", "python:mine.Same"], "width": 320}, "benchmark": {}}
        run = touchdown.run("hops.yaml", overrides=experiment, out="out", pictures=True)
        report = (run.path / "report.html").read_text()
        shown = report[:report.index("The command of this run")]
        for page in [shown, (run.path / "benchmark.html").read_text(),
                     *(path.read_text() for path in (run.path / "figures").glob("*.svg")),
                     *(path.read_text() for path in (run.path / "tables").glob("*.tex"))]:
            self.assertNotRegex(page, "(?<!=)python:mine.Same(?!.mp4)")  # but in the data of results.csv
        self.assertIn("The same", (run.path / "figures/error_mujoco.svg").read_text())
        self.assertIn("Gives the beliefs of free_fall", shown)
        self.assertIn("python3 -m touchdown run config.yaml", shown)
        self.assertGreater(len(list((run.path / "videos").glob("*.mp4"))), 1)
        # The program shows the results of estimators that it cannot run.
        done = program("report", "out")
        self.assertIn("python:mine.Same: left out of films and replay", done.stderr)
        self.assertIn("The same", (run.path / "report.html").read_text())
        touchdown.run("hops.yaml", overrides={**experiment, "estimators": ["python:mine.Never", "python:mine.Same"],
                                              "video": {"enabled": False}, "recordings": "none"}, out="other")
        self.assertIn("python:mine.Same", program("compare", "out", "other", "-o", "compare.csv").stdout
                      + (self.folder / "compare.csv").read_text())

    def test_is_one_clear_error_in_the_program(self):
        done = program("run", "hops.yaml", "--set", "estimators=[robust,python:mine.Never]", check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("'python:mine.Never' is written in Python: run the experiment from there, by "
                      "'python3 -m touchdown run' or touchdown.run", done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)

    def test_that_fails_raises_its_own_exception(self):
        try:
            touchdown.run("hops.yaml", overrides={"estimators": ["python:mine.Breaks"]})
        except ZeroDivisionError as error:
            self.assertEqual(str(error), "of the user's own")
            self.assertEqual(traceback.extract_tb(error.__traceback__)[-1].filename, str(self.folder / "mine.py"))
        else:
            self.fail("nothing was raised")

    def test_that_is_wrong_is_reported_in_one_line(self):
        for name, words in (
                ("python:mine.Short", "python:mine.Short: beliefs about 3 steps, expected 3201"),
                ("python:mine.Unknown", "module 'mine' has no 'Unknown'"),
                ("python:mine.Nevr", "^--set estimators=.*: estimators: 'python:mine.Nevr'.*did you mean 'Never'"),
                ("python:nowhere.Unknown", "there is no module 'nowhere' in .* or where Python looks"),
                ("python:mine", "expected python:module.Class"),
                ("python:mine.WithoutRun", r"expected a class with a method run\(self, signals\)"),
                ("python:mine.UnknownSensor", "sensors: 'acceleratoin' is not one of .*did you mean 'acceleration'"),
                ("robusd", "did you mean 'robust'"),
        ):
            with self.assertRaisesRegex(touchdown.InputError, words):
                touchdown.run("hops.yaml", overrides={"estimators": [name]})

    def test_that_is_wrong_in_a_file_is_reported_with_its_place(self):
        text = (self.folder / "hops.yaml").read_text()
        line = next(line for line in text.splitlines() if line.startswith("estimators:"))
        (self.folder / "wrong.yaml").write_text(text.replace(line, "estimators: [free_fall, python:mine.Unknown]"))
        number = 1 + text.splitlines().index(line)
        with self.assertRaisesRegex(touchdown.InputError, f"^wrong.yaml:{number}:25: estimators: 'python:mine.Unknown'"):
            touchdown.run("wrong.yaml")

    def test_with_an_unknown_signal_gets_the_known_names(self):
        try:
            touchdown.run("hops.yaml", overrides={"estimators": ["python:mine.Misspells"]})
        except KeyError as error:
            self.assertRegex(str(error), "'knee_torque' is no signal: expected one of .*torque, .*sample_rate"
                                         ".*did you mean 'torque'")
            self.assertEqual(traceback.extract_tb(error.__traceback__)[-2].filename, str(self.folder / "mine.py"))
        else:
            self.fail("nothing was raised")

    def test_from_the_command_line(self):
        import contextlib
        import io

        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            code = touchdown.experiment.main(["run", "hops.yaml", "--set", "estimators=[python:mine.Never]", "--set",
                                              "test.runs=1", "--out", "out"])
        self.assertEqual(code, 0)
        self.assertIn("results   out", output.getvalue())
        with contextlib.redirect_stderr(output):
            self.assertEqual(touchdown.experiment.main(["run", "hop.yaml"]), 2)
        self.assertIn("touchdown simulate", output.getvalue())


if __name__ == "__main__":
    unittest.main()
