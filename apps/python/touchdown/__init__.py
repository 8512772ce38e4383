"""Contact estimation on wheeled bipeds: simulate, fit, estimate, score, run experiments.

Arrays have one row per control step. The order of the six joints is left hip, knee, wheel, right hip,
knee, wheel; that of the two wheels is left, right. Units are SI. A wrong request raises `InputError`,
any other failure `Error`, with the messages of the program `touchdown`. Ctrl-C ends long calls.
See docs/reference/python.md.
"""
from touchdown._touchdown import Belief, Error, Estimator, InputError, Model, __version__, estimators, simulators
from touchdown.experiment import Result, run
from touchdown.keywords import checked as _checked
from touchdown.recording import Recording, check, contact_labels, fit, score, simulate
from touchdown.upkie import ContactWrapper

check, contact_labels, fit, run, score, simulate = map(_checked, (check, contact_labels, fit, run, score, simulate))
Estimator.__init__ = _checked(Estimator.__init__, "Estimator")

#: Names of the numbers in `status` of `Estimator.run`.
STATUS = ("good", "invalid", "gap", "frozen", "degraded")

__all__ = ["Belief", "ContactWrapper", "Error", "Estimator", "InputError", "Model", "Recording", "Result", "STATUS", "__version__",
           "check", "contact_labels", "estimators", "fit", "run", "score", "simulate", "simulators"]
