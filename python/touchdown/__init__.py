"""Contact estimation on wheeled bipeds: simulate, fit, listen, score, run experiments.

Arrays have one row per control step. Six joints stand in the order left hip, knee, wheel, right hip,
knee, wheel; two wheels left, right. SI units. What is wrong with a request raises `InputError`, what
goes wrong otherwise `Error`, with the words of the program `touchdown`. Ctrl-C ends long calls.
See docs/python.md.
"""
from touchdown._touchdown import Belief, Error, Estimator, InputError, Model, __version__, estimators, simulators
from touchdown.experiment import Result, run
from touchdown.recording import Recording, contact_labels, fit, score, simulate
from touchdown.upkie import ContactWrapper

#: What the numbers in `status` of `Estimator.run` mean.
STATUS = ("good", "invalid", "gap", "frozen")

__all__ = ["Belief", "ContactWrapper", "Error", "Estimator", "InputError", "Model", "Recording", "Result", "STATUS", "__version__",
           "contact_labels", "estimators", "fit", "run", "score", "simulate", "simulators"]
