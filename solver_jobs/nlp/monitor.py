"""IPOPT's iterations as they happen."""

from collections.abc import Callable, Sequence

import numpy as np
from casadi import DM, Callback, Function, Sparsity, nlpsol_n_out, nlpsol_out

from core.arrays import Floats

Listener = Callable[[Floats, dict[str, float]], bool]
"""Gets the unknowns and IPOPT's figures (obj, inf_pr, inf_du, alpha_pr, …); false ends the solve."""


class Monitor(Callback):
    """The function that CasADi calls at each iteration; it must live as long as the solver.

    CasADi fixes it when the solver is built, so the listener of a single solve is set on it before each run.
    """

    def __init__(self, unknowns: int, rows: int, parameters: int) -> None:
        super().__init__()
        dense = Sparsity.dense
        self._shapes = {
            "x": dense(unknowns),
            "lam_x": dense(unknowns),
            "g": dense(rows),
            "lam_g": dense(rows),
            "lam_p": dense(parameters),
            "f": dense(1),
        }
        self.solver: Function | None = None
        self.listener: Listener | None = None
        self.error: Exception | None = None
        self.construct("monitor", {})

    def get_n_in(self) -> int:
        """CasADi asks: as many inputs as a solver has outputs."""
        return int(nlpsol_n_out())

    def get_n_out(self) -> int:
        """CasADi asks: one, whether to stop."""
        return 1

    def get_name_in(self, i: int) -> str:
        """CasADi asks: names as the solver's outputs."""
        return str(nlpsol_out(i))

    def get_name_out(self, i: int) -> str:
        """CasADi asks: the output's name."""
        return "stop"

    def get_sparsity_in(self, i: int) -> Sparsity:
        """CasADi asks: shapes as the solver's outputs."""
        return self._shapes[nlpsol_out(i)]

    def eval(self, arg: Sequence[DM]) -> list[int]:
        """Passes the iteration on; CasADi would swallow an exception, so it is kept and ends the solve."""
        if self.listener is None or self.solver is None:
            return [0]
        try:
            iterate_motions = self.solver.stats()["iterations"]
            figures = {name: float(values[-1]) for name, values in iterate_motions.items()}
            return [0 if self.listener(np.array(arg[0]).reshape(-1), figures) else 1]
        except Exception as error:
            self.error = error
            return [1]
