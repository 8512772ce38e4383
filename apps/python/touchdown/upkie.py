"""Beliefs in Upkie's gym environments."""
from __future__ import annotations

from typing import Any, Callable

from touchdown._touchdown import Estimator


try:
    from gymnasium import Wrapper as _Wrapper
except ImportError:
    class _Wrapper:
        """What `ContactWrapper` needs of gymnasium's wrapper, where there is no gymnasium."""

        def __init__(self, env: Any):
            self.env = env

        def __getattr__(self, name: str) -> Any:
            if name == "env":  # a copy before its construction
                raise AttributeError(name)
            return getattr(self.env, name)


class ContactWrapper(_Wrapper):
    """Wraps an environment and adds `info["contact"]`, an estimator's belief from `info["spine_observation"]`.

    env: any of Upkie's environments; its other attributes stay. Where gymnasium is installed, the wrapper is one
        of its `Wrapper`s
    estimator: made for the environment's frequency (`sample_rate`, Hz)
    ground_velocity: gives the ground velocity of an action (m/s), for estimators that use commands,
        such as the neural network
    """

    def __init__(self, env: Any, estimator: Estimator, ground_velocity: Callable[[Any], float] | None = None):
        super().__init__(env)
        self.estimator = estimator
        self.ground_velocity = ground_velocity
        self._command = 0.0

    def _with_belief(self, info: dict[str, Any]) -> dict[str, Any]:
        return {**info, "contact": self.estimator.update_from_spine(info["spine_observation"], self._command)}

    def reset(self, **options: Any) -> tuple[Any, dict[str, Any]]:
        """Reset the environment and the estimator."""
        observation, info = self.env.reset(**options)
        self.estimator.reset()
        self._command = 0.0
        return observation, self._with_belief(info)

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Step the environment, then update the estimator with the new observation and the command before it."""
        observation, reward, terminated, truncated, info = self.env.step(action)
        if self.ground_velocity is not None:
            self._command = float(self.ground_velocity(action))
        return observation, reward, terminated, truncated, self._with_belief(info)
