import signal
import subprocess
import sys
import textwrap
import threading
import time
import unittest

import numpy as np

import touchdown
from scene import HOP, InFolder

INTERRUPTED = textwrap.dedent("""\
    import os, signal, sys, threading, time
    import touchdown

    threading.Timer(float(sys.argv[1]), os.kill, (os.getpid(), signal.SIGINT)).start()
    began = time.monotonic()
    try:
        {call}
    except KeyboardInterrupt as interrupt:
        print(time.monotonic() - began)
        print(*getattr(interrupt, "__notes__", []))
    """)


# The note distinguishes a call that stopped from one that ended before Python looked at the signal.
INTERRUPTED_RUN = textwrap.dedent("""\
    import os, signal, threading
    import numpy as np
    import touchdown

    run = touchdown.simulate("scenarios/hop.yaml", overrides={"end.duration": 0.5})
    short = dict(run.items())
    long = {name: np.concatenate([values] * 1500) for name, values in short.items()}
    long["time"] = np.arange(len(long["time"])) * run.period
    estimator = touchdown.Estimator("nmn")
    expected = estimator.run(short)
    threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT)).start()
    try:
        estimator.run(long)
    except KeyboardInterrupt as interrupt:
        print(*getattr(interrupt, "__notes__", []))
    after = estimator.run(short)
    print(all(np.array_equal(after[name], expected[name], equal_nan=True) for name in expected))
    """)


class LongCalls(InFolder):
    def interrupted(self, call, after):
        """Seconds from the call to its end, and its note, with Ctrl-C `after` seconds."""
        done = subprocess.run([sys.executable, "-c", INTERRUPTED.format(call=call), str(after)], check=True,
                              capture_output=True, text=True)
        seconds, note = done.stdout.splitlines()
        return float(seconds), note

    def test_of_the_simulator_end_by_ctrl_c(self):
        call = 'touchdown.simulate("scenarios/roam.yaml", overrides={"end.duration": 3600})'
        seconds, _ = self.interrupted(call, 1.0)
        self.assertLess(seconds, 3.0)

    def test_of_an_experiment_end_by_ctrl_c_and_report_what_is_saved(self):
        call = ('touchdown.run("experiments/stairs.yaml", out="out", '
                'overrides={"estimators": ["robust"], "recordings": "none", "video.enabled": False, '
                '"detail.enabled": False, "video.estimators": ["robust"], '
                '"detail.estimators": ["robust"]})')
        seconds, note = self.interrupted(call, 1.5)
        self.assertLess(seconds, 6.0)
        self.assertRegex(note, "stopped; .* parts of the evaluation are saved in out; the same command continues")

    def test_of_an_estimator_ends_by_ctrl_c_and_it_can_be_used_again(self):
        done = subprocess.run([sys.executable, "-c", INTERRUPTED_RUN], check=True, capture_output=True, text=True)
        self.assertEqual(done.stdout.splitlines(), ["stopped; the estimator was reset", "True"])

    def test_leave_handlers_and_other_threads_alone(self):
        # Another thread runs while this one simulates. A signal handler is called, and nothing stops.
        ticks, done, handled = [], threading.Event(), []

        def tick():
            while not done.is_set():
                ticks.append(time.monotonic())
                time.sleep(0.001)

        before = signal.signal(signal.SIGUSR1, lambda *_: handled.append(len(ticks)))
        self.addCleanup(signal.signal, signal.SIGUSR1, before)
        thread = threading.Thread(target=tick)
        thread.start()
        timer = threading.Timer(0.05, signal.raise_signal, (signal.SIGUSR1,))
        timer.start()
        began = time.monotonic()
        run = touchdown.simulate("scenarios/roam.yaml", overrides={"end.duration": 60})
        seconds = time.monotonic() - began
        timer.join()  # on a machine faster than the timer, so that the signal is still handled here
        done.set()
        thread.join()
        self.assertEqual(run.info["outcome"], "finished")
        self.assertEqual(len(handled), 1)
        between = [tick for tick in ticks if tick > began]
        self.assertGreater(len(between), 20.0 * seconds)  # of a thousand per second, on a busy machine

    def test_of_one_estimator_exclude_each_other(self):
        run = touchdown.simulate(HOP, overrides={"end.duration": 0.5})
        long = {name: np.concatenate([values] * 200) for name, values in run.items()}
        estimator = touchdown.Estimator("free_fall")
        done = threading.Event()

        def estimate():  # repeatedly: one call may end before the other thread runs
            while not done.is_set():
                try:
                    estimator.run(long)
                except touchdown.InputError:
                    pass  # the other thread's reset was first

        thread = threading.Thread(target=estimate)
        thread.start()
        refusals, began = [], time.monotonic()
        while not refusals and time.monotonic() - began < 60.0:
            try:
                estimator.reset()
            except touchdown.InputError as error:
                refusals.append(str(error))
        done.set()
        thread.join()
        self.assertEqual(refusals, ["this estimator is in use in another thread"])
        estimator.reset()


if __name__ == "__main__":
    unittest.main()
